// The fluid's continuity: the volume imbalance of a closed tank is subtracted evenly from all cells and recorded, and a
// continuity error above the tolerance ends the run.

#include "conservation/faults.h"

#include "couplingStep/voidFractionRate.h"
#include "conservation/conservationCheck.h"

namespace clepsydra::tests
{

namespace
{

constexpr double interval = 0.01;
constexpr int cellCount = 4;

/// A tank of one cubic metre, four cells, in which the void fraction of one cell has just risen by .04.
class ClosedTank : public testing::Test
{
protected:
    ClosedTank()
        : case_("deltaT " + std::to_string(interval) + ";")
    {
        case_.writeDictionary("constant/couplingProperties",
            "fluid incompressible; modelType A; couplingTimeStep " + std::to_string(interval)
                + "; voidFractionModel divided; smoothingModel off; forceModels (Archimedes); "
                  "momCoupleModels (implicitCouple); DEM { engine liggghts; script none; }");
        mesh_ = boxMesh(case_.time(), point::zero, point::one, {cellCount, 1, 1});
        readFromCase<fvSchemes>(*mesh_);
        voidFraction_ = std::make_unique<volScalarField>(IOobject("eps", case_.time().timeName(), *mesh_), *mesh_,
            dimensionedScalar("eps", dimless, 0.5), "zeroGradient");
        rate_ = std::make_unique<VoidFractionRate>(*mesh_, CouplingSettings(case_.time()));
        rate_->start(*voidFraction_);
        (*voidFraction_)[2] += 0.04;
        rate_->update(*voidFraction_, Eigen::MatrixXd::Zero(VoidFractionRate::rowCount, cellCount), interval);
    }

    static dictionary withTolerance(const word& entry, double value)
    {
        dictionary couplingProperties;
        dictionary conservation;
        conservation.add(entry, value);
        couplingProperties.add("conservationCheck", conservation);
        return couplingProperties;
    }

    TemporaryCase case_;
    std::unique_ptr<fvMesh> mesh_;
    std::unique_ptr<volScalarField> voidFraction_;
    std::unique_ptr<VoidFractionRate> rate_;
};

} // namespace

// .04 of a quarter of the tank in .01 s is one tank per second. Where nothing is spread, the fullest cell keeps its 4/s
// and the others their zero, and a linear solver finds the sink in its reference cell.
TEST_F(ClosedTank, TakesAnImbalanceEvenlyFromAllCells)
{
    EXPECT_NEAR(rate_->spreadImbalance(0), 1, 1e-12);
    for (label cell = 0; cell < cellCount; ++cell)
    {
        EXPECT_NEAR(rate_->withoutImplicit()[cell], cell == 2 ? 3 : -1, 1e-12) << "cell " << cell;
    }
    EXPECT_NEAR(rate_->spreadImbalance(0), 0, 1e-12) << "there is nothing left to spread";
}

// What the boundary lets out counts: a tank that takes in what the particles leave is balanced.
TEST_F(ClosedTank, CountsWhatTheBoundaryLetsOut)
{
    EXPECT_NEAR(rate_->spreadImbalance(-1), 0, 1e-12);
    EXPECT_NEAR(rate_->withoutImplicit()[2], 4, 1e-12) << "nothing was to be spread";
    EXPECT_NEAR(rate_->spreadImbalance(0.5), 1.5, 1e-12);
}

// Imbalances add up with their signs: it is the tank's content that matters, not a noise about it.
TEST_F(ClosedTank, StopsWhereTheImbalancesAddUpToMoreThanTheTolerance)
{
    ConservationCheck conservation(withTolerance("imbalanceTolerance", 0.01), case_.time());
    for (const double imbalance : {0.009, -0.009, 0.009})
    {
        EXPECT_NO_THROW(conservation.recordImbalance(imbalance));
    }
    expectFound([&] { conservation.recordImbalance(0.002); }, "imbalanceTolerance");
}

// One cell in four is wrong by .04 in a coupling step: .01 of the volume in the mean. A mean with signs would find
// nothing where another cell lacks as much.
TEST_F(ClosedTank, StopsWhereFluidIsMadeOfNothing)
{
    volScalarField error("error", interval * rate_->withoutImplicit());
    error[0] = -error[2];
    EXPECT_NO_THROW(
        ConservationCheck(withTolerance("continuityTolerance", 0.021), case_.time()).recordContinuity(error));
    expectFound(
        [&] { ConservationCheck(withTolerance("continuityTolerance", 0.019), case_.time()).recordContinuity(error); },
        "continuityTolerance");
}

} // namespace clepsydra::tests
