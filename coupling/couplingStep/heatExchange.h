#pragma once

#include "conservation/conservationCheck.h"
#include "couplingStep/energy.h"
#include "couplingStep/heatTransferModel.h"
#include "couplingStep/particleMapping.h"
#include "forces/fluidProperties.h"

#include "fvMatrices.H"
#include "volFields.H"

namespace clepsydra
{

/// The heat that particles and fluid exchange in one coupling step, semi-implicit in the fluid's temperature and with a
/// deferred correction, as is the momentum of SemiImplicitSource.
///
/// Over a coupling step the fluid's temperature at a particle is held at T_b, its value at the end of the step, and the
/// particle takes the heat
///
///     H = c (T_b - T_p),    c = m Cp (1 - exp(-h A dt/(m Cp)))
///
/// see closures/heatExchange.h. The heat transfer coefficient h is that of the fluid as it was sampled at the particle
/// last. The equation of the fluid's temperature holds C T - D, where C and D are the smoothed densities of c and c T_p.
/// Where C T differs from the smoothed density of c T_b, the difference is a deferred correction in the next step, so
/// that the fluid loses, in sum and where the particles are, what the particles take.
///
/// In the linear analysis of SemiImplicitSource fluid and particles of one temperature exchange nothing, and a difference
/// is multiplied by a factor between 0 and 1 in each step, for any coupling step and ratio of the heat capacities.
class HeatExchange
{
public:
    /// Reads the fields that an earlier process of this run has written.
    HeatExchange(const Foam::fvMesh& mesh, const Energy& energy, const FluidProperties& fluid);

    /// Sets the source of the coupling step that is solved. Collective.
    /// \param particles  those that are located
    /// \param timeStep  length of the coupling step [s]
    void update(const LocatedParticles& located, const ParticlesView& particles, const TemperaturesView& temperatures,
        double timeStep);

    /// Lets each cell keep the heat that it holds while its volume changes. Call when the mesh has moved, before update().
    /// Local.
    void meshMoved();

    /// The particles' source in the equation of the temperature [K/s times volume], divided by the heat capacity of the
    /// fluid's volume.
    Foam::tmp<Foam::fvScalarMatrix> source(Foam::volScalarField& T) const;

    /// Gives the particles their heat and stores the deferred correction. Call once, when T has been solved for.
    /// Collective, but without a reduction.
    /// \param located  as in update()
    /// \return the parts of the balance that concern the particles, on this rank
    HeatOfStep exchange(const LocatedParticles& located, TemperaturesView temperatures, const Foam::volScalarField& T);

private:
    /// h A [W/K] of a particle, or of all particles of a parcel.
    double conductance(const ParticlesView& particles, Eigen::Index particle) const;
    /// Heat that the fluid of this rank has given and that no particle has been assigned [J].
    double pending() const;

    const FluidProperties fluid_;
    const ThermalProperties thermal_;
    const double coarseGraining_;
    /// rho Cp [J/(m3 K)].
    const double capacityPerVolume_;
    const Foam::autoPtr<HeatTransferModel> model_;
    double timeStep_ = 0;
    /// c of each particle [J/K].
    Eigen::RowVectorXd coefficients_;
    /// C [1/s] and the density of what does not depend on T [K/s], per heat capacity of the fluid's volume.
    Foam::volScalarField coefficient_;
    Foam::volScalarField particleSource_;
    /// C T dt, which the fluid has given, and the density of c T_b, which is not smoothed yet; per heat capacity of the
    /// fluid's volume [K].
    Foam::volScalarField given_;
    Foam::volScalarField deferred_;
};

} // namespace clepsydra
