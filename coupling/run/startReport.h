#pragma once

#include "run/demTimeScales.h"

#include "dictionary.H"

#include <string>
#include <vector>

namespace clepsydra
{

/// Prints the composition of a run to OpenFOAM's log: versions, models with their coefficients, the
/// equations that are solved, time scales, and
/// whether the steps resolve them.
/// \param models, equations  one line each
/// \param demDict  the DEM sub-dictionary of couplingProperties, for the limit of checkDemStep()
void printStartReport(const DemEngine& engine, const std::vector<std::string>& models,
    const std::vector<std::string>& equations, const DemTimeScales& scales, const Foam::dictionary& demDict);

/// FatalIOError, which names file and entry, where the DEM step is above the stable one: more than
/// `maxRayleighFraction` (default 0.4) of the Rayleigh time. Has no effect where the Rayleigh time is not known (yet).
/// \param demDict  the DEM sub-dictionary of couplingProperties
void checkDemStep(const DemTimeScales& scales, const Foam::dictionary& demDict);

} // namespace clepsydra
