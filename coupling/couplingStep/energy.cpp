#include "couplingStep/energy.h"

#include "couplingStep/heatTransferModel.h"

#include "dimensionedScalar.H"
#include "runTimeSelection.h"

namespace clepsydra
{

namespace
{

const dimensionSet dimHeatCapacity(0, 2, -2, -1, 0);
const dimensionSet dimConductivity(1, 1, -3, -1, 0);

double positiveWithDimensions(const dictionary& dict, const word& entry, const dimensionSet& dimensions)
{
    const double value = dimensionedScalar(entry, dimensions, dict).value();
    requirePositive(dict, entry, value);
    return value;
}

std::optional<double> positiveIfThere(const dictionary& dict, const word& entry)
{
    return dict.found(entry) ? std::optional<double>(positiveEntry(dict, entry)) : std::nullopt;
}

void refuseThermalEntries(const dictionary& transportProperties)
{
    for (const word entry : {"Cp", "kappa", "Prt", "beta", "TRef"})
    {
        if (transportProperties.found(entry))
        {
            FatalIOErrorInFunction(transportProperties)
                << "Entry '" << entry << "' has no effect without the dictionary 'energy' in couplingProperties; "
                << "allowed: together with it" << exit(FatalIOError);
        }
    }
}

ThermalProperties readThermalProperties(const dictionary& dict, ModelType modelType, bool turbulent)
{
    ThermalProperties thermal{
        positiveWithDimensions(dict, "Cp", dimHeatCapacity), positiveWithDimensions(dict, "kappa", dimConductivity)};
    if (dict.found("Prt"))
    {
        if (!turbulent)
        {
            FatalIOErrorInFunction(dict) << "Entry 'Prt' has no effect in laminar flow; allowed: with a model in "
                                         << "constant/turbulenceProperties" << exit(FatalIOError);
        }
        thermal.turbulentPrandtlNumber = positiveWithDimensions(dict, "Prt", dimless);
    }
    if (dict.found("beta") != dict.found("TRef"))
    {
        FatalIOErrorInFunction(dict)
            << "There is only one of the entries 'beta' and 'TRef'; allowed: both, for a fluid "
            << "whose density depends on its temperature, or none" << exit(FatalIOError);
    }
    if (dict.found("beta"))
    {
        thermal.expansion = positiveWithDimensions(dict, "beta", dimless / dimTemperature);
        thermal.referenceTemperature = positiveWithDimensions(dict, "TRef", dimTemperature);
        if (modelType == ModelType::B)
        {
            FatalIOErrorInFunction(dict) << "There is the entry 'beta', and 'modelType' of couplingProperties is B; "
                                         << "allowed: modelType A, in which the pressure gradient gives the particles "
                                         << "the buoyancy of the warm fluid" << exit(FatalIOError);
        }
    }
    return thermal;
}

} // namespace

bool hasEnergy(const CouplingSettings& settings)
{
    return settings.hasFluid() && settings.dict().found("energy");
}

std::optional<Energy> readEnergy(
    const CouplingSettings& settings, const dictionary& transportProperties, bool turbulent)
{
    if (!hasEnergy(settings))
    {
        refuseThermalEntries(transportProperties);
        return std::nullopt;
    }
    const dictionary& dict = settings.dict().subDict("energy");
    requireKnownEntries(dict, {"heatTransferModel", "particleCp", "particleTemperature"});
    HeatTransferModel::New(dict); // so that a wrong name is found before the engine starts
    if (!settings.ddtVoidFraction())
    {
        FatalIOErrorInFunction(settings.dict())
            << "Entry 'useDDTvoidfraction' is off, and there is the dictionary 'energy'; allowed: on, because heat is "
            << "conserved only where the fluid's volume is" << exit(FatalIOError);
    }
    return Energy{dict, readThermalProperties(transportProperties, settings.modelType(), turbulent),
        {positiveIfThere(dict, "particleTemperature"), positiveIfThere(dict, "particleCp")}, settings.coarseGraining()};
}

} // namespace clepsydra
