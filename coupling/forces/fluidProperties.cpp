#include "forces/fluidProperties.h"

#include "runTimeSelection.h"

#include <algorithm>
#include <cmath>

namespace clepsydra
{

closures::Stratification readStratification(
    const dictionary& transportProperties, const Vector3d& gravity, const boundBox& mesh)
{
    closures::Stratification stratification;
    if (!transportProperties.found("stratification"))
    {
        return stratification;
    }
    // Viscosities of liquids differ by less than e to this power.
    constexpr double largest = 20;
    const dictionary& dict = transportProperties.subDict("stratification");
    requireKnownEntries(dict, {"height", "width", "step", "lag", "gradient"});
    const auto within = [&](const word& entry, double limit) {
        const double value = dict.getOrDefault<double>(entry, 0);
        if (!(std::abs(value) <= limit))
        {
            FatalIOErrorInFunction(dict) << "Entry '" << entry << "' is " << value << "; allowed: a number from "
                                         << -limit << " to " << limit << exit(FatalIOError);
        }
        return value;
    };
    dict.get<double>("height");
    stratification.height = within("height", 1e6);
    stratification.width = positiveEntry(dict, "width");
    stratification.step = within("step", largest);
    stratification.lag = within("lag", 1e3);
    const double farthest = std::max(mag(mesh.min()), mag(mesh.max())) + std::abs(stratification.height);
    stratification.gradient = within("gradient", largest / farthest);
    if (stratification.isThere() && gravity.isZero())
    {
        FatalIOErrorInFunction(dict) << "Entry 'stratification' needs gravity, which is 0 in constant/g; allowed: a "
                                     << "gravity that is not zero, because the layers are perpendicular to it"
                                     << exit(FatalIOError);
    }
    return stratification;
}

} // namespace clepsydra
