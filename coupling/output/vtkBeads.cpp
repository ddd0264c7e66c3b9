#include "output/vtkBeads.h"

#include "files/wholeFile.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <stdexcept>

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

} // namespace

void writeVtp(const std::filesystem::path& file, const DrawnBeads& beads)
{
    vtkNew<vtkPoints> points;
    points->SetData(vtkArray<vtkDoubleArray>("position", beads.position));

    vtkNew<vtkCellArray> vertices;
    for (vtkIdType bead = 0; bead < beads.id.size(); ++bead)
    {
        vertices->InsertNextCell(1, &bead);
    }

    vtkNew<vtkPolyData> drawn;
    drawn->SetPoints(points);
    drawn->SetVerts(vertices);
    vtkPointData& data = *drawn->GetPointData();
    data.AddArray(vtkArray<vtkIntArray>("id", beads.id.transpose().eval()));
    data.AddArray(vtkArray<vtkDoubleArray>("radius", beads.radius.transpose().eval()));
    data.AddArray(vtkArray<vtkDoubleArray>("velocity", beads.velocity));
    data.AddArray(vtkArray<vtkDoubleArray>("angularVelocity", beads.angularVelocity));
    data.AddArray(vtkArray<vtkDoubleArray>("voidFraction", beads.voidFraction.transpose().eval()));
    data.AddArray(vtkArray<vtkDoubleArray>("speed", beads.velocity.colwise().norm().eval()));

    vtkNew<vtkXMLPolyDataWriter> writer;
    // VTK does not see every write that fails.
    writer->WriteToOutputStringOn();
    writer->SetInputData(drawn);
    // Not appended, a third smaller: Debian 12's ParaView 5.11 cannot read that with Debian's expat 2.5.0-1+deb12u2.
    writer->SetDataModeToBinary();
    if (writer->Write() != 1)
    {
        throw std::runtime_error("VTK cannot make " + file.string());
    }
    writeWhole(file, writer->GetOutputString());
}

} // namespace clepsydra
