#include "engine/liggghts/meshWalls.h"

#include "engine/liggghts/liggghtsProgram.h"

#include <abstract_mesh.h>
#include <fix_mesh_surface.h>
#include <lammps.h>
#include <modify.h>

namespace clepsydra
{

std::vector<WallTriangle> trianglesOfMovingMeshes(const LiggghtsProgram& program)
{
    std::vector<WallTriangle> triangles;
    const LAMMPS_NS::Modify& modify = *program->modify;
    for (int fix = 0; fix < modify.nfix; ++fix)
    {
        auto* const surface = dynamic_cast<LAMMPS_NS::FixMeshSurface*>(modify.fix[fix]);
        if (!surface || !surface->mesh()->isMoving())
        {
            continue;
        }
        LAMMPS_NS::AbstractMesh& mesh = *surface->mesh();
        for (int element = 0; element < mesh.sizeLocal(); ++element)
        {
            WallTriangle triangle{surface->id, mesh.id_slow(element), {}};
            for (std::size_t corner = 0; corner < triangle.corners.size(); ++corner)
            {
                mesh.node_slow(element, static_cast<int>(corner), triangle.corners[corner].data());
            }
            triangles.push_back(triangle);
        }
    }
    return triangles;
}

} // namespace clepsydra
