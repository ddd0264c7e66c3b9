#include "checkpoint/runInputs.h"

#include "files/wholeFile.h"
#include "ranks.h"

#include "IFstream.H"
#include "OSspecific.H"
#include "StringStream.H"
#include "pointIOField.H"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// SHA-256 of data that are not in memory as one block.
class Digest
{
public:
    void add(const void* data, std::size_t bytes)
    {
        pending_.append(static_cast<const char*>(data), bytes);
        constexpr std::size_t atOnce = 1 << 20;
        if (pending_.size() >= atOnce)
        {
            soFar_ = sha256(soFar_ + pending_);
            pending_.clear();
        }
    }

    template<class List>
    void addList(const List& values)
    {
        for (const auto& value : values)
        {
            add(&value, sizeof value);
        }
    }

    std::string text() const
    {
        return sha256(soFar_ + pending_);
    }

private:
    std::string soFar_;
    std::string pending_;
};

/// Digest of the mesh as it is in memory, because the format of the files (binary, ASCII, one or many) means nothing.
std::string digestOf(const polyMesh& mesh, const pointField& points)
{
    Digest digest;
    for (const point& corner : points)
    {
        digest.add(corner.cdata(), sizeof corner);
    }
    for (const face& corners : mesh.faces())
    {
        digest.addList(corners);
        constexpr label endOfFace = -1;
        digest.add(&endOfFace, sizeof endOfFace);
    }
    digest.addList(mesh.faceOwner());
    digest.addList(mesh.faceNeighbour());
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        const std::string text = patch.name() + ' ' + patch.type() + ' ' + std::to_string(patch.start()) + ' '
                                 + std::to_string(patch.size()) + '\n';
        digest.add(text.data(), text.size());
    }
    return digest.text();
}

/// The points with which the faces of a mesh have been written, from which its points move.
pointField pointsAtBeginning(const polyMesh& mesh)
{
    return pointIOField(IOobject(
        "points", mesh.facesInstance(), polyMesh::meshSubDir, mesh, IOobject::MUST_READ, IOobject::NO_WRITE, false));
}

/// Of a mesh that moves, the number of cells only.
MeshSums sumsOf(const fvMesh& mesh, bool meshMoves)
{
    if (meshMoves)
    {
        return {returnReduce(mesh.nCells(), sumOp<label>()), 0, 0};
    }
    scalar volume = 0;
    scalar squaredVolume = 0;
    for (const scalar cell : mesh.V().field())
    {
        volume += cell;
        squaredVolume += cell * cell;
    }
    return {returnReduce(mesh.nCells(), sumOp<label>()), returnReduce(volume, sumOp<scalar>()),
        returnReduce(squaredVolume, sumOp<scalar>())};
}

/// Digest of a dictionary's entries, so that comments, spaces and the order of lines in included files mean nothing.
FileContents contentsOfDictionary(const fileName& file)
{
    IFstream stream(file);
    dictionary entries(stream);
    entries.remove("FoamFile");
    OStringStream text;
    text.precision(std::numeric_limits<scalar>::max_digits10);
    entries.write(text, false);
    return {text.str().size(), sha256(text.str())};
}

const Manifest::File* inputNamed(const std::vector<Manifest::File>& files, const std::string& name)
{
    const auto found =
        std::find_if(files.begin(), files.end(), [&](const Manifest::File& file) { return file.name == name; });
    return found == files.end() ? nullptr : &*found;
}

bool isMesh(const Manifest::File& input)
{
    const std::string ending = "constant/polyMesh";
    return input.name.size() >= ending.size()
           && input.name.compare(input.name.size() - ending.size(), ending.size(), ending) == 0;
}

} // namespace

RunInputs::RunInputs(const fvMesh& mesh, bool meshMoves, const std::vector<std::filesystem::path>& scriptFiles)
    : sums_(sumsOf(mesh, meshMoves))
{
    const std::string part =
        Pstream::parRun() ? "processor" + std::to_string(Pstream::myProcNo()) + '/' : std::string();
    meshOfThisRank_ = {
        part + "constant/polyMesh", {static_cast<std::uintmax_t>(mesh.nCells()),
                                        digestOf(mesh, meshMoves ? pointsAtBeginning(mesh) : mesh.points())}};
    for (const char* name : {"constant/couplingProperties", "constant/transportProperties", "constant/g",
             "constant/turbulenceProperties", "constant/dynamicMeshDict", "constant/fvOptions", "system/fvOptions"})
    {
        // On all ranks, because the file handlers collated and masterUncollated read included files collectively.
        const fileName file = mesh.time().globalPath() / name;
        if (returnReduce(isFile(file), orOp<bool>()))
        {
            files_.push_back({name, contentsOfDictionary(file)});
        }
    }
    if (!Pstream::master())
    {
        files_.clear();
        return;
    }
    for (const std::filesystem::path& file : scriptFiles)
    {
        // Relative names are relative to the case. A file that cannot be read is an error of the engine, which names the
        // command.
        const std::filesystem::path found = std::filesystem::path(mesh.time().globalPath().c_str()) / file;
        if (std::filesystem::is_regular_file(found))
        {
            files_.push_back({file.string(), contentsOf(found)});
        }
    }
}

std::string RunInputs::lines() const
{
    std::string lines = Manifest::inputLine(meshOfThisRank_);
    for (const Manifest::File& file : files_)
    {
        lines += Manifest::inputLine(file);
    }
    return lines;
}

std::string RunInputs::changeOfMesh(const Manifest& checkpoint) const
{
    std::string here;
    if (checkpoint.ranks == Pstream::nProcs())
    {
        const Manifest::File* const before = inputNamed(checkpoint.inputs, meshOfThisRank_.name);
        if (before != nullptr && !(before->contents == meshOfThisRank_.contents))
        {
            here = meshOfThisRank_.name + " has changed";
        }
        return firstOfRanks(here);
    }
    // Coordinates that are written with writePrecision digits are rounded.
    constexpr double tolerance = 1e-5;
    const auto differ = [](double one, double other) { return std::abs(one - other) > tolerance * std::abs(other); };
    if (checkpoint.mesh.cells != sums_.cells)
    {
        here = "it has " + std::to_string(sums_.cells) + " cells, and had " + std::to_string(checkpoint.mesh.cells);
    }
    else if (differ(checkpoint.mesh.volume, sums_.volume))
    {
        here = "its volume has changed";
    }
    else if (differ(checkpoint.mesh.squaredVolume, sums_.squaredVolume))
    {
        here = "the volumes of its cells have changed";
    }
    return here;
}

std::vector<std::string> RunInputs::changesOfFiles(const Manifest& checkpoint) const
{
    std::vector<std::string> changes;
    for (const Manifest::File& before : checkpoint.inputs)
    {
        if (!isMesh(before))
        {
            const Manifest::File* const now = inputNamed(files_, before.name);
            if (now == nullptr)
            {
                changes.push_back(before.name + " is not read any more");
            }
            else if (!(now->contents == before.contents))
            {
                changes.push_back(before.name + " has changed");
            }
        }
    }
    for (const Manifest::File& now : files_)
    {
        if (inputNamed(checkpoint.inputs, now.name) == nullptr)
        {
            changes.push_back(now.name + " is read in addition");
        }
    }
    return changes;
}

} // namespace clepsydra
