#include "output/vtkSeries.h"

#include "files/wholeFile.h"

#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace clepsydra
{

namespace
{

/// Relative tolerance in comparisons of times, because sums of time steps differ from times that are read.
constexpr double sameTime = 1e-9;

bool notAfter(double time, double other)
{
    return time <= other + sameTime * std::max(1.0, std::abs(other));
}

} // namespace

VtkSeries::VtkSeries(std::filesystem::path file, double startTime)
    : file_(std::move(file))
{
    if (std::filesystem::exists(file_))
    {
        read(startTime);
    }
}

void VtkSeries::read(double startTime)
{
    vtkNew<vtkXMLDataParser> parser;
    std::istringstream text(textOf(file_));
    parser->SetStream(&text);
    if (parser->Parse() != 1 || parser->GetRootElement() == nullptr)
    {
        throw std::runtime_error(
            file_.string() + " is not a ParaView collection; allowed: a collection, or no file of this name");
    }
    vtkXMLDataElement* collection = parser->GetRootElement()->FindNestedElementWithName("Collection");
    for (int i = 0; collection != nullptr && i < collection->GetNumberOfNestedElements(); ++i)
    {
        vtkXMLDataElement* entry = collection->GetNestedElement(i);
        double time = 0;
        const char* name = entry->GetAttribute("file");
        if (entry->GetScalarAttribute("timestep", time) != 0 && name != nullptr && notAfter(time, startTime)
            && std::filesystem::exists(file_.parent_path() / name))
        {
            entries_.emplace(time, name);
        }
    }
}

void VtkSeries::add(double time, const std::filesystem::path& dataFile)
{
    for (auto entry = entries_.begin(); entry != entries_.end();)
    {
        const bool sameMoment = notAfter(entry->first, time) && notAfter(time, entry->first);
        entry = sameMoment ? entries_.erase(entry) : std::next(entry);
    }
    entries_.emplace(time, dataFile);
    write();
}

void VtkSeries::write() const
{
    std::ostringstream out;
    out.precision(std::numeric_limits<double>::digits10);
    out << R"(<?xml version="1.0"?>
<VTKFile type="Collection" version="0.1">
<Collection>
)";
    for (const auto& [time, dataFile] : entries_)
    {
        out << R"(<DataSet timestep=")" << time << R"(" part="0" file=")" << dataFile.string() << "\"/>\n";
    }
    out << "</Collection>\n</VTKFile>\n";
    writeWhole(file_, out.str());
}

} // namespace clepsydra
