#pragma once

#include "couplingStep/couplingStep.h"
#include "support/boxMesh.h"
#include "support/fakeEngine.h"
#include "support/fluidWithoutContinuity.h"
#include "support/temporaryCase.h"

#include "fvcFlux.H"
#include "fvm.H"
#include "mathematicalConstants.H"

namespace clepsydra::tests
{

using namespace Foam;

/// An engine that loses something of what the particles receive.
class FaultyEngine final : public FakeEngine
{
public:
    using FakeEngine::FakeEngine;

    void advance(int steps) override
    {
        if (losesPressureGradient_)
        {
            FakeEngine::particles().state[0].fluid.pressureGradient.setZero();
        }
        FakeEngine::advance(steps - missingSteps_);
    }

    /// From now on the first particle moves as if no pressure gradient had been sampled at it.
    void losePressureGradientFromNowOn()
    {
        losesPressureGradient_ = true;
    }

    /// From now on each interval lacks a DEM step.
    void missAStepFromNowOn()
    {
        missingSteps_ = 1;
    }

private:
    bool losesPressureGradient_ = false;
    int missingSteps_ = 0;
};

/// Water, and particles in it.
struct StreamSetup
{
    std::string momentumModel = "implicitCouple";
    std::string drag = "SchillerNaumannDrag";
    std::string pressureForce = "gradPForce";
    std::string smoothing = "constDiffSmoothing; constDiffSmoothingProps { bandwidth 0.15; }";
    std::array<int, 3> cells = {6, 6, 6};
    /// Along each axis, in the middle of equal boxes.
    std::array<int, 3> particles = {2, 2, 2};
    double particleDensity = 2500;
    double viscosity = 1;
    /// The water's velocity is .1 m/s everywhere, or a wave cos(pi x) of .1 m/s.
    bool wave = false;
    /// Of p along z [m/s2].
    double pressureGradient = 0;
    bool fixed = false;
    double interval = 0.01;
    int demStepsPerCouplingStep = 10;
    /// Then advance() says how long the next coupling step is.
    bool adjustable = false;
};

/// Particles in a box of water that streams past them at .1 m/s, and the simplest fluid's equation: d(eps U)/dt = source.
class Stream
{
public:
    static constexpr double density = 1000;
    static constexpr double radius = 0.02;

    explicit Stream(const StreamSetup& setup)
        : case_("deltaT " + std::to_string(setup.interval) + ";"),
          engine_(setup.interval / setup.demStepsPerCouplingStep, Vector3d::Zero())
    {
        case_.writeDictionary("constant/couplingProperties",
            "fluid incompressible; modelType A; couplingTimeStep " + std::to_string(setup.interval)
                + (setup.adjustable
                        ? "; adjustableCouplingTimeStep yes; maxCo 1e9; minCouplingTimeStep 1e-3; maxCouplingTimeStep 1"
                        : "")
                + "; voidFractionModel divided; smoothingModel " + setup.smoothing + "; forceModels (" + setup.drag
                + ' ' + setup.pressureForce + " noViscousStress Archimedes); momCoupleModels (" + setup.momentumModel
                + "); useDDTvoidfraction off; DEM { engine liggghts; script none; }");
        mesh_ = boxMesh(case_.time(), point::zero, point::one, setup.cells);
        readFromCase<fvSchemes>(*mesh_);
        readFromCase<fvSolution>(*mesh_);
        addParticles(setup);
        const FluidProperties fluid{density, setup.viscosity, Vector3d::Zero()};
        settings_ = std::make_unique<CouplingSettings>(case_.time());
        models_ = std::make_unique<FluidModels>(*mesh_, *settings_, fluid, timers_);
        couplingStep_ =
            std::make_unique<CouplingStep>(*mesh_, *settings_, fluid, engine_, models_.get(), timers_, false);
        U_ = std::make_unique<volVectorField>(IOobject("U", case_.time().timeName(), *mesh_), *mesh_,
            dimensionedVector("U", dimVelocity, vector(0, 0, 0.1)), "zeroGradient");
        if (setup.wave)
        {
            U_->primitiveFieldRef() = vector(0, 0, 0.1) * wave();
        }
        p_ = std::make_unique<volScalarField>(IOobject("p", case_.time().timeName(), *mesh_), *mesh_,
            dimensionedScalar("p", dimPressure / dimDensity, 0), "zeroGradient");
        p_->primitiveFieldRef() = setup.pressureGradient * mesh_->C().primitiveField().component(vector::Z);
        p_->correctBoundaryConditions();
        couplingStep_->start(*U_, fvc::flux(*U_), *p_);
    }

