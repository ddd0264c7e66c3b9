#pragma once

#include "couplingStep/couplingSettings.h"
#include "engine/demEngine.h"
#include "engine/liggghts/wallMotions.h"

#include "volFields.H"
#include "wordRes.H"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace clepsydra
{

/// Compares the walls of the DEM script with those of a fluid whose mesh moves, in each coupling step.
///
/// A wall patch of the fluid that moves, or that prescribes a velocity, needs a wall of the script beside it with the same
/// velocity: triangles that `fix move/mesh` moves; or, where the patch moves along itself only, a wall with one of the words
/// `shear`, `surface_vel` and `surface_ang_vel`. Each wall of the script that moves needs such a patch. And the mesh must
/// move with the fluid at each wall patch, so that no fluid passes it.
class WallsOfMovingMesh
{
public:
    /// Collective.
    /// \param motions  of all walls in the script
    WallsOfMovingMesh(const Foam::fvMesh& mesh, const CouplingSettings& settings, const DemEngine& engine,
        const std::vector<WallMotion>& motions);

    /// Compares what has moved in the coupling step. Collective. FatalError or FatalIOError that names the patch or the wall.
    /// \param U  with the values at the walls of the moved mesh
    void check(const Foam::volVectorField& U);

private:
    using TriangleName = std::pair<std::string, int>;
    using Triangles = std::map<TriangleName, std::array<Vector3d, 3>>;

    /// Those of all ranks. Collective.
    Triangles triangles() const;
    [[noreturn]] void refusePatch(const Foam::word& patch, const std::string& motion) const;
    void requirePatchFor(const std::string& wall, const std::string& kind) const;

    const Foam::fvMesh& mesh_;
    const CouplingSettings& settings_;
    const DemEngine& engine_;
    /// Of walls whose geometry remains.
    std::vector<WallMotion> alongItself_;
    /// Patches beside which there need not be a wall.
    const Foam::wordRes allowed_;
    Triangles before_;
};

} // namespace clepsydra
