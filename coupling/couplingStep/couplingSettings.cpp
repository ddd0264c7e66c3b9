#include "couplingStep/couplingSettings.h"

#include "distribution/smoothingModel.h"
#include "distribution/voidFractionModel.h"
#include "forces/coarseGraining.h"
#include "forces/forceModel.h"
#include "couplingStep/dictionaryText.h"
#include "openfoam/compatibility.h"

#include "runTimeSelection.h"

#include <cmath>

namespace clepsydra
{

namespace
{

const ModelLines fluids(
    "fluid", {{"incompressible", "solved by PIMPLE"}, {"none", "DEM only: the particles move without fluid"}});
const ModelLines momentumCouplings(
    "momCoupleModels", {{"implicitCouple", "the fluid's equation holds the drag of the next coupling step"},
                           {"explicitCouple", "the fluid receives the drag afterwards: short coupling steps only"}});

/// Relative tolerance in comparisons of times, because decimal fractions are rounded.
constexpr double sameTime = 1e-6;

/// The given names and <model>Props of every model: coefficients of a model that is not selected may stay in the file.
wordList coefficientsOfModels(wordList names)
{
    for (const wordList& models : {ForceModel::dictionaryConstructorTablePtr_->sortedToc(),
             VoidFractionModel::dictionaryConstructorTablePtr_->sortedToc(),
             SmoothingModel::dictionaryConstructorTablePtr_->sortedToc()})
    {
        for (const word& model : models)
        {
            names.append(model + "Props");
        }
    }
    return names;
}

/// The IOdictionary that is constructed from this reports a missing file.
IOobject couplingProperties(const Time& time)
{
    IOobject object("couplingProperties", time.constant(), time, IOobject::MUST_READ, IOobject::NO_WRITE);
    checkDictionaryText(clepsydra::typeFilePath<IOdictionary>(object));
    return object;
}

} // namespace

CouplingSettings::CouplingSettings(const Time& time)
    : time_(time),
      dict_(couplingProperties(time))
{
    requireKnownEntries(dict_,
        {"fluid", "couplingTimeStep", "adjustableCouplingTimeStep", "maxCo", "minCouplingTimeStep",
            "maxCouplingTimeStep", "modelType", "voidFractionModel", "smoothingModel", "selfInducedVelocityCorrection",
            "turbulentDispersion", "forceModels", "momCoupleModels", "useDDTvoidfraction", "particleOutlets",
            "insertionTime", "allowParticlesOutsideMesh", "coarseGraining", "meanPressureGradient",
            "patchesWithoutDemWall"},
        coefficientsOfModels({"useDDTvoidfractionProps", "turbulentDispersionProps", "DEM", "energy", "particleOutput",
            "conservationCheck"}));
    requireKnownEntries(dict_.subDict("DEM"),
        {"engine", "script", "writeRestart", "maxRayleighFraction", "allowedInScript"}, {"variables", "groupChanges"});
    requireKnownEntries(dict_.subOrEmptyDict("particleOutput"), {"writeVtk"});
    readChoices();
    checkTimeStep();
}

void CouplingSettings::readChoices()
{
    couplingTimeStep_ = positiveEntry(dict_, "couplingTimeStep");
    coarseGraining_ = readCoarseGraining(dict_);
    hasFluid_ = selectedModel(dict_, "fluid", fluids.names()) != "none";
    if (!hasFluid_)
    {
        return;
    }
    readAdjustableCouplingTimeStep();
    modelType_ = readModelType(dict_);
    ddtVoidFraction_ = dict_.getOrDefault<Switch>("useDDTvoidfraction", true);
    particlesOutsideMesh_ = dict_.getOrDefault<Switch>("allowParticlesOutsideMesh", false);

    const dictionary ddtProps = dict_.subOrEmptyDict("useDDTvoidfractionProps");
    requireKnownEntries(ddtProps, {"smoothingTime"});
    if (ddtProps.found("smoothingTime"))
    {
        ddtSmoothingTime_ = positiveEntry(ddtProps, "smoothingTime", true);
    }

    const wordList momentumModels = dict_.get<wordList>("momCoupleModels");
    if (momentumModels.size() != 1)
    {
        FatalIOErrorInFunction(dict_) << "Entry 'momCoupleModels' lists " << momentumModels.size()
                                      << " models; allowed: one of (implicitCouple explicitCouple)"
                                      << exit(FatalIOError);
    }
    requireKnownName(dict_, "momCoupleModels", momentumModels.first(), momentumCouplings.names());
    implicitCoupling_ = momentumModels.first() == "implicitCouple";

    const dictionary voidFractionProps = dict_.subOrEmptyDict(dict_.get<word>("voidFractionModel") + "Props");
    if (voidFractionProps.found("alphaMin"))
    {
        minimumVoidFraction_ = positiveEntry(voidFractionProps, "alphaMin");
    }
}

void CouplingSettings::readAdjustableCouplingTimeStep()
{
    if (!dict_.found("adjustableCouplingTimeStep"))
    {
        for (const word entry : {"maxCo", "minCouplingTimeStep", "maxCouplingTimeStep"})
        {
            if (dict_.found(entry))
            {
                FatalIOErrorInFunction(dict_)
                    << "Entry '" << entry << "' has no effect without 'adjustableCouplingTimeStep'; "
                    << "allowed: together with adjustableCouplingTimeStep yes (or no)" << exit(FatalIOError);
            }
        }
        return;
    }
    if (!dict_.get<Switch>("adjustableCouplingTimeStep"))
    {
        return;
    }
    adjustableCouplingTimeStep_ = AdjustableCouplingTimeStep{positiveEntry(dict_, "maxCo"),
        positiveEntry(dict_, "minCouplingTimeStep"), positiveEntry(dict_, "maxCouplingTimeStep")};
    const auto [largestCourantNumber, shortest, longest] = *adjustableCouplingTimeStep_;
    if (shortest > longest)
    {
        FatalIOErrorInFunction(dict_) << "Entry 'minCouplingTimeStep' is " << shortest
                                      << " s; allowed: at most maxCouplingTimeStep, "
                                      << "which is " << longest << " s" << exit(FatalIOError);
    }
    if (couplingTimeStep_ < shortest * (1 - sameTime) || couplingTimeStep_ > longest * (1 + sameTime))
    {
        FatalIOErrorInFunction(dict_) << "Entry 'couplingTimeStep' is " << couplingTimeStep_
                                      << " s; allowed: from minCouplingTimeStep to maxCouplingTimeStep, " << shortest
                                      << " to " << longest << " s, because it is the first coupling step"
                                      << exit(FatalIOError);
    }
}

void CouplingSettings::checkTimeStep() const
{
    if (time_.controlDict().getOrDefault<Switch>("adjustTimeStep", false))
    {
        FatalIOErrorInFunction(time_.controlDict())
            << "Entry 'adjustTimeStep' is on; allowed: off, because the fluid's time step is the coupling step, which "
            << "adapts by adjustableCouplingTimeStep in constant/couplingProperties" << exit(FatalIOError);
    }
    if (std::abs(time_.deltaTValue() / couplingTimeStep_ - 1) > sameTime)
    {
        FatalIOErrorInFunction(dict_) << "Entry 'couplingTimeStep' is " << couplingTimeStep_
                                      << " s; allowed: the value of deltaT in system/controlDict, which is "
                                      << time_.deltaTValue() << " s" << exit(FatalIOError);
    }
}

std::vector<std::string> CouplingSettings::descriptions() const
{
    if (!hasFluid_)
    {
        return {"fluid          none: DEM only"};
    }
    return {
        "equations      model " + std::string(dict_.get<word>("modelType")) + ", pressure without its hydrostatic part",
        adjustableCouplingTimeStep_ ? "coupling step  adjustable, Courant numbers up to "
                                          + std::to_string(adjustableCouplingTimeStep_->largestCourantNumber)
                                    : std::string("coupling step  constant"),
        "momentum       " + std::string(implicitCoupling_ ? "implicitCouple" : "explicitCouple"),
        "alphaMin       " + std::to_string(minimumVoidFraction_),
        ddtVoidFraction_
            ? "d(eps)/dt      in continuity, smoothingTime " + std::to_string(ddtSmoothingTime_) + " s"
            : std::string("d(eps)/dt      OFF: WARNING, dilation of the particles does not move the fluid, so a "
                          "submerged hopper has no surge")
                  + (ddtSmoothingTime_ > 0 ? "; smoothingTime has no effect" : ""),
        particlesOutsideMesh_
            ? "particles      may be in parts of the DEM box without mesh, where no fluid acts on them"
            : "particles      must be in the mesh",
        "drag in DEM    at every DEM step, from the particle's present velocity and the frozen fluid"};
}

fileName CouplingSettings::finalRestart() const
{
    return dict_.subDict("DEM").getOrDefault<fileName>("writeRestart", fileName::null);
}

int CouplingSettings::demStepsPerCouplingStep(double demTimeStep) const
{
    return static_cast<int>(wholeSteps(dict_, "couplingTimeStep", couplingTimeStep_, demTimeStep));
}

double CouplingSettings::wholeSteps(const dictionary& dict, const word& entry, double time, double demTimeStep) const
{
    const double steps = time / demTimeStep;
    if (steps < 0.5 || std::abs(steps - std::round(steps)) > sameTime * steps)
    {
        FatalIOErrorInFunction(dict) << "Entry '" << entry << "' is " << time
                                     << " s; allowed: a whole multiple of the DEM step, which is " << demTimeStep
                                     << " s in the script " << demDict().get<fileName>("script").c_str()
                                     << exit(FatalIOError);
    }
    return std::round(steps);
}

} // namespace clepsydra
