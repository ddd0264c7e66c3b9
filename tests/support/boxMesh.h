#pragma once

#include "Time.H"
#include "cellModel.H"
#include "fvMesh.H"
#include "polyPatch.H"
#include "wallPolyPatch.H"

#include <array>
#include <memory>

namespace clepsydra::tests
{

/// A box of nx * ny * nz equal cells, made in memory. Its patches are the walls xMin, xMax, yMin, yMax, zMin, zMax.
/// On several ranks each makes a box of its own, joined to no other.
inline std::unique_ptr<Foam::fvMesh> boxMesh(
    const Foam::Time& time, const Foam::point& low, const Foam::point& high, const std::array<int, 3>& cells)
{
    using namespace Foam;

    const auto [nx, ny, nz] = cells;
    const vector step((high.x() - low.x()) / nx, (high.y() - low.y()) / ny, (high.z() - low.z()) / nz);
    const auto pointAt = [nx = nx, ny = ny](label i, label j, label k) { return i + (nx + 1) * (j + (ny + 1) * k); };

    pointField points((nx + 1) * (ny + 1) * (nz + 1));
    for (label k = 0; k <= nz; ++k)
    {
        for (label j = 0; j <= ny; ++j)
        {
            for (label i = 0; i <= nx; ++i)
            {
                points[pointAt(i, j, k)] = low + vector(i * step.x(), j * step.y(), k * step.z());
            }
        }
    }

    const cellModel& hex = cellModel::ref(cellModel::HEX);
    cellShapeList shapes(nx * ny * nz);
    List<DynamicList<face>> walls(6);
    const auto corner = [&](label i, label j, label k, int n) {
        return pointAt(i + ((n == 1 || n == 2 || n == 5 || n == 6) ? 1 : 0),
            j + ((n == 2 || n == 3 || n == 6 || n == 7) ? 1 : 0), k + (n >= 4 ? 1 : 0));
    };
    label cell = 0;
    for (label k = 0; k < nz; ++k)
    {
        for (label j = 0; j < ny; ++j)
        {
            for (label i = 0; i < nx; ++i)
            {
                labelList corners(8);
                for (int n = 0; n < 8; ++n)
                {
                    corners[n] = corner(i, j, k, n);
                }
                shapes[cell++] = cellShape(hex, corners);
                const auto wall = [&](bool there, label patch, const std::array<int, 4>& n) {
                    if (there)
                    {
                        walls[patch].append(
                            face(labelList({corners[n[0]], corners[n[1]], corners[n[2]], corners[n[3]]})));
                    }
                };
                wall(i == 0, 0, {0, 4, 7, 3});
                wall(i == nx - 1, 1, {1, 2, 6, 5});
                wall(j == 0, 2, {0, 1, 5, 4});
                wall(j == ny - 1, 3, {3, 7, 6, 2});
                wall(k == 0, 4, {0, 3, 2, 1});
                wall(k == nz - 1, 5, {4, 5, 6, 7});
            }
        }
    }
    faceListList wallFaces(6);
    forAll (walls, patch)
    {
        wallFaces[patch].transfer(walls[patch]);
    }

    const polyMesh shaped(IOobject("shaped", time.constant(), time, IOobject::NO_READ, IOobject::NO_WRITE, false),
        pointField(points), shapes, wallFaces, wordList({"xMin", "xMax", "yMin", "yMax", "zMin", "zMax"}),
        wordList(6, wallPolyPatch::typeName), "none", wallPolyPatch::typeName, wordList(6), false);

    auto mesh = std::make_unique<fvMesh>(
        IOobject(fvMesh::defaultRegion, time.timeName(), time, IOobject::NO_READ, IOobject::NO_WRITE),
        pointField(shaped.points()), faceList(shaped.faces()), labelList(shaped.faceOwner()),
        labelList(shaped.faceNeighbour()), false);
    List<polyPatch*> patches(6);
    for (label patch = 0; patch < 6; ++patch)
    {
        patches[patch] = shaped.boundaryMesh()[patch].clone(mesh->boundaryMesh()).ptr();
    }
    mesh->addFvPatches(patches, false);
    return mesh;
}

/// A mesh made in memory comes without its dictionaries: reads one of them, fvSchemes or fvSolution.
template<class Dictionary>
void readFromCase(Foam::fvMesh& mesh)
{
    Dictionary& dictionary = mesh;
    dictionary.readOpt() = Foam::IOobject::MUST_READ;
    dictionary.read();
}

} // namespace clepsydra::tests
