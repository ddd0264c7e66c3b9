#include "output/vtkBeads.h"

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

Eigen::RowVectorXd voidFractions(const BeadsView& beads)
{
    Eigen::RowVectorXd values = Eigen::RowVectorXd::Ones(beads.size());
    for (Eigen::Index bead = 0; beads.state != nullptr && bead < beads.size(); ++bead)
    {
        values(bead) = beads.state[bead].fluid.voidFraction;
    }
    return values;
}

vtkNew<vtkPolyData> drawingOf(const BeadsView& beads)
{
    std::vector<Eigen::Index> byId(static_cast<std::size_t>(beads.size()));
    std::iota(byId.begin(), byId.end(), 0);
    std::sort(byId.begin(), byId.end(), [&](auto a, auto b) { return beads.id[a] < beads.id[b]; });
    const auto sorted = [&](const auto& columns) { return columns(Eigen::all, byId).eval(); };

    vtkNew<vtkPoints> points;
    points->SetData(vtkArray<vtkDoubleArray>("position", sorted(beads.position)));
    vtkNew<vtkCellArray> vertices;
    for (vtkIdType bead = 0; bead < beads.size(); ++bead)
    {
        vertices->InsertNextCell(1, &bead);
    }

    vtkNew<vtkPolyData> drawing;
    drawing->SetPoints(points);
    drawing->SetVerts(vertices);
    vtkPointData& data = *drawing->GetPointData();
    const Eigen::Matrix3Xd velocity = sorted(beads.velocity);
    data.AddArray(vtkArray<vtkIntArray>("id", sorted(beads.id.transpose())));
    data.AddArray(vtkArray<vtkDoubleArray>("radius", sorted(beads.radius.transpose())));
    data.AddArray(vtkArray<vtkDoubleArray>("velocity", velocity));
    data.AddArray(vtkArray<vtkDoubleArray>("angularVelocity", sorted(beads.angularVelocity)));
    data.AddArray(vtkArray<vtkDoubleArray>("voidFraction", sorted(voidFractions(beads))));
    data.AddArray(vtkArray<vtkDoubleArray>("speed", velocity.colwise().norm().eval()));
    return drawing;
}

} // namespace

std::string partOfVtp(const BeadsView& beads, bool first, bool last)
{
    vtkNew<vtkXMLPolyDataWriter> writer;
    // VTK does not see every write that fails.
    writer->WriteToOutputStringOn();
    writer->SetInputData(drawingOf(beads));
    // Not appended, a third smaller: Debian 12's ParaView 5.11 cannot read that with Debian's expat 2.5.0-1+deb12u2.
    writer->SetDataModeToBinary();
    if (writer->Write() != 1)
    {
        throw std::runtime_error("VTK cannot make a drawing of the beads");
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
