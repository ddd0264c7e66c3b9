#include "curves/table.h"
#include "effects/measuringChain.h"
#include "features/features.h"
#include "temporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace clepsydra::identification::tests
{

namespace
{

double feature(const std::string& kind, const Curve& curve, FeatureKind::Parameters parameters)
{
    const FeatureKind& k = featureKinds().at(kind);
    for (const auto& parameter : k.parameters)
    {
        parameters.emplace(parameter.name, parameter.byDefault);
    }
    return k.value(curve, parameters);
}

template<class Function>
Curve sampled(double end, int points, Function function)
{
    Curve curve;
    for (int i = 0; i < points; ++i)
    {
        curve.time.push_back(end * i / (points - 1));
        curve.value.push_back(function(curve.time.back()));
    }
    return curve;
}

/// An OpenFOAM table of a run that was resumed at t = 2: the later part replaces the earlier one, and names have no
/// units.
TEST(Curves, ResumedRunIsOneCurve)
{
    const TemporaryFolder folder;
    folder.write("post/0/m.dat", "# time [s]\tmass [kg]\tparticles\n0\t1\t9\n1\t.9\t8\n2\t.7\t7\n3\t.1\t6\n");
    folder.write("post/2/m.dat", "# time [s]\tmass [kg]\tparticles\n2\t.8\t7\n3\t.6\t6\n");
    const Curve curve = readCurve(folder.path() / "post/*/m.dat", "time", "mass");
    EXPECT_EQ(curve.time, (std::vector<double>{0, 1, 2, 3}));
    EXPECT_EQ(curve.value, (std::vector<double>{1, 0.9, 0.8, 0.6}));
}

/// A feature of another column than the observable's has the values of that column, at its own times; in a record
/// without that column, as a measured one, there is none.
TEST(Curves, FurtherColumnsAreCurvesOfTheirOwn)
{
    const TemporaryFolder folder;
    const auto file = folder.write("bed.dat", "# time height pressure\n0\t1\t4\n1\tNA\t6\n2\t3\t8\n");
    const Curve curve = readCurve(file, "time", "height", {"pressure"});
    EXPECT_EQ(curve.time, (std::vector<double>{0, 2}));
    ASSERT_EQ(curve.others.size(), 1U);
    EXPECT_EQ(curve.others.front().value, (std::vector<double>{4, 6, 8}));
    const Feature pressure{"pressure", &featureKinds().at("logMaximum"), {}, 0};
    EXPECT_NEAR(pressure(curve), std::log(8), 1e-12);
    EXPECT_TRUE(std::isnan(pressure({curve.time, curve.value})));
}

TEST(Curves, CsvWithGapsAndErrorsWithTheirLine)
{
    const TemporaryFolder folder;
    const auto file = folder.write("a.csv", "t_s,m_g\n0,10\n1,\n2,NA\n3,7\n");
    const Table table = readTable(file);
    EXPECT_EQ(
        tidied({table.columns[table.index("t_s")], table.columns[table.index("2")]}).time, (std::vector<double>{0, 3}));
    const auto broken = folder.write("b.csv", "t,m\n0,1\n1,2,3\n");
    try
    {
        readTable(broken);
        FAIL() << "a row with an additional column was accepted";
    }
    catch (const std::runtime_error& error)
    {
        EXPECT_NE(std::string(error.what()).find("b.csv:3:"), std::string::npos) << error.what();
    }
}

/// Peculiarities of spreadsheets: a byte order mark, decimal commas with semicolons or tabs, tabs around empty cells, \r\n.
TEST(Curves, TablesOfSpreadsheets)
{
    const TemporaryFolder folder;
    const Curve expected{{0, 0.5, 1.5}, {10, 9.25, 7}};
    for (const std::string text : {"\xEF\xBB\xBFt [s];m [g]\r\n0;10\r\n0,5;9,25\r\n1;\r\n1,5;7\r\n",
             "t [s]\tnote\tm [g]\n0\t\t10\n.5\t\t9.25\n1.5\t\t7\n", "t;m;\n0;10;\n0,5;9,25;\n1,5;7;\n",
             "t [s]\tm [g]\n0\t10\n0,5\t9,25\n1\t\n1,5\t7\n", "t\tm\r\n0\t10\r\n0,5\t9,25\r\n1,0\t\r\n1,5\t7\r\n",
             "t,m\n0,\t10\n.5,\t9.25\n1.5,\t7\n", "\"t [s]\", \"m [g]\"\n0, 10\n.5, 9.25\n1.5, 7\n"})
    {
        const Curve curve = readCurve(folder.write("a.csv", text), "t", "m");
        EXPECT_EQ(curve.time, expected.time) << text;
        EXPECT_EQ(curve.value, expected.value) << text;
    }
    // Without its tab, the row is not a row of two numbers.
    EXPECT_THROW(readTable(folder.write("b.csv", "1,0\n1,5\t7\n")), std::runtime_error);
}

/// Units in any brackets, with or without a blank before them, are not part of the name, but may be given with it.
TEST(Curves, UnitsInTitles)
{
    const TemporaryFolder folder;
    for (const std::string title : {"Time(sec)\tPosition(mm)", "Time (sec), Position [mm]",
             "# Time (sec)   Position [mm]", "Time[sec] Position(mm)", "Time (sec);Position (mm)"})
    {
        const Table table = readTable(folder.write("a.csv", "Some text, 28 Feb\n" + title + "\n0\t1\n1\t2\n"));
        EXPECT_EQ(table.names, (std::vector<std::string>{"Time", "Position"})) << title;
        EXPECT_EQ(table.units, (std::vector<std::string>{"sec", "mm"})) << title;
        EXPECT_EQ(table.index("Position (mm)"), 1U);
        EXPECT_THROW(table.index("Position (cm)"), std::runtime_error);
    }
    const Table vectors = readTable(folder.write("U", "# Time (Ux Uy)\n0 (1 2)\n"));
    EXPECT_EQ(vectors.names, (std::vector<std::string>{"Time", "Ux", "Uy"}));
    EXPECT_EQ(readTable(folder.write("v", "t,U (x),U (y)\n0,1,2\n")).index("U (y)"), 2U);
}

/// m = 1 - 0.1 t: the rate is 0.1 in all windows, and 95 % are discharged after 9.5 s.
TEST(Features, OfASteadyDischarge)
{
    const Curve curve = sampled(10, 201, [](double t) { return 1 - 0.1 * t; });
    EXPECT_NEAR(feature("logMeanRate", curve, {{"from", 0.9}, {"to", 0.3}}), std::log(0.1), 1e-12);
    EXPECT_NEAR(feature("logTimeToDischarge", curve, {{"share", 0.95}}), std::log(9.5), 1e-12);
    EXPECT_NEAR(feature("residue", curve, {}), 0, 1e-12);
}

TEST(Features, OfAFallingParticle)
{
    const Curve curve = sampled(5, 501, [](double t) { return 0.03 * t; });
    EXPECT_NEAR(feature("logSpeed", curve, {{"from", 0.02}, {"to", 0.12}}), std::log(0.03), 1e-9);
    EXPECT_TRUE(std::isnan(feature("logSpeed", curve, {{"from", 0.02}, {"to", 1}}))) << "the position is not reached";
}

/// The speed is halved in the second half of the way, which the camera did not see: 0.1 m in 2.5 + 5 s. A fit to the
/// visible points would give 0.02 instead of 0.1/7.5.
TEST(Features, MeanSpeedOfATrackWithAGap)
{
    Curve curve = sampled(2.4, 25, [](double t) { return 0.02 * t; });
    curve.time.push_back(7.5);
    curve.value.push_back(0.1);
    EXPECT_NEAR(feature("logMeanSpeed", curve, {{"from", 0}, {"to", 0.1}, {"gap", 1}}), std::log(0.1 / 7.5), 1e-9);
    EXPECT_NEAR(feature("logMeanSpeed", curve, {{"from", 0}, {"to", 0.04}, {"gap", 0.01}}), std::log(0.02), 1e-9);
    EXPECT_TRUE(std::isnan(feature("logMeanSpeed", curve, {{"from", 0}, {"to", 0.07}, {"gap", 0.01}})))
        << "the position lies in the gap";
    EXPECT_GT(feature("logSpeed", curve, {{"from", 0}, {"to", 0.1}}), std::log(0.1 / 7.5) + 0.05);
    EXPECT_TRUE(std::isnan(feature("logMeanSpeed", curve, {{"from", 0.02}, {"to", 1}, {"gap", 1}})))
        << "the position is not reached";
    EXPECT_TRUE(std::isnan(feature("logMeanSpeed", curve, {{"from", 0.05}, {"to", 0.02}, {"gap", 1}})))
        << "the opposite direction";
}

/// The speed rises as 1 - exp(-t) up to t = 5 and falls as exp(-2 (t - 5)). With q = 1 - exp(-5), it rises from 0.3 to
/// 0.8 of its maximum in ln((1 - 0.3 q)/(1 - 0.8 q)), falls from 0.8 to 0.2 in ln(4)/2, and is above one half from
/// -ln(1 - q/2) to 5 + ln(2)/2. Levels on the wrong side of the maximum, or shares of the last value, would give other
/// times.
TEST(Features, OfASpeedThatRisesAndFalls)
{
    const double q = 1 - std::exp(-5.0);
    const Curve curve =
        sampled(8, 8001, [&](double t) { return t < 5 ? 1 - std::exp(-t) : q * std::exp(-2 * (t - 5)); });
    const double rise = std::log((1 - 0.3 * q) / (1 - 0.8 * q));
    EXPECT_NEAR(feature("logRiseTime", curve, {{"from", 0.3}, {"to", 0.8}}), std::log(rise), 1e-5);
    EXPECT_NEAR(feature("logFallTime", curve, {{"from", 0.8}, {"to", 0.2}}), std::log(std::log(4.0) / 2), 1e-5);
    EXPECT_NEAR(
        feature("logTimeAbove", curve, {{"share", 0.5}}), std::log(5 + std::log(2.0) / 2 + std::log(1 - q / 2)), 1e-5);
    EXPECT_TRUE(std::isnan(feature("logFallTime", curve, {{"from", 0.8}, {"to", 0.001}})))
        << "the share is not reached";
}

/// A ball falls from 0.1 m in vacuum and bounces with e = 0.5: the height is e^2 h, the flight time 2 e sqrt(2 h/g).
TEST(Features, OfABounce)
{
    const double g = 9.81;
    const double impact = std::sqrt(2 * 0.1 * g);
    const double hit = impact / g;
    const double flight = impact / g; // 2 (e v)/g with e = 0.5
    const Curve curve = sampled(hit + flight + 0.05, 4001, [&](double t) {
        if (t < hit)
        {
            return 0.1 - g * t * t / 2;
        }
        const double s = t - hit;
        if (s < flight)
        {
            return 0.5 * impact * s - g * s * s / 2;
        }
        return 0.25 * impact * (s - flight) - g * std::pow(s - flight, 2) / 2;
    });
    EXPECT_NEAR(feature("logBounceHeight", curve, {{"bounce", 1}}), std::log(0.025), 1e-4);
    EXPECT_NEAR(feature("logBounceDuration", curve, {{"bounce", 1}}), std::log(flight), 1e-2);
    EXPECT_NEAR(
        feature("logImpactSpeed", curve, {{"before", 0.02}, {"until", 0.01}}), std::log(impact - 0.015 * g), 1e-3);
    EXPECT_NEAR(
        feature("logReboundSpeed", curve, {{"from", 0.01}, {"after", 0.02}}), std::log(0.5 * impact - 0.015 * g), 1e-2);
    EXPECT_TRUE(std::isnan(feature("logBounceHeight", curve, {{"bounce", 3}})));
}

/// Values worked out by hand for the kinds that no other test has. The record starts at 2 s, as that of a camera that was
/// running already: times count from its first row.
TEST(Features, OfARecordThatStartsLate)
{
    Curve curve = sampled(5, 501, [](double t) { return 0.2 - 0.03 * t; });
    for (double& time : curve.time)
    {
        time += 2;
    }
    EXPECT_NEAR(feature("logTimeToDischarge", curve, {{"share", 0.45}}), std::log(3), 1e-9);
    EXPECT_NEAR(feature("logMaximum", curve, {}), std::log(0.2), 1e-12);
    EXPECT_NEAR(feature("residue", curve, {}), 0.25, 1e-12);
}

/// A signal that swings about 0.3 by 0.1 after a second at 5, sampled three times as densely where it is high: a mean over
/// time is not that over rows.
TEST(Features, OfASignalThatSwings)
{
    Curve curve;
    double time = 0;
    while (time < 9)
    {
        const double swing = std::sin(2 * M_PI * time);
        curve.time.push_back(4 + time);
        curve.value.push_back(time < 1 ? 5 : 0.3 + 0.1 * swing);
        time += swing > 0 ? 1e-3 : 3e-3;
    }
    EXPECT_NEAR(feature("logMean", curve, {{"after", 1}}), std::log(0.3), 1e-3);
    EXPECT_NEAR(feature("logDeviation", curve, {{"after", 1}}), std::log(0.1 / std::sqrt(2)), 5e-3);
    EXPECT_TRUE(std::isnan(feature("logMean", curve, {{"after", 99}})));
}

/// When a record starts changes no feature of it. This holds for each kind that there is: one without a row here fails.
TEST(Features, DoNotDependOnWhenTheRecordStarts)
{
    const std::map<std::string, FeatureKind::Parameters> usual = {
        {"logMeanRate", {{"from", 0.9}, {"to", 0.3}}},
        {"logTimeToDischarge", {{"share", 0.6}}},
        {"residue", {}},
        {"logSpeed", {{"from", 0.09}, {"to", 0.03}}},
        {"logMeanSpeed", {{"from", 0.09}, {"to", 0.03}, {"gap", 1}}},
        {"logBounceHeight", {{"bounce", 1}, {"level", 5e-4}}},
        {"logBounceDuration", {{"bounce", 1}, {"level", 5e-4}}},
        {"logImpactSpeed", {{"level", 5e-4}, {"before", 0.02}, {"until", 0.01}}},
        {"logReboundSpeed", {{"level", 5e-4}, {"from", 0.01}, {"after", 0.02}}},
        {"logMaximum", {}},
        {"logMean", {{"after", 0.1}}},
        {"logDeviation", {{"after", 0.1}}},
        {"logRiseTime", {{"from", 0.3}, {"to", 0.8}}},
        {"logFallTime", {{"from", 0.8}, {"to", 0.3}}},
        {"logTimeAbove", {{"share", 0.5}}},
    };
    // It falls from 0.1 m and bounces twice, or it rises first, for the kinds that look before the maximum.
    const double impact = std::sqrt(2 * 0.1 * 9.81);
    const Curve bouncing = sampled(2.6 * impact / 9.81, 4001, [&](double t) {
        const double since = t - impact / 9.81;
        const double again = since - impact / 9.81;
        return since < 0   ? 0.1 - 9.81 * t * t / 2
               : again < 0 ? 0.5 * impact * since - 9.81 * since * since / 2
                           : 0.25 * impact * again - 9.81 * again * again / 2;
    });
    const Curve rising = sampled(3, 3001, [](double t) { return t * std::exp(-2 * t); });
    for (const auto& [name, kind] : featureKinds())
    {
        ASSERT_EQ(usual.count(name), 1U) << "no row for " << name;
        const bool rises = name == "logRiseTime" || name == "logTimeAbove";
        const Curve& curve = rises ? rising : bouncing;
        Curve late = curve;
        std::for_each(late.time.begin(), late.time.end(), [](double& time) { time += 7; });
        const FeatureKind::Parameters& parameters = usual.at(name);
        const double there = kind.value(curve, parameters);
        EXPECT_TRUE(std::isfinite(there)) << name << " has no value, so nothing is compared";
        EXPECT_NEAR(kind.value(late, parameters), there, 1e-3) << name;
    }
}

/// A first-order filter turns a ramp into y = s (t - tau (1 - exp(-t/tau))); the filter is exact for piecewise linear
/// curves.
TEST(MeasuringChain, LagOfARamp)
{
    const Curve ramp = sampled(2, 21, [](double t) { return 3 * t; });
    const Curve lagged = chainOperations().at("lag").apply(ramp, 0.4);
    for (std::size_t i = 0; i < ramp.time.size(); ++i)
    {
        const double t = ramp.time[i];
        EXPECT_NEAR(lagged.value[i], 3 * (t - 0.4 * (1 - std::exp(-t / 0.4))), 1e-12);
    }
}

TEST(MeasuringChain, OthersOnARamp)
{
    const Curve ramp = sampled(2, 21, [](double t) { return 3 * t; });
    const auto at = [&](const std::string& name, double size, double time) {
        return valueAt(chainOperations().at(name).apply(ramp, size), time);
    };
    EXPECT_NEAR(at("gain", 0.1, 1), 3.3, 1e-12);
    EXPECT_NEAR(at("offset", 0.1, 1), 3.1, 1e-12);
    EXPECT_NEAR(at("drift", 0.1, 1.5), 4.65, 1e-12);
    EXPECT_NEAR(at("shift", 0.3, 1), 3.9, 1e-12);
    EXPECT_NEAR(at("shift", -0.3, 1), 2.1, 1e-12);
    EXPECT_NEAR(at("shift", -0.3, 0.1), 0, 1e-12) << "before the record, the first value is used";
    EXPECT_NEAR(at("timeFactor", 0.25, 1.25), 3, 1e-12);
    EXPECT_NEAR(at("lead", 0.2, 1), 3.6, 1e-12);
}

/// Invalid numbers are errors that name line and field. Squares of numbers above 1e30 may overflow, and rows with inf
/// or nan would be left out without a message.
TEST(Table, RefusesInvalidNumbers)
{
    const TemporaryFolder folder;
    for (const std::string bad : {"inf", "-inf", "nan", "1e308", "1e999", "0x1p3", "1..2", "mm", "infinity"})
    {
        for (const std::string before : {"t,m\n0,1\n", "t,m\n"})
        {
            const auto file = folder.write("measured.csv", before + "1," + bad + "\n2,3\n");
            if (before == "t,m\n" && (bad == "mm" || bad == "1..2"))
            {
                continue; // a line of text before the numbers
            }
            try
            {
                readTable(file);
                ADD_FAILURE() << "accepted: " << bad;
            }
            catch (const std::runtime_error& error)
            {
                EXPECT_NE(std::string(error.what()).find("measured.csv:"), std::string::npos) << error.what();
                EXPECT_NE(std::string(error.what()).find('\'' + bad + '\''), std::string::npos) << error.what();
            }
        }
    }
}

} // namespace

} // namespace clepsydra::identification::tests
