// The fluid's continuity: the volume imbalance of a closed tank is subtracted evenly from all cells and recorded, and a
// continuity error above the tolerance ends the run.

#include "conservation/faults.h"

#include "couplingStep/voidFractionRate.h"
#include "conservation/conservationCheck.h"

#include <cmath>

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
    explicit ClosedTank(const std::string& lowPass = "")
        : case_("deltaT " + std::to_string(interval) + ";")
    {
        case_.writeDictionary("constant/couplingProperties",
            "fluid incompressible; modelType A; couplingTimeStep " + std::to_string(interval)
                + "; voidFractionModel divided; smoothingModel off; forceModels (Archimedes); "
                  "momCoupleModels (implicitCouple); DEM { engine liggghts; script none; } "
                + lowPass);
        mesh_ = boxMesh(case_.time(), point::zero, point::one, {cellCount, 1, 1});
        readFromCase<fvSchemes>(*mesh_);
        voidFraction_ = std::make_unique<volScalarField>(IOobject("eps", case_.time().timeName(), *mesh_), *mesh_,
            dimensionedScalar("eps", dimless, 0.5), "zeroGradient");
        rate_ = std::make_unique<VoidFractionRate>(*mesh_, CouplingSettings(case_.time()));
        rate_->start(*voidFraction_);
        (*voidFraction_)[2] += 0.04;
        update();
    }

    void update()
    {
        RankTotals totals;
        rate_->update(*voidFraction_, Eigen::MatrixXd::Zero(VoidFractionRate::rowCount, cellCount),
            Eigen::RowVectorXd::Zero(cellCount), interval, totals);
        totals.reduce();
    }

    /// Ends a step in which the pressure moves no particle.
    void close()
    {
        rate_->close(surfaceScalarField(IOobject("none", case_.time().timeName(), *mesh_), *mesh_,
            dimensionedScalar("none", dimVolume / dimTime, 0)));
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

// Where nothing can pass the boundary the same is spread, without a reduction.
TEST_F(ClosedTank, TakesAnImbalanceWithoutAReductionWhereNothingPassesTheBoundary)
{
    const long before = RankTotals::reductions();
    EXPECT_NEAR(rate_->spreadImbalance(), 1, 1e-12);
    for (label cell = 0; cell < cellCount; ++cell)
    {
        EXPECT_NEAR(rate_->withoutImplicit()[cell], cell == 2 ? 3 : -1, 1e-12) << "cell " << cell;
    }
    EXPECT_NEAR(rate_->spreadImbalance(), 0, 1e-12) << "there is nothing left to spread";
    EXPECT_EQ(RankTotals::reductions(), before);
}

// What was spread is settled: it does not come back in the next step as if eps had not risen. A rate that forgets what was
// spread finds the same imbalance, one tank per second, in every later step.
TEST_F(ClosedTank, HasNothingLeftOfAnImbalanceInTheNextStep)
{
    rate_->spreadImbalance(0);
    close();
    update();
    EXPECT_NEAR(rate_->spreadImbalance(0), 0, 1e-12);
    for (label cell = 0; cell < cellCount; ++cell)
    {
        EXPECT_NEAR(rate_->withoutImplicit()[cell], 0, 1e-12) << "cell " << cell;
    }
}

namespace
{

constexpr double smoothingTime = 0.05;

class FilteredTank : public ClosedTank
{
protected:
    FilteredTank()
        : ClosedTank("useDDTvoidfractionProps { smoothingTime " + std::to_string(smoothingTime) + "; }")
    {}
};

} // namespace

// Behind a low-pass of T the rise of eps reaches the fluid as exp(-t/T): in step n the part
// (1 - exp(-dt/T)) exp(-n dt/T) of it, all of which is spread over the tank, and in the end .01 of the tank has been. Were
// what is spread forgotten, a fifth of all would be added in each step, for ever.
TEST_F(FilteredTank, SpreadsWhatPassesTheFilterOnce)
{
    const double passes = 1 - std::exp(-interval / smoothingTime);
    double spread = 0;
    for (int step = 0; step < 100; ++step)
    {
        const double expected = passes * std::exp(-step * interval / smoothingTime) * 1;
        const double imbalance = rate_->spreadImbalance(0);
        EXPECT_NEAR(imbalance, expected, 1e-12) << "step " << step;
        spread += interval * imbalance;
        close();
        update();
    }
    EXPECT_NEAR(spread, 0.01, 1e-9);
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
    const auto record = [&](double tolerance) {
        ConservationCheck conservation(withTolerance("continuityTolerance", tolerance), case_.time());
        RankTotals totals;
        conservation.addContinuity(error, totals);
        totals.reduce();
    };
    EXPECT_NO_THROW(record(0.021));
    expectFound([&] { record(0.019); }, "continuityTolerance");
}

} // namespace clepsydra::tests
