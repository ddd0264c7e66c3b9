#pragma once

#include "run/demTimeScales.h"

#include "dictionary.H"

#include <string>
#include <vector>

namespace clepsydra
{

/// Prints what a run consists of: versions, models with their coefficients, time scales and whether the steps respect
/// them. To OpenFOAM's log, so by the master rank only.
/// \param models  one line each
/// \param demDict  the DEM sub-dictionary of couplingProperties, for the limit of checkDemStep()
void printStartReport(const DemEngine& engine, const std::vector<std::string>& models, const DemTimeScales& scales,
    const Foam::dictionary& demDict);

/// FatalIOError, naming file and entry, if the DEM step is above the stable one: more than `maxRayleighFraction`
/// (default 0.4) of the Rayleigh time. Passes where the Rayleigh time is not known (yet).
/// \param demDict  the DEM sub-dictionary of couplingProperties
void checkDemStep(const DemTimeScales& scales, const Foam::dictionary& demDict);

} // namespace clepsydra
