#include "engine/liggghts/fasterParts.h"

#include "engine/liggghts/fixStyles.h"

// Headers that LIGGGHTS' headers below use without including them.
#include <mpi.h>

#include <atom.h>
#include <comm.h>
#include <fix_contact_history_mesh.h>
#include <fix_mesh_surface.h>
#include <fix_neighlist_mesh.h>
#include <fix_property_atom.h>
#include <fix_wall_gran.h>
#include <lammps.h>
#include <neighbor.h>
#include <tri_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace clepsydra
{

namespace
{

namespace lmp = LAMMPS_NS;

/// Access to the flags of LIGGGHTS' contact history of a mesh.
struct ContactFlags : lmp::FixContactHistoryMesh
{
    static void clear(lmp::FixContactHistoryMesh& history, int particle)
    {
        const int count = history.nneighs(particle);
        std::fill_n((history.*(&ContactFlags::keepflag_))[particle], count, false);
        std::fill_n((history.*(&ContactFlags::intersectflag_))[particle], count, false);
    }
};

/// LIGGGHTS' walls of triangles with two differences that leave the forces as they are. A triangle whose plane or edges are
/// further away than the particle's radius is left out before its distance is calculated; and flags of contacts are
/// cleared for the particles that have triangles in their neighbourhood, not for all particles.
class MeshWalls : public lmp::FixWallGran
{
public:
    using FixWallGran::FixWallGran;

protected:
    void pre_neighbor() override
    {
        FixWallGran::pre_neighbor();
        neighboursAreNew_ = true;
    }

    void post_force_mesh(int virials) override
    {
        if (!canEvaluate())
        {
            neighboursAreNew_ = true; // because LIGGGHTS allocates the flags again
            FixWallGran::post_force_mesh(virials);
            return;
        }
        neighbourhoods_.resize(n_FixMesh_);
        for (int mesh = 0; mesh < n_FixMesh_; ++mesh)
        {
            evaluate(mesh);
        }
        neighboursAreNew_ = false;
    }

private:
    /// The triangles of a mesh and the particles of this rank that are in each other's neighbourhood.
    struct Neighbourhood
    {
        std::vector<int> triangles;
        std::vector<int> particles;
    };

    /// Whether all particles are spheres without what LIGGGHTS' loop provides besides.
    bool canEvaluate() const
    {
        const bool keepsContacts = std::all_of(FixMesh_list_, FixMesh_list_ + n_FixMesh_,
            [](lmp::FixMeshSurface* mesh) { return mesh->contactHistory() && !mesh->meshMulticontactData(); });
        return impl && radius_ && !atom->superquadric_flag && !atom->shapetype_flag && keepsContacts;
    }

    void evaluate(int meshIndex)
    {
        lmp::FixMeshSurface& fixMesh = *FixMesh_list_[meshIndex];
        lmp::FixContactHistoryMesh& history = *fixMesh.contactHistory();
        Neighbourhood& neighbourhood = neighbourhoods_[meshIndex];
        if (neighboursAreNew_)
        {
            neighbourhood = neighbourhoodOf(fixMesh);
            history.markAllContacts();
        }
        else
        {
            for (const int particle : neighbourhood.particles)
            {
                ContactFlags::clear(history, particle);
            }
        }

        // Members that LIGGGHTS' contact models read.
        fix_wallforce_contact_ = store_force_contact_ ? fixMesh.meshforceContact() : fix_wallforce_contact_;
        fix_wallforce_contact_stress_ =
            store_force_contact_stress_ ? fixMesh.meshforceContactStress() : fix_wallforce_contact_stress_;
        fix_store_multicontact_data_ = nullptr;
        atom_type_wall_ = fixMesh.atomTypeWall();

        for (const int triangle : neighbourhood.triangles)
        {
            for (const int particle : fixMesh.meshNeighlist()->get_contact_list(triangle))
            {
                if (particle < atom->nlocal && isNear(*fixMesh.triMesh(), triangle, particle))
                {
                    evaluate(fixMesh, meshIndex, triangle, particle);
                }
            }
        }
        for (const int particle : neighbourhood.particles)
        {
            history.cleanUpContacts(particle, particle + 1);
        }
    }

    Neighbourhood neighbourhoodOf(lmp::FixMeshSurface& fixMesh) const
    {
        Neighbourhood result;
        lmp::TriMesh& mesh = *fixMesh.triMesh();
        for (int triangle = 0; triangle < mesh.sizeLocal() + mesh.sizeGhost(); ++triangle)
        {
            if (!fixMesh.meshNeighlist()->get_contact_list(triangle).empty())
            {
                result.triangles.push_back(triangle);
            }
        }
        if (comm->uniform == 0)
        {
            // The order of the triangles depends on all boxes that the rank has had, and forces on the order. A resumed run
            // knows the last boxes only.
            std::stable_sort(result.triangles.begin(), result.triangles.end(),
                [&](int one, int other) { return mesh.id(one) < mesh.id(other); });
        }
        for (int particle = 0; particle < atom->nlocal; ++particle)
        {
            if (fixMesh.contactHistory()->nneighs(particle) > 0)
            {
                result.particles.push_back(particle);
            }
        }
        return result;
    }

    /// False only if the particle cannot touch the triangle. LIGGGHTS takes a point as inside a triangle also if it is
    /// outside by the mesh's `precision`, 1e-8 m by default, which the margin covers.
    bool isNear(lmp::TriMesh& mesh, int triangle, int particle) const
    {
        constexpr double margin = 0.01;
        const double reach = radius_[particle] * neighbor->contactDistanceFactor;
        return mesh.resolveTriSphereNeighbuild(triangle, reach, x_[particle], margin * reach);
    }

    /// As in LIGGGHTS' FixWallGran::post_force_mesh, for a sphere.
    void evaluate(lmp::FixMeshSurface& fixMesh, int meshIndex, int triangle, int particle)
    {
        lmp::TriMesh& mesh = *fixMesh.triMesh();
        std::array<double, 3> toWall{};
        std::array<double, 3> barycentric{};
        int side = -1;
        LIGGGHTS::ContactModels::SurfacesIntersectData contact;
        contact.is_wall = true;
        contact.radi = radius_[particle];
        const double gap = mesh.resolveTriSphereContactBary(
            particle, triangle, contact.radi, x_[particle], toWall.data(), barycentric.data(), side);
        const bool touches = gap <= 0;
        if (gap > cutneighmax_ || !(touches || gap < (neighbor->contactDistanceFactor - 1) * contact.radi))
        {
            return;
        }
        constexpr int face = 7;
        if (!fixMesh.contactHistory()->handleContact(
                particle, mesh.id(triangle), contact.contact_history, touches, side == face))
        {
            return;
        }
        contact.i = particle;
        contact.mesh = &mesh;
        contact.fix_mesh = &fixMesh;
        contact.deltan = -gap;
        std::transform(toWall.begin(), toWall.end(), contact.delta, [](double distance) { return -distance; });
        std::array<double, 3> wallVelocity = velocityAt(mesh, triangle, barycentric);
        impl->compute_force(this, contact, touches, wallVelocity.data(), &fixMesh, meshIndex, &mesh, triangle);
    }

    /// Velocity of a mesh that moves, at a point of a triangle.
    static std::array<double, 3> velocityAt(lmp::TriMesh& mesh, int triangle, const std::array<double, 3>& barycentric)
    {
        auto* const velocities = mesh.prop().getElementProperty<lmp::MultiVectorContainer<double, 3, 3>>("v");
        if (!velocities)
        {
            return {};
        }
        const double* const* const ofNodes = velocities->begin()[triangle];
        std::array<double, 3> result{};
        for (std::size_t axis = 0; axis < result.size(); ++axis)
        {
            result[axis] = barycentric[0] * ofNodes[0][axis] + barycentric[1] * ofNodes[1][axis]
                           + barycentric[2] * ofNodes[2][axis];
        }
        return result;
    }

    bool neighboursAreNew_ = true;
    std::vector<Neighbourhood> neighbourhoods_;
};

} // namespace

void replaceMeshWallContacts(LiggghtsProgram& program)
{
    setFixStyle(program, "wall/gran", [](lmp::LAMMPS* liggghts, int count, char** tokens) -> lmp::Fix* {
        return new MeshWalls(liggghts, count, tokens);
    });
}

} // namespace clepsydra
