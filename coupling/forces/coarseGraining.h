#pragma once

#include "closures/parcelScaling.h"
#include "runTimeSelection.h"

namespace clepsydra
{

inline const ModelLines coarseGrainings(
    "coarseGraining", {{"1", "the spheres of the DEM script are the particles (the default)"},
                          {"<ratio>", "they are parcels of ratio^3 particles with the diameter divided by the ratio"}});

/// Reads the entry `coarseGraining` of couplingProperties, the diameter of the DEM script's spheres divided by that of
/// the real particles; see closures/parcelScaling.h. 1 where the entry is absent. FatalIOError for a number below 1 or
/// above 1000.
inline double readCoarseGraining(const Foam::dictionary& couplingProperties)
{
    constexpr double largest = 1000;
    const double ratio = couplingProperties.getOrDefault<double>("coarseGraining", 1);
    if (!(ratio >= 1 && ratio <= largest))
    {
        FatalIOErrorInFunction(couplingProperties)
            << "Entry 'coarseGraining' is " << ratio << "; allowed: a number from 1 to " << largest
            << ", the diameter of the DEM script's spheres divided by that of the real particles"
            << Foam::exit(Foam::FatalIOError);
    }
    return ratio;
}

} // namespace clepsydra
