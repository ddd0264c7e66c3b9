#pragma once

#include "forces/modelType.h"

#include "IOdictionary.H"
#include "Switch.H"
#include "Time.H"
#include "fvMesh.H"

#include <optional>
#include <string>
#include <vector>

namespace clepsydra
{

/// Limits of an adjustable coupling step (`adjustableCouplingTimeStep yes;`), from the entries `maxCo`,
/// `minCouplingTimeStep` and `maxCouplingTimeStep`.
struct AdjustableCouplingTimeStep
{
    double largestCourantNumber;
    double shortest; ///< [s]
    double longest;  ///< [s]
};

/// The entries of constant/couplingProperties, checked. Entries that are members here are read only here. Models that
/// are selected by name, the outlets, the conservation check and the engine read their entries from dict().
///
/// FatalIOError that names the file, the entry and what is allowed where an entry is missing or wrong.
class CouplingSettings
{
public:
    explicit CouplingSettings(const Foam::Time& time);

    const Foam::IOdictionary& dict() const
    {
        return dict_;
    }

    /// False for DEM only (`fluid none;`).
    bool hasFluid() const
    {
        return hasFluid_;
    }

    /// Form of the fluid's equations; A where there is no fluid.
    ModelType modelType() const
    {
        return modelType_;
    }

    /// Diameter of the DEM script's spheres divided by that of the real particles, see forces/coarseGraining.h.
    double coarseGraining() const
    {
        return coarseGraining_;
    }

    /// Time between exchanges of particles and fluid [s], which equals the fluid's time step. Where
    /// adjustableCouplingTimeStep() has a value, it is the length of the first coupling step only.
    double couplingTimeStep() const
    {
        return couplingTimeStep_;
    }

    /// Limits of the coupling step; empty where its length is constant, and for DEM only.
    const std::optional<AdjustableCouplingTimeStep>& adjustableCouplingTimeStep() const
    {
        return adjustableCouplingTimeStep_;
    }

    /// Whether d(eps)/dt is part of the fluid's continuity equation.
    bool ddtVoidFraction() const
    {
        return ddtVoidFraction_;
    }

    /// Time constant of the low-pass filter through which the void fraction enters d(eps)/dt [s]; 0 for none.
    double ddtSmoothingTime() const
    {
        return ddtSmoothingTime_;
    }

    /// Whether particles may be in parts of the DEM box without mesh, where no fluid acts on them.
    bool particlesOutsideMesh() const
    {
        return particlesOutsideMesh_;
    }

    /// Whether the drag is implicit in the fluid's momentum equation.
    bool implicitCoupling() const
    {
        return implicitCoupling_;
    }

    /// Void fractions below this value are clipped; the conservation check reports the clipped volume.
    double minimumVoidFraction() const
    {
        return minimumVoidFraction_;
    }

    /// Whether the particles are written for ParaView at write times: `particleOutput { writeVtk on; }`, off by
    /// default.
    bool writeVtk() const
    {
        return dict_.subOrEmptyDict("particleOutput").getOrDefault<Foam::Switch>("writeVtk", false);
    }

    /// The choices in this file for the report at the start of the log, one line each.
    std::vector<std::string> descriptions() const;

    /// File for the particles at the end of the run; empty for none.
    Foam::fileName finalRestart() const;

    /// Number of DEM steps in a coupling step. FatalIOError where the coupling step is not a whole multiple of the DEM
    /// step.
    int demStepsPerCouplingStep(double demTimeStep) const;

    /// Number of DEM steps in a time [s] that an entry of `dict` states. FatalIOError where the time is not a whole
    /// multiple of the DEM step.
    double wholeSteps(const Foam::dictionary& dict, const Foam::word& entry, double time, double demTimeStep) const;

    const Foam::dictionary& demDict() const
    {
        return dict_.subDict("DEM");
    }

private:
    void readChoices();
    void readAdjustableCouplingTimeStep();
    void checkTimeStep() const;

    const Foam::Time& time_;
    Foam::IOdictionary dict_;
    bool hasFluid_ = true;
    ModelType modelType_ = ModelType::A;
    double coarseGraining_ = 1;
    double couplingTimeStep_ = 0;
    std::optional<AdjustableCouplingTimeStep> adjustableCouplingTimeStep_;
    bool ddtVoidFraction_ = true;
    bool particlesOutsideMesh_ = false;
    double ddtSmoothingTime_ = 0;
    bool implicitCoupling_ = true;
    double minimumVoidFraction_ = 0.1;
};

} // namespace clepsydra
