#pragma once

#include "couplingStep/couplingSettings.h"
#include "couplingStep/fluidAtParticles.h"
#include "couplingStep/rows.h"
#include "couplingStep/selfInducedVelocityCorrection.h"
#include "couplingStep/turbulentDispersion.h"
#include "couplingStep/viscousStress.h"
#include "forces/forceModel.h"

namespace clepsydra
{

struct AnticipatedParticles;

/// Samples what the forces need of the fluid at the particles. To add a quantity, give FluidAtParticle a member and
/// sample() a line.
class FluidSampling
{
public:
    /// Reads the fields that an earlier process of this run has written.
    /// \param viscousStress  that of the fluid's momentum equation
    FluidSampling(const Foam::fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
        const ForceNeeds& needs, const SmoothingModel& smoothing, const ViscousStress& viscousStress);

    bool removesSelfInducedVelocity() const
    {
        return static_cast<bool>(resistance_);
    }

    /// Computes DU/Dt over the coupling step that has just been solved, where a force needs it. It is stored as a field,
    /// so that a resumed run has it too.
    void updateAcceleration(const Foam::volVectorField& U, double couplingTimeStep);

    /// Computes the mesh's velocity, relative to which DU/Dt is that of the fluid. Call when the mesh has moved. Local.
    void meshMoved();

    /// Lets the particles go on through the eddies with the next sample(), where turbulent dispersion is selected.
    void endWalks(const ParticlesView& particles) const
    {
        turbulentDispersion_.endStep(particles);
    }

    /// Sets the drag coefficient of all particles per volume.
    /// \param resistanceTime  times the length of the coupling step [kg/m3] \pre removesSelfInducedVelocity()
    void setResistance(const ConstRow& resistanceTime, double couplingTimeStep);

    bool needsSauterMeanDiameter() const
    {
        return needs_.sauterMeanDiameter;
    }

    /// Sets the two densities whose quotient is the Sauter mean diameter. \pre needsSauterMeanDiameter()
    /// \param volumePerDiameter  sum over the particles of their volume divided by their diameter, per volume of the
    /// cell [1/m]; of parcels with the diameter of their particles
    void setSizes(const ConstRow& solidFraction, const ConstRow& volumePerDiameter);

    /// Collective.
    /// \param pressureGradient  that acts on the particles [Pa/m], 3 x cells
    FluidAtParticles sample(const AnticipatedParticles& particles, const Foam::volVectorField& U,
        const Foam::volScalarField& voidFraction, const Eigen::MatrixXd& pressureGradient) const;

    /// The self-induced velocity is computed from drag and mobility at the last sampling. They are stored in the part of
    /// the state that checkpoints hold, and restored in a resumed run.
    void store(const ParticlesView& particles) const;
    void restore(const ParticlesView& particles) const;

private:
    const FluidProperties fluid_;
    const ForceNeeds needs_;
    const double coarseGraining_;
    const SelfInducedVelocityCorrection selfInducedVelocityCorrection_;
    const TurbulentDispersion turbulentDispersion_;
    const ViscousStress& viscousStress_;
    /// Null where the self-induced velocity is not removed.
    Foam::autoPtr<Foam::volScalarField> resistance_;
    /// DU/Dt [m/s2]; null where no force needs it.
    Foam::autoPtr<Foam::volVectorField> acceleration_;
    /// Centres of the cells, and their velocity in the last coupling step [m/s]; the latter is empty where the mesh has not
    /// moved. Both are empty where no force needs the acceleration.
    Foam::vectorField centres_;
    Foam::vectorField meshVelocity_;
    /// See setSizes(); without columns where no force needs the Sauter mean diameter.
    Eigen::Matrix2Xd sizes_;
};

} // namespace clepsydra
