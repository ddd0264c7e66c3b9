#include "couplingStep/fluidCourantNumber.h"

#include "fvcSurfaceIntegrate.H"
#include "surfaceFields.H"

#include <algorithm>

namespace clepsydra
{

using namespace Foam;

void FluidCourantNumber::addTo(const surfaceScalarField& phi, double couplingTimeStep, RankTotals& totals)
{
    const scalarField perTime(0.5 * fvc::surfaceSum(mag(phi))().primitiveField() / phi.mesh().V().field());
    const auto aboveOne =
        std::count_if(perTime.begin(), perTime.end(), [&](double ofCell) { return couplingTimeStep * ofCell > 1; });
    totals.add({{static_cast<double>(aboveOne)}, {max(perTime)}}, [this](const RankNumbers& all) {
        cellsAboveOne_ = static_cast<label>(all.sums[0]);
        largestPerTime_ = all.maxima[0];
    });
}

} // namespace clepsydra
