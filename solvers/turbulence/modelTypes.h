#pragma once

/// \file
/// The types of OpenFOAM's turbulence models for a fluid with a void fraction. OpenFOAM's macros make the names: they begin
/// with that of the transport model, and work inside OpenFOAM's namespace only.

#include "couplingStep/viscousStress.h"

#include "LESModel.H"
#include "RASModel.H"
#include "TurbulenceModel.H"
#include "addToRunTimeSelectionTable.H"
#include "incompressibleTurbulenceModel.H"
#include "laminarModel.H"
#include "makeTurbulenceModel.H"

namespace clepsydra
{

/// The viscosity of the fluid in the form in which OpenFOAM's turbulence models expect a transport model. It takes the
/// place of OpenFOAM's singlePhaseTransportModel, which reads `nu` itself and knows no stratification.
class FluidTransport
{
public:
    FluidTransport(const Foam::fvMesh& mesh, const FluidProperties& fluid)
        : nu_(kinematicViscosity(Foam::IOobject("nu", mesh.time().constant(), mesh, Foam::IOobject::NO_READ,
                                     Foam::IOobject::NO_WRITE, false),
            mesh, fluid))
    {}

    Foam::tmp<Foam::volScalarField> nu() const
    {
        return *nu_;
    }

    Foam::tmp<Foam::scalarField> nu(Foam::label patch) const
    {
        return nu_->boundaryField()[patch];
    }

    /// A Newtonian fluid's viscosity does not change.
    void correct()
    {}

private:
    std::unique_ptr<Foam::volScalarField> nu_;
};

/// What OpenFOAM's models of an eddy viscosity are derived from here: their equations have a volume fraction and no density.
/// OpenFOAM's own class of this kind is PhaseIncompressibleTurbulenceModel in v1912; that of later versions takes the
/// volume fraction for a density.
template<class Transport>
class VoidFractionTurbulenceModel : public Foam::TurbulenceModel<Foam::volScalarField, Foam::geometricOneField,
                                        Foam::incompressibleTurbulenceModel, Transport>
{
public:
    // Names that the models use.
    using alphaField = Foam::volScalarField;
    using rhoField = Foam::geometricOneField;
    using transportModel = Transport;
    using Base = Foam::TurbulenceModel<alphaField, rhoField, Foam::incompressibleTurbulenceModel, Transport>;

    VoidFractionTurbulenceModel(const Foam::word&, const alphaField& alpha, const rhoField& rho,
        const Foam::volVectorField& U, const Foam::surfaceScalarField& alphaRhoPhi, const Foam::surfaceScalarField& phi,
        const Transport& transport, const Foam::word& dictionaryName)
        : Base(alpha, rho, U, alphaRhoPhi, phi, transport, dictionaryName)
    {}

    // The models have the stress under the second names.
    Foam::tmp<Foam::volSymmTensorField> devReff() const override
    {
        return devRhoReff();
    }

    Foam::tmp<Foam::fvVectorMatrix> divDevReff(Foam::volVectorField& U) const override
    {
        return divDevRhoReff(U);
    }

    virtual Foam::tmp<Foam::volSymmTensorField> devRhoReff() const = 0;
    virtual Foam::tmp<Foam::fvVectorMatrix> divDevRhoReff(Foam::volVectorField& U) const = 0;

#if OPENFOAM >= 2006
    Foam::tmp<Foam::volSymmTensorField> devReff(const Foam::volVectorField& U) const override
    {
        return devRhoReff(U);
    }

    virtual Foam::tmp<Foam::volSymmTensorField> devRhoReff(const Foam::volVectorField& U) const = 0;
#endif
};

} // namespace clepsydra

namespace Foam
{
using clepsydra::FluidTransport;
using clepsydra::VoidFractionTurbulenceModel;
} // namespace Foam

makeTurbulenceModelTypes(
    volScalarField, geometricOneField, incompressibleTurbulenceModel, VoidFractionTurbulenceModel, FluidTransport)
