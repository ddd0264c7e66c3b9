/// `traceResidual new` drafts study files, which are accepted when their marked values have been filled in.
#include "study/draft/draftStudy.h"
#include "study/measurements.h"
#include "study/readStudy.h"
#include "study/readValues.h"
#include "temporaryFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/wait.h>

#include <cstdlib>
#include <functional>
#include <map>
#include <regex>
#include <sstream>

namespace clepsydra::identification::tests
{

namespace
{

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Rows every 0.02 s for six seconds, numbers as %0.4f writes them.
std::string table(
    const std::string& head, const std::string& separator, char decimal, const std::function<double(double)>& value)
{
    std::ostringstream rows;
    rows << std::fixed;
    rows.precision(4);
    for (int i = 0; i < 300; ++i)
    {
        rows << 0.02 * i << separator << value(0.02 * i) << '\n';
    }
    std::string text = rows.str();
    std::replace(text.begin(), text.end(), '.', decimal);
    return head + '\n' + text;
}

/// A folder in which the program is run.
class Bench
{
public:
    void write(const std::string& name, const std::string& text) const
    {
        folder_.write(name, text);
    }

    /// Runs the program in this folder.
    int run(const std::string& arguments)
    {
        const std::string line =
            "cd '" + folder_.path().string() + "' && " TRACE_RESIDUAL " " + arguments + " > out 2>&1";
        const int status = std::system(line.c_str());
        output = contentOf(folder_.path() / "out");
        return WEXITSTATUS(status);
    }

    std::string text(const std::string& name) const
    {
        return contentOf(folder_.path() / name);
    }
    fs::path path(const std::string& name) const
    {
        return folder_.path() / name;
    }

    /// Number of values that are still to be filled in.
    std::size_t places(const std::string& name) const
    {
        const std::string study = text(name);
        const std::regex mark("\"FILL IN: ");
        return std::distance(std::sregex_iterator(study.begin(), study.end(), mark), std::sregex_iterator());
    }

