#include "pimpleDemFoam/ignoredInputs.h"
#include "pimpleDemFoam/turbulence.h"
#include "turbulence/modelTypes.h"

#include "Stokes.H"
#include "fvOptions.H"
#include "fvcDdt.H"
#include "fvcDiv.H"
#include "fvmSup.H"

#include <array>

// The tables from which turbulenceProperties selects, and the laminar model, without which OpenFOAM's table of laminar
// models would be empty.
makeBaseTurbulenceModel(
    volScalarField, geometricOneField, incompressibleTurbulenceModel, VoidFractionTurbulenceModel, FluidTransport);

makeTemplatedTurbulenceModel(FluidTransportVoidFractionTurbulenceModel, laminar, Stokes);

namespace clepsydra
{

using namespace Foam;

namespace
{

/// Fields for which the models solve a transport equation.
constexpr std::array<const char*, 8> transported = {
    "k", "epsilon", "omega", "nuTilda", "ReThetat", "gammaInt", "flm", "fmm"};

wordList transportedFields(const fvMesh& mesh)
{
    wordList names;
    for (const char* name : transported)
    {
        if (mesh.foundObject<volScalarField>(name))
        {
            names.append(name);
        }
    }
    return names;
}

/// Subtracts the continuity error times the field from the equation of each transported field, as the momentum equation
/// does: the void fraction changes over one coupling step and the flux balances that of another, so that a uniform k
/// would otherwise be changed by particles that move. The models' equations have this one opening for a term.
class ContinuityError : public fv::option
{
public:
    ContinuityError(const fvMesh& mesh, const surfaceScalarField& alphaPhi)
        : option("continuityError", "continuityError", dictionary(), mesh),
          alphaPhi_(alphaPhi)
    {
        fieldNames_ = transportedFields(mesh);
        // No warning where `turbulence off` keeps the equations from being solved.
        applied_ = List<bool>(fieldNames_.size(), true);
    }

    using option::addSup;

    void addSup(const volScalarField& alpha, const volScalarField&, fvMatrix<scalar>& eqn, const label) override
    {
        eqn += fvm::Sp(fvc::ddt(alpha) + fvc::div(alphaPhi_), eqn.psi());
    }

private:
    const surfaceScalarField& alphaPhi_;
};

/// OpenFOAM would read options again that change in the file, and would look for ContinuityError in it.
void stopReading(fv::options& options)
{
    options.watchIndices().clear();
}

class TurbulenceWithVoidFraction : public FluidTurbulence
{
public:
    TurbulenceWithVoidFraction(const TurbulentFluid& fluid, bool resumed)
        : transport_(fluid.U.mesh(), fluid.properties),
          // Its name makes the schemes' names those of single-phase solvers, as div(phi,k). Not registered, because
          // the registered phi is the flux of U.
          alphaPhi_(
              IOobject("phi", fluid.U.time().timeName(), fluid.U.mesh(), IOobject::NO_READ, IOobject::NO_WRITE, false),
              fluid.alphaPhi),
          model_(Model::New(fluid.voidFraction, geometricOneField(), fluid.U, alphaPhi_, fluid.phi, transport_,
              turbulenceModel::propertiesName))
    {
        const fvMesh& mesh = fluid.U.mesh();
        for (const word& name : transportedFields(mesh))
        {
            checkSchemes(mesh, name);
        }
        fv::options& options = fv::options::New(mesh);
        stopReading(options);
        static_cast<fv::optionList&>(options).append(new ContinuityError(mesh, alphaPhi_));
        if (!resumed)
        {
            model_->validate();
        }
    }

    void correct(const surfaceScalarField& alphaPhi) override
    {
        alphaPhi_ = alphaPhi;
        model_->correct();
    }

    const volScalarField& eddyViscosity() const override
    {
        return alphaPhi_.mesh().lookupObject<volScalarField>("nut");
    }

    tmp<volScalarField> k() const override
    {
        return model_->k();
    }

    tmp<volScalarField> dissipation() const override
    {
        return model_->epsilon();
    }

private:
    using Model = VoidFractionTurbulenceModel<FluidTransport>::Base;

    FluidTransport transport_;
    surfaceScalarField alphaPhi_;
    autoPtr<Model> model_;
};

} // namespace

} // namespace clepsydra

extern "C" clepsydra::FluidTurbulence* clepsydraNewFluidTurbulence(
    const clepsydra::TurbulentFluid& fluid, bool resumed);

clepsydra::FluidTurbulence* clepsydraNewFluidTurbulence(const clepsydra::TurbulentFluid& fluid, bool resumed)
{
    return new clepsydra::TurbulenceWithVoidFraction(fluid, resumed);
}