    /// \param solved  what becomes of the particles' source before it is put into the equation
    /// \param nextSteps  DEM steps of the next coupling step if its length is adjustable: at most a fifth or one more than
    ///                   this one has
    void advance(const std::function<void(fvVectorMatrix&)>& solved, int nextSteps = 0)
    {
        case_.time().setDeltaT(couplingStep_->lengthWithin(VGREAT), false);
        ++case_.time();
        U_->storeOldTime();
        const double timeLeft = nextSteps > 0 ? nextSteps * engine_.timeStep() : VGREAT;
        ParticlesInFluid particles = couplingStep_->advanceParticles(timeLeft);
        fvVectorMatrix source(particles.momentumSource(*U_));
        solved(source);
        solve(fvm::ddt(particles.voidFraction(), *U_) == source + particles.sourceOfPressure(*p_));
        couplingStep_->fluidToParticles(recordWithoutContinuity(particles, source, *U_, *p_), *U_, fvc::flux(*U_), *p_);
    }

    /// Between so many particles [kg].
    static double waterMass(int particles)
    {
        return density * (1 - particles * sphereVolume(radius));
    }

    FaultyEngine& engine()
    {
        return engine_;
    }

    /// Of the last coupling step, relative to the sum of the magnitudes.
    double pressureForceError() const
    {
        return couplingStep_->conservation().pressureForceError();
    }

    /// Length of the coupling step that was advanced over last [s].
    double lastTimeStep() const
    {
        return case_.time().deltaTValue();
    }

    /// Mean velocity of the water [m/s].
    double waterSpeed() const
    {
        return average(*U_).value().z();
    }

    /// Of the wave [m/s].
    double amplitude() const
    {
        return 2 * average(U_->primitiveField().component(vector::Z) * wave());
    }

    /// Of water and particles, and what is on its way between them [N s].
    double momentum()
    {
        const ParticlesView particles = engine_.particles();
        const scalarField voidFraction(couplingStep_->fluid().voidFraction().primitiveField());
        return density * sum(mesh_->V().field() * voidFraction * U_->primitiveField().component(vector::Z))
               + (particles.velocity.row(2).array() * particles.mass.transpose()).sum()
               + couplingStep_->conservation().semiImplicitMomentum().sum.z();
    }

private:
    void addParticles(const StreamSetup& setup)
    {
        const auto [nx, ny, nz] = setup.particles;
        for (int particle = 0; particle < nx * ny * nz; ++particle)
        {
            engine_.addParticle(particle + 1,
                Vector3d(
                    (particle % nx + 0.5) / nx, (particle / nx % ny + 0.5) / ny, (particle / (nx * ny) + 0.5) / nz),
                radius, setup.particleDensity);
            if (setup.fixed)
            {
                engine_.holdParticle(particle + 1);
            }
        }
    }

    tmp<scalarField> wave() const
    {
        return cos(constant::mathematical::pi * mesh_->C().primitiveField().component(vector::X));
    }

    TemporaryCase case_;
    std::unique_ptr<fvMesh> mesh_;
    PhaseTimers timers_;
    FaultyEngine engine_;
    std::unique_ptr<CouplingSettings> settings_;
    std::unique_ptr<FluidModels> models_;
    std::unique_ptr<CouplingStep> couplingStep_;
    std::unique_ptr<volVectorField> U_;
    std::unique_ptr<volScalarField> p_;
};

} // namespace clepsydra::tests
