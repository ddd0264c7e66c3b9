#include "study/draft/measuredFiles.h"

#include "curves/table.h"
#include "study/measurements.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace clepsydra::identification
{

namespace
{

namespace fs = std::filesystem;

std::vector<fs::path> tablesOf(const std::vector<fs::path>& places, std::vector<std::string>& remarks)
{
    static const std::set<std::string> endings = {".csv", ".txt", ".dat", ".tsv"};
    std::set<fs::path> tables;
    for (const auto& place : places)
    {
        if (!fs::is_directory(place))
        {
            readTable(place);
            tables.insert(place);
            continue;
        }
        const std::size_t before = tables.size();
        for (const auto& entry : fs::directory_iterator(place))
        {
            if (!entry.is_regular_file() || endings.count(entry.path().extension().string()) == 0)
            {
                continue;
            }
            try
            {
                readTable(entry.path());
                tables.insert(entry.path());
            }
            catch (const std::runtime_error& error)
            {
                remarks.push_back("left out: " + std::string(error.what()));
            }
        }
        if (tables.size() == before)
        {
            throw std::runtime_error(
                place.string()
                + ": contains no table of numbers; expected are files .csv, .txt, .dat or .tsv with "
                  "a column of times and one "
                  "of values");
        }
    }
    return {tables.begin(), tables.end()};
}

GuessedColumns columnsOf(const fs::path& file)
{
    try
    {
        return guessColumns(readTable(file));
    }
    catch (const std::runtime_error& error)
    {
        throw std::runtime_error(file.string() + ": " + error.what());
    }
}

/// Curve of a file, which must have the columns of the first file.
Curve curveOf(const fs::path& file, const fs::path& first, const GuessedColumns& columns)
{
    try
    {
        return readMeasured(file, {columns.time.column}, {columns.value.column});
    }
    catch (const std::runtime_error& error)
    {
        throw std::runtime_error(std::string(error.what()) + " (the study has the columns of " + first.string()
                                 + "; files with other columns need another study)");
    }
}

std::string quantityWritten(const DraftedSimulator& simulator)
{
    return simulator.observable == "massInHopper" ? "mass" : simulator.observable == "particleHeight" ? "length" : "";
}

void requireFit(const GuessedColumns& columns, const fs::path& file, const DraftedSimulator& simulator)
{
    static const std::map<std::string, std::set<std::string>> fitting = {
        {"mass", {"mass", "share"}}, {"length", {"length", "speed"}}};
    const auto fits = fitting.find(quantityWritten(simulator));
    if (fits != fitting.end() && fits->second.count(columns.quantity) == 0)
    {
        throw std::runtime_error(file.string() + ": column '" + columns.value.column + "' is a " + columns.quantity
                                 + ", but the case " + simulator.folder.string() + " writes a " + fits->first + " ("
                                 + simulator.observable + "); is it the right case?");
    }
}

} // namespace

MeasuredFiles readMeasuredFiles(const std::vector<fs::path>& places, const DraftedSimulator& simulator)
{
    MeasuredFiles measured;
    auto& [conditions, columns, shape, remarks] = measured;
    conditions = draftConditions(tablesOf(places, remarks));
    std::vector<Curve> curves;
    const auto training =
        std::find_if(conditions.begin(), conditions.end(), [](const auto& each) { return !each.isHeldOut; });
    const fs::path first = training->files.front();
    columns = columnsOf(first);
    for (const auto& condition : conditions)
    {
        double shortest = std::numeric_limits<double>::infinity();
        double longest = 0.0;
        for (const auto& file : condition.files)
        {
            const Curve curve = curveOf(file, first, columns);
            if (!condition.isHeldOut)
            {
                curves.push_back(curve);
                shortest = std::min(shortest, curve.time.back() - curve.time.front());
                longest = std::max(longest, curve.time.back() - curve.time.front());
            }
        }
        if (longest > 1.5 * shortest)
        {
            remarks.push_back("condition " + condition.name
                              + ": one record is more than 1.5 times as long as another; are "
                                "they repeats of one condition?");
        }
    }
    if (columns.quantity.empty())
    {
        columns.quantity = quantityWritten(simulator);
    }
    requireFit(columns, first, simulator);
    shape = shapeOf(std::move(curves), columns.quantity == "length");
    shape.bounces = columns.quantity == "length" ? shape.bounces : 0;
    const auto unit = [](const GuessedColumn& column) { return column.unit.empty() ? "unit unknown" : column.unit; };
    remarks.push_back("columns: time is '" + columns.time.column + "' [" + unit(columns.time) + "], value '"
                      + columns.value.column + "' [" + unit(columns.value) + "], "
                      + (columns.quantity.empty() ? "of unknown kind" : "a " + columns.quantity)
                      + (shape.bounces > 0 ? " that bounces"
                          : shape.falls    ? " that falls"
                                           : " that rises"));
    return measured;
}

} // namespace clepsydra::identification
