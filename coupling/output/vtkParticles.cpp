#include "output/vtkParticles.h"

#include "couplingState.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace clepsydra
{

namespace
{

/// The columns of `values` as tuples of a VTK array.
template<class VtkArray, class Values>
vtkNew<VtkArray> vtkArray(const char* name, const Values& values)
{
    vtkNew<VtkArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(static_cast<int>(values.rows()));
    array->SetNumberOfTuples(values.cols());
    std::copy_n(values.data(), values.size(), array->GetPointer(0));
    return array;
}

Eigen::RowVectorXd voidFractions(const ParticlesView& particles)
{
    Eigen::RowVectorXd values = Eigen::RowVectorXd::Ones(particles.size());
    for (Eigen::Index particle = 0; particles.state != nullptr && particle < particles.size(); ++particle)
    {
        values(particle) = particles.state[particle].fluid.voidFraction;
    }
    return values;
}

vtkNew<vtkPolyData> polyDataOf(const ParticlesView& particles, const double* temperatures)
{
    std::vector<Eigen::Index> byId(static_cast<std::size_t>(particles.size()));
    std::iota(byId.begin(), byId.end(), 0);
    std::sort(byId.begin(), byId.end(), [&](auto a, auto b) { return particles.id[a] < particles.id[b]; });
    const auto sorted = [&](const auto& columns) { return columns(Eigen::all, byId).eval(); };

    vtkNew<vtkPoints> points;
    points->SetData(vtkArray<vtkDoubleArray>("position", sorted(particles.position)));
    vtkNew<vtkCellArray> vertices;
    for (vtkIdType particle = 0; particle < particles.size(); ++particle)
    {
        vertices->InsertNextCell(1, &particle);
    }

    vtkNew<vtkPolyData> drawing;
    drawing->SetPoints(points);
    drawing->SetVerts(vertices);
    vtkPointData& data = *drawing->GetPointData();
    const Eigen::Matrix3Xd velocity = sorted(particles.velocity);
    data.AddArray(vtkArray<vtkIntArray>("id", sorted(particles.id.transpose())));
    data.AddArray(vtkArray<vtkDoubleArray>("radius", sorted(particles.radius.transpose())));
    data.AddArray(vtkArray<vtkDoubleArray>("velocity", velocity));
    data.AddArray(vtkArray<vtkDoubleArray>("angularVelocity", sorted(particles.angularVelocity)));
    data.AddArray(vtkArray<vtkDoubleArray>("voidFraction", sorted(voidFractions(particles))));
    data.AddArray(vtkArray<vtkDoubleArray>("speed", velocity.colwise().norm().eval()));
    if (temperatures)
    {
        const Eigen::Map<const Eigen::RowVectorXd> all(temperatures, particles.size());
        data.AddArray(vtkArray<vtkDoubleArray>("temperature", sorted(all)));
    }
    return drawing;
}

} // namespace

std::string partOfVtp(const ParticlesView& particles, bool first, bool last, const double* temperatures)
{
    vtkNew<vtkXMLPolyDataWriter> writer;
    // Into a string, because VTK does not detect every failure of writing to a file.
    writer->WriteToOutputStringOn();
    writer->SetInputData(polyDataOf(particles, temperatures));
    // Not "appended", which would be a third smaller: Debian 12's ParaView 5.11 cannot read that with Debian's expat
    // 2.5.0-1+deb12u2.
    writer->SetDataModeToBinary();
    if (writer->Write() != 1)
    {
        throw std::runtime_error("VTK cannot write the particles");
    }
    const std::string whole = writer->GetOutputString();
    const std::string pieceEnd = "</Piece>\n";
    const std::size_t begin = first ? 0 : whole.find("<Piece");
    std::string part = whole.substr(begin, last ? std::string::npos : whole.find(pieceEnd) + pieceEnd.size() - begin);
    if (!last)
    {
        part.append(pageSize - 1 - (part.size() + pageSize - 1) % pageSize, ' ');
    }
    return part;
}

} // namespace clepsydra
