#include "run/demTimeScales.h"

#include "closures/timeScales.h"
#include "forces/relaxationTime.h"

#include "PstreamReduceOps.H"
#include "surfaceFields.H"

#include <algorithm>

namespace clepsydra
{

namespace
{

/// The smallest time on any rank; empty where none was added.
class Shortest
{
public:
    void add(double time)
    {
        shortest_ = std::min(shortest_, time);
    }

    std::optional<double> ofAllRanks() const
    {
        const double all = Foam::returnReduce(shortest_, Foam::minOp<Foam::scalar>());
        return all < Foam::GREAT ? std::optional<double>(all) : std::nullopt;
    }

private:
    Foam::scalar shortest_ = Foam::GREAT;
};

/// Uses the projected areas of the faces, as OpenFOAM's Courant number does. This is correct for flat cells and for
/// cells with divided faces, where the cube root of the volume is not.
void addCells(const Foam::fvMesh& mesh, Shortest& courant)
{
    using namespace Foam;

    vectorField projectedAreas(mesh.nCells(), vector::zero);
    const auto add = [&](label cell, const vector& face) { projectedAreas[cell] += 0.5 * cmptMag(face); };
    forAll (mesh.faceOwner(), face)
    {
        add(mesh.faceOwner()[face], mesh.faceAreas()[face]);
    }
    forAll (mesh.faceNeighbour(), face)
    {
        add(mesh.faceNeighbour()[face], mesh.faceAreas()[face]);
    }
    forAll (projectedAreas, cell)
    {
        courant.add(mesh.cellVolumes()[cell] / (cmptMax(projectedAreas[cell]) * DemTimeScales::speed));
    }
}

} // namespace

DemTimeScales demTimeScales(DemEngine& engine, double couplingTimeStep, const FluidProperties* fluid,
    const Foam::fvMesh& mesh, double coarseGraining)
{
    Shortest rayleigh;
    Shortest collision;
    Shortest relaxation;
    Shortest courant;
    const ParticlesView particles = engine.particles();
    const std::vector<ContactMaterial> materials = engine.contactMaterials();
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const double radius = particles.radius[particle];
        const double density = particles.mass[particle] / sphereVolume(radius);
        for (const auto& [young, poisson] : materials)
        {
            rayleigh.add(closures::rayleighTime(radius, density, closures::shearModulus(young, poisson), poisson));
            collision.add(
                closures::hertzCollisionTimeOfEqualParticles(radius, density, young, poisson, DemTimeScales::speed));
        }
        if (fluid != nullptr)
        {
            relaxation.add(isolatedRelaxationTime(particles, particle, DemTimeScales::speed, *fluid, coarseGraining));
        }
    }
    if (fluid != nullptr)
    {
        addCells(mesh, courant);
    }
    const auto allParticles =
        Foam::returnReduce(static_cast<Foam::label>(particles.size()), Foam::sumOp<Foam::label>());
    return {engine.timeStep(), couplingTimeStep, allParticles, rayleigh.ofAllRanks(), collision.ofAllRanks(),
        relaxation.ofAllRanks(), courant.ofAllRanks()};
}

} // namespace clepsydra