    /// Fills in the marked values; the apparatus is that of the case.
    void fill(const std::string& name) const
    {
        std::string study = text(name);
        for (const auto& [place, by] : std::vector<std::pair<std::string, std::string>>{{" *checked: [^\n]*\n", ""},
                 {R"(mean: "FILL IN[^"]*")", "mean: 0.15"}, {R"(sd: "FILL IN[^"]*")", "sd: 0.03"},
                 {R"(from: "FILL IN[^"]*")", "from: handbook"},
                 {R"(file: "FILL IN[^"]*")", "file: postProcessing/massInHopper/*/massInHopper.dat"},
                 {R"(value: "FILL IN[^"]*")", "value: mass"}, {R"("FILL IN[^"]*")", "0.2"}})
        {
            study = std::regex_replace(study, std::regex(place), by);
        }
        folder_.write(name, study);
    }

    std::string output;

private:
    TemporaryFolder folder_;
};

std::map<std::string, Condition> byName(const Study& study)
{
    std::map<std::string, Condition> conditions;
    for (const auto& condition : study.conditions)
    {
        conditions[condition.name] = condition;
    }
    return conditions;
}

std::string hopperFile(double rate, double rest)
{
    return table("t [s];m [g]", ";", ',', [=](double t) { return std::max(30 - rate * t, rest); });
}

void writeHopperFiles(const Bench& bench)
{
    for (const auto& [name, rate] :
        std::map<std::string, double>{{"dry10", 13}, {"dry12", 19}, {"dry14", 26}, {"wet10", 9}, {"wet12", 14}})
    {
        for (const std::string repeat : {"a", "b", "c"})
        {
            bench.write("measured/" + name + repeat + ".csv", hopperFile(rate, 6));
        }
    }
    bench.write("measured/notes.txt", "Sunday: nothing measured.\n");
}

/// Masses of a hopper, as a spreadsheet writes them. The draft contains everything that follows from names and titles;
/// it is refused with the lines of all missing values, and accepted when these have been filled in. A program that
/// always wrote the same draft would have another unit, other files, or no water.
TEST(Draft, OfHopperFilesIsAcceptedOnceFilled)
{
    Bench bench;
    writeHopperFiles(bench);
    ASSERT_EQ(bench.run("new " CASES_FOLDER "/hopperQuick measured"), 0) << bench.output;
    EXPECT_THAT(bench.output, HasSubstr("left out: measured/notes.txt: contains no line of numbers; allowed: columns"));
    EXPECT_THAT(bench.output, HasSubstr("condition wet10: wet10a.csv wet10b.csv wet10c.csv (repeats)"));
    EXPECT_THAT(bench.output, HasSubstr("study.yaml:9: simulator.set.checked: FILL IN"));
    const std::string study = "study.yaml";
    EXPECT_THAT(bench.text(study), HasSubstr("decide now, before"));
    EXPECT_EQ(bench.run("plan " + study), 1);
    EXPECT_LE(bench.places(study), 3U) << bench.text(study);
    EXPECT_THAT(bench.output, HasSubstr("study.yaml:9: simulator.set.checked: FILL IN"));
    EXPECT_THAT(bench.output, HasSubstr(".prior.sd: FILL IN"));
    EXPECT_THAT(bench.output, HasSubstr("Replace these by values"));
    bench.fill(study);
    ASSERT_EQ(bench.run("plan " + study), 0) << bench.output;
    EXPECT_THAT(bench.output, HasSubstr("300 rows, time 0 to 5.98 s, value 0.006 to 0.03 (SI units)"));

    const Study read = readStudy(bench.path(study));
    const auto conditions = byName(read);
    ASSERT_EQ(conditions.size(), 5U);
    EXPECT_EQ(conditions.at("dry10").role, Role::training);
    EXPECT_EQ(conditions.at("dry12").role, Role::heldOut) << "inside the range of dry conditions";
    EXPECT_EQ(conditions.at("wet12").role, Role::heldOut) << "at the end of the other range";
    EXPECT_EQ(conditions.at("wet10").tags.at("medium"), "water");
    EXPECT_EQ(conditions.at("wet10").command, "./Allrun mesh filling submerged");
    EXPECT_EQ(conditions.at("wet10").file, "steps/submerged/postProcessing/massInHopper/*/massInHopper.dat");
    EXPECT_EQ(conditions.at("dry14").entries.at("orificeDiameter"), "14e-3");
    EXPECT_EQ(conditions.at("dry14").measured.files.size(), 3U);
    EXPECT_GT(read.effects.size(), 25U);
    const auto features = readMeasurements(read, 0).features;
    EXPECT_NEAR(features(0, 0), std::log(13e-3), 1e-3);
    EXPECT_TRUE(features.array().isFinite().all()) << "all files must pass through the windows";
    EXPECT_EQ(read.features.back().name, "residue");
}

/// The values of a held-out condition do not influence the draft.
TEST(Draft, DoesNotDependOnHeldOutValues)
{
    Bench bench;
    writeHopperFiles(bench);
    ASSERT_EQ(bench.run("new " CASES_FOLDER "/hopperQuick measured --output a.yaml"), 0) << bench.output;
    bench.write("measured/dry12a.csv", hopperFile(1, 29));
    ASSERT_EQ(bench.run("new " CASES_FOLDER "/hopperQuick measured --output b.yaml"), 0);
    EXPECT_EQ(bench.text("a.yaml"), bench.text("b.yaml"));
    bench.write("measured/dry10a.csv", hopperFile(3, 15));
    ASSERT_EQ(bench.run("new " CASES_FOLDER "/hopperQuick measured --output c.yaml"), 0);
    EXPECT_NE(bench.text("a.yaml"), bench.text("c.yaml")) << "a training file that ends at half of the fill";
}

/// Positions of a camera that are positive downwards and 0 while it sees nothing.
TEST(Draft, OfFallingParticlesIsAcceptedOnceFilled)
{
    Bench bench;
    for (const auto& [name, speed] : std::map<std::string, double>{{"bead_1.5", 20}, {"bead_2", 30}})
    {
        for (const std::string trial : {"1", "2"})
        {
            bench.write(name + "_trial_" + trial + ".txt",
                table("28 Feb 2023, 3:30 PM\nTime(sec)\tPosition(mm)", "\t", '.',
                    [&, speed = speed](double t) { return t < 0.5 || t > 5 ? 0 : 10 + speed * t; }));
        }
    }
    const std::string files = " bead_1.5_trial_1.txt bead_1.5_trial_2.txt bead_2_trial_1.txt bead_2_trial_2.txt";
    ASSERT_EQ(bench.run("new " CASES_FOLDER "/settlingParticle" + files + " --output particles.yaml"), 0)
        << bench.output;
    EXPECT_LE(bench.places("particles.yaml"), 3U) << bench.text("particles.yaml");
    bench.fill("particles.yaml");
    ASSERT_EQ(bench.run("plan particles.yaml"), 0) << bench.output;
    const Study study = readStudy(bench.path("particles.yaml"));
    ASSERT_EQ(study.conditions.size(), 2U);
    EXPECT_EQ(study.conditions[0].entries.at("particleDiameter"), "1.5e-3");
    EXPECT_EQ(study.simulator.seedEntry, "");
    EXPECT_EQ(study.parameters.front().name, "logViscosity");
    const auto measured = readMeasurements(study, 1);
    EXPECT_NEAR(measured.features(0, 0), std::log(30e-3), 1e-9) << "without the zeros";
    EXPECT_NEAR(measured.features(1, 1), std::log(30e-3), 1e-9);
    const auto numbers = numbersOf(plainEntries(study.simulator, study.conditions[0]));
    EXPECT_EQ(study.conditions[0].observable.factor(numbers), -1);
    EXPECT_EQ(study.conditions[0].observable.offset(numbers), numbers.at("releaseHeight"));
}

/// If a case writes no known table, the observable must be filled in.
TEST(Draft, OfAnUnknownCase)
{
    Bench bench;
    fs::copy(fs::path(SURROGATE) / "case", bench.path("case"));
    bench.write("rises.csv", table("t_s,collected_mass_g", ",", '.', [](double t) { return std::min(13 * t, 24.); }));
    ASSERT_EQ(bench.run("new case rises.csv"), 0) << bench.output;
    EXPECT_THAT(bench.output, HasSubstr("observable.file: FILL IN"));
    EXPECT_THAT(bench.output, HasSubstr("measured.value.offset: FILL IN"))
        << "the mass in the hopper does not follow from the discharged mass alone";
    bench.fill("study.yaml");
    ASSERT_EQ(bench.run("plan study.yaml"), 0) << bench.output;
    EXPECT_EQ(readStudy(bench.path("study.yaml")).conditions.front().measured.value.factor, -1e-3);
}

/// After an error nothing is written, and an existing file is never overwritten.
TEST(Draft, RefusesAndWritesNothing)
{
    Bench bench;
    bench.write("folder/notes.txt", "Sunday: nothing measured.\n");
    bench.write("fall.csv", table("t_s,height_mm", ",", '.', [](double t) { return 200 - 20 * t; }));
    bench.write("mass.csv", hopperFile(10, 5));
    bench.write("one.csv", "t_s\n0\n1\n2\n3\n");
    bench.write("late.csv", "t_s,height_mm\n0,3\n2,2\n1,1\n3,0\n");
    bench.write("mine.yaml", "mine\n");
    const std::map<std::string, std::string> refused = {
        {"hopperQuick folder", "folder: contains no table of numbers"},
        {"hopperQuick folder/notes.txt", "notes.txt: contains no line of numbers"},
        {"hopperQuick fall.csv", "writes a mass"},
        {"settlingParticle mass.csv", "writes a length"},
        {"settlingParticle fall.csv mass.csv", "no column 't_s'"},
        {"settlingParticle fall.csv late.csv", "late.csv: in line 4 the time goes back"},
        {"hopperQuick one.csv", "no column beside the time"},
        {"hopperQuick nowhere.csv", "nowhere.csv"},
        {"../validation fall.csv", "is not a case"},
        {"settlingParticle fall.csv --output mine.yaml", "mine.yaml exists already"},
        {"settlingParticle fall.csv --output no/such/folder.yaml", "folder.yaml"},
    };
    for (const auto& [arguments, reported] : refused)
    {
        EXPECT_NE(bench.run("new " CASES_FOLDER "/" + arguments), 0) << arguments;
        EXPECT_THAT(bench.output, HasSubstr(reported)) << arguments;
    }
    EXPECT_EQ(bench.text("mine.yaml"), "mine\n");
    EXPECT_FALSE(fs::exists(bench.path("study.yaml")));
}

/// Conditions follow from file names: "1" and "2" behind a word number repeats, "10" and "12" do not.
TEST(Draft, RepeatsAndConditions)
{
    const auto drafted = [](const std::vector<std::string>& names) {
        std::string text;
        for (const auto& condition : draftConditions({names.begin(), names.end()}))
        {
            text += condition.name + (condition.isHeldOut ? "! " : " ") + std::to_string(condition.files.size()) + ", ";
        }
        return text;
    };
    EXPECT_EQ(drafted({"dry_1.csv", "dry_2.csv", "dry_3.csv"}), "dry 3, ");
    EXPECT_EQ(drafted({"dry10.csv", "dry12.csv"}), "dry10 1, dry12 1, ");
    EXPECT_EQ(drafted({"bead1t1.txt", "bead1t2.txt", "bead2t1.txt"}), "bead1 2, bead2 1, ");
    EXPECT_EQ(drafted({"m1run_7.csv", "m1run_9.csv"}), "m1 2, ");
    EXPECT_EQ(drafted({"1.csv", "2.csv"}), "measured 2, ");
    EXPECT_EQ(drafted({"re_1.5.csv", "re_32.2.csv", "re_4.1.csv"}), "re_1.5 1, re_4.1! 1, re_32.2 1, ");
    EXPECT_EQ(drafted({"d8a.csv", "d8b.csv", "d10a.csv", "d12a.csv", "d14a.csv"}), "d8 2, d10a 1, d12a! 1, d14a! 1, ");
    EXPECT_EQ(drafted({"glass.csv", "wood.csv", "steel.csv", "ice.csv"}), "glass 1, ice 1, steel! 1, wood! 1, ");
}

TEST(Draft, Columns)
{
    const TemporaryFolder folder;
    const auto columns = [&](const std::string& head, const std::string& rows = "1,7,5\n2,7,6\n3,8,4\n") {
        const auto c = guessColumns(folder.write("a.csv", head + '\n' + rows));
        return c.time.column + '[' + c.time.unit + "] " + c.value.column + '[' + c.value.unit + "] " + c.quantity;
    };
    EXPECT_EQ(columns("t_s,note,position_mm"), "t_s[s] position_mm[mm] length");
    EXPECT_EQ(columns("time [ms],note,mass (g)"), "time[ms] mass[g] mass");
    EXPECT_EQ(columns("Time(sec),note,velocity_m_s"), "Time[s] velocity_m_s[m/s] speed");
    EXPECT_EQ(columns("a,mass_kg,time", "7,5,1\n8,6,2\n7,4,3\n"), "time[] mass_kg[kg] mass");
    EXPECT_EQ(columns("t,n,Discharged %"), "t[] Discharged %[%] share");
    EXPECT_EQ(columns("", "1,7,5\n2,7,6\n3,8,4\n"), "1[] 2[] ") << "without titles by order";
    EXPECT_THROW(columns("t_s,m_g,n", "3,1,1\n2,5,1\n1,6,1\n"), std::runtime_error) << "no time that rises";
}

} // namespace

} // namespace clepsydra::identification::tests
