/// The program from study file to report, with the surrogate as the program of the case.
#include "curves/table.h"
#include "fullDisk.h"
#include "runner/caseSimulator.h"
#include "runner/storedFiles.h"
#include "surrogate/surrogate.h"
#include "study/readStudy.h"
#include "temporaryFolder.h"

#include <nlohmann/json.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

namespace clepsydra::identification::tests
{

namespace
{

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

std::string replaced(std::string text, const std::string& old, const std::string& by)
{
    return text.replace(text.find(old), old.size(), by);
}

/// A text without all parts that begin with `begin` and end with `end`.
std::string without(std::string text, const std::string& begin, const std::string& end)
{
    for (auto at = text.find(begin); at != std::string::npos; at = text.find(begin, at))
    {
        text.erase(at, text.find(end, at) + end.size() - at);
    }
    return text;
}

/// A copy of the surrogate's case and study, with synthetic measurements.
class Workshop
{
public:
    Workshop()
    {
        fs::copy(fs::path(SURROGATE) / "case", folder_.path() / "case");
        study_ = contentOf(fs::path(SURROGATE) / "study.yaml");
        // The program of the case is in the build folder.
        folder_.write("case/Allrun", "#!/bin/sh\nexec " SURROGATE_PROGRAM "\n");
        fs::permissions(folder_.path() / "case/Allrun", fs::perms::owner_all);
    }

    /// Adds an effect to the study. \param effect  line of the study file
    void offer(const std::string& effect)
    {
        const std::string begin = "\neffects:\n";
        study_.insert(study_.find(begin) + begin.size(), effect);
    }

    /// Writes three repeats of each condition, in g, with an effect. \param late  delay of the record [s]
    void measure(const Entries& effect, double late = 0.0)
    {
        folder_.write("study.yaml", study_);
        const Study study = readStudy(folder_.path() / "study.yaml");
        const Entries defaults = readEntries(folder_.path() / "case/parameters");
        std::string with = study_;
        long seed = 20011;
        for (const auto& condition : study.conditions)
        {
            std::string files;
            for (int repeat = 0; repeat < 3; ++repeat)
            {
                Entries entries = effect;
                entries["seed"] = std::to_string(seed += 2);
                entries.insert(condition.entries.begin(), condition.entries.end());
                entries.insert(defaults.begin(), defaults.end());
                const Curve curve = discharge(entries);
                std::ostringstream csv;
                csv << "t,m\n";
                for (std::size_t i = 0; i < curve.time.size(); i += 2)
                {
                    if (curve.time[i] < late)
                    {
                        continue;
                    }
                    csv << curve.time[i] - late << ',' << textOf(1e3 * curve.value[i]) << '\n';
                }
                const std::string name = condition.name + std::to_string(repeat) + ".csv";
                folder_.write(name, csv.str());
                files += (files.empty() ? "" : ", ") + name;
            }
            const std::string begin = "- name: " + condition.name + '\n';
            with.insert(with.find(begin) + begin.size(), "    measured: { files: [" + files + "] }\n");
        }
        folder_.write(
            "study.yaml", with + "measured:\n  time: { column: t, unit: s }\n  value: { column: m, unit: g }\n");
    }

    void append(const std::string& text) const
    {
        std::ofstream(folder_.path() / "study.yaml", std::ios::app) << text;
    }

    int run(const std::string& command, const std::string& environment = "")
    {
        const std::string line = environment + " " TRACE_RESIDUAL " " + command + ' '
                                 + (folder_.path() / "study.yaml").string() + " > " + (folder_.path() / "out").string()
                                 + " 2>&1";
        const int status = std::system(line.c_str());
        output = contentOf(folder_.path() / "out");
        return WEXITSTATUS(status);
    }

    nlohmann::json json(const std::string& name) const
    {
        return nlohmann::json::parse(contentOf(folder_.path() / "results" / name));
    }

    const fs::path& path() const
    {
        return folder_.path();
    }

    std::string output;

private:
    TemporaryFolder folder_;
    std::string study_;
};

/// An effect in the data is named (or is in the set), the error on held-out conditions falls, and a second call makes
/// no runs. A program that always named the same effect would fail the next test.
TEST(Program, FindsTheEffectThatWasPutIn)
{
    Workshop workshop;
    workshop.measure({{"addedMass", "0.7"}});
    ASSERT_EQ(workshop.run("run"), 0) << workshop.output;
    const auto report = workshop.json("report.json");
    EXPECT_THAT(report["decision"].get<std::string>(), testing::AnyOf("named", "set"));
    EXPECT_EQ(report["set"][0]["name"], "addedMass");
    EXPECT_LT(report["pValue"].get<double>(), 0.01);
    EXPECT_LT(report["heldOut"]["after"]["rmsLogError"].get<double>(),
        0.6 * report["heldOut"]["before"]["rmsLogError"].get<double>());
    EXPECT_TRUE(report["heldOut"]["better"].get<bool>()) << report["heldOut"]["notBetterBecause"];
    for (const std::string key : {"before", "after", "oneMoreParameter", "gaussianProcess"})
    {
        EXPECT_GT(report["heldOut"][key]["standardError"].get<double>(), 0) << key;
    }
    int used = 0;
    for (const auto& [purpose, count] : report["runs"]["byPurpose"].items())
    {
        used += count.get<int>();
    }
    EXPECT_EQ(report["runs"]["used"], used - 6) << "the first runs, which check the units, belong to the library";
    for (const std::string key : {"effects", "runs", "seeds", "assumptions", "calibration", "emulator", "residual"})
    {
        EXPECT_FALSE(report[key].empty()) << key;
    }
    const std::string page = contentOf(workshop.path() / "results/report.html");
    EXPECT_THAT(page, HasSubstr("<svg"));
    EXPECT_THAT(page, testing::Not(HasSubstr("src=\"http")));
    const auto summary = report["summary"].get<std::string>();
    EXPECT_THAT(summary, HasSubstr("falls from"));
    EXPECT_LT(page.find(summary), page.find("<svg")) << "the sentence comes first";
    EXPECT_THAT(page, HasSubstr("aria-label=\"wetBeyond\"")) << "curves of the held-out conditions";
    if (std::system("command -v chromium > /dev/null") == 0)
    {
        const std::string seen = (workshop.path() / "seen").string();
        ASSERT_EQ(
            std::system(("chromium --headless --no-sandbox --disable-gpu --enable-logging=stderr --dump-dom file://"
                         + (workshop.path() / "results/report.html").string() + " > " + seen + " 2> " + seen + ".log")
                            .c_str()),
            0);
        EXPECT_THAT(contentOf(seen), HasSubstr(summary));
        EXPECT_THAT(contentOf(seen + ".log"), testing::Not(HasSubstr("CONSOLE")));
    }
    EXPECT_EQ(report["heldOut"]["notScored"].size(), 0U) << "features that are no logarithms are compared, too";
    const nlohmann::json rate = {{"unit", "g/s"}, {"si", 1e-3}};
    const nlohmann::json time = {{"unit", "s"}, {"si", 1.0}};
    EXPECT_THAT(report["units"], AllOf(Contains(rate), Contains(time))) << "from the units of the curves' columns";
    // Each measured number is drawn in a chart of its feature, held-out conditions apart.
    EXPECT_THAT(page, HasSubstr("<div class=\"plots numbers\">"));
    EXPECT_GT(report["numbers"].size(), 6U);
    for (const auto& row : report["numbers"])
    {
        EXPECT_TRUE(row["measured"]["value"].is_number() && row["before"]["value"].is_number()
                    && row["after"]["value"].is_number())
            << row;
        EXPECT_THAT(page, HasSubstr(row["condition"].get<std::string>()));
    }
    // One number for a cause that the library does not list: in the report, in its sentences, and on the page.
    const double other = report["somethingElse"]["probability"].get<double>();
    const std::string share = other < 0.01   ? "<1 %"
                              : other > 0.99 ? ">99 %"
                                             : std::to_string(std::lround(100 * other)) + " %";
    EXPECT_THAT(report["details"].dump(), HasSubstr("a cause that the library does not list " + share));
    EXPECT_THAT(page,
        HasSubstr("does not list is "
                  + std::regex_replace(std::regex_replace(share, std::regex("<"), "&lt;"), std::regex(">"), "&gt;")));
    const auto fitted = std::find_if(
        report["fitted"].begin(), report["fitted"].end(), [](const auto& one) { return one["name"] == "addedMass"; });
    ASSERT_NE(fitted, report["fitted"].end());
    const auto& size = (*fitted)["withEffect"];
    EXPECT_NEAR(size["value"].get<double>(), 0.7, 4 * size["standardError"].get<double>());

    ASSERT_EQ(workshop.run("run"), 0) << workshop.output;
    const auto again = workshop.json("report.json");
    EXPECT_EQ(again["runs"]["executed"], 0);
    EXPECT_EQ(again["set"], report["set"]);

    ASSERT_EQ(workshop.run("report", "exec 2>&-;"), 0);
    EXPECT_EQ(workshop.output.substr(0, workshop.output.find('\n')), summary) << "the first line of the output";
    EXPECT_THAT(workshop.output, HasSubstr("Fitted: friction"));

    // A checkout has neither a page nor stored runs; the page is made from report.json without the curves.
    std::string drawn = contentOf(workshop.path() / "results/report.html");
    const std::string plots = "<div class=\"plots\">";
    const std::string note = "<p class=\"small\">The curves are not drawn";
    ASSERT_THAT(drawn, HasSubstr(plots));
    fs::remove_all(workshop.path() / "surrogate.work");
    fs::remove(workshop.path() / "results/report.html");
    ASSERT_EQ(workshop.run("report"), 0) << workshop.output;
    std::string made = contentOf(workshop.path() / "results/report.html");
    EXPECT_THAT(made, HasSubstr(note));
    EXPECT_THAT(made, HasSubstr(summary));
    EXPECT_EQ(without(made, note, "</p>\n"), without(drawn, plots, "</div>\n"));

    // A report of another version lacks a key that the page shows.
    auto old = workshop.json("report.json");
    old.erase("fitted");
    std::ofstream(workshop.path() / "results/report.json") << old;
    fs::remove(workshop.path() / "results/report.html");
    EXPECT_NE(workshop.run("report"), 0);
    EXPECT_THAT(workshop.output, HasSubstr("another version of traceResidual"));
    EXPECT_FALSE(fs::exists(workshop.path() / "results/report.html"));
}

/// With particles so light that the wet flow is half as fast, the null fit moves friction far from the base setting,
/// and the way back takes more steps than a small effect needs. With too few steps the program answers "unknown".
TEST(Program, FollowsALargeEffectToItsEnd)
{
    Workshop workshop;
    workshop.offer("  - { name: lightParticles, set: { particleDensity: 1900 }, switch: true }\n");
    workshop.measure({{"particleDensity", "1900"}});
    ASSERT_EQ(workshop.run("run"), 0) << workshop.output;
    const auto report = workshop.json("report.json");
    ASSERT_EQ(report["decision"], "named") << report["summary"];
    EXPECT_EQ(report["name"], "lightParticles");
    EXPECT_NEAR(report["set"][0]["parameters"]["friction"].get<double>(), 0.15, 0.03);
    EXPECT_GT(report["null"]["parameters"]["friction"].get<double>(), 0.25) << "too near for this test";
}

/// Without an effect in the data, none is found with this seed; checkIdentification measures the rate of false alarms.
/// An effect of which no run succeeds is reported as not judged; it has no fit.
TEST(Program, FindsNothingWithoutAnEffect)
{
    Workshop workshop;
    workshop.offer("  - { name: noOrifice, switch: true, set: { orificeDiameter: -1 } }\n");
    workshop.measure({});
    ASSERT_EQ(workshop.run("run"), 0) << workshop.output;
    const auto report = workshop.json("report.json");
    EXPECT_EQ(report["decision"], "noResidual");
    EXPECT_TRUE(report["name"].is_null());
    for (const auto& effect : report["effects"])
    {
        const bool possible = effect["name"] != "noOrifice";
        EXPECT_EQ(effect["judged"], possible) << effect["name"];
        EXPECT_EQ(effect["parameters"].empty(), !possible) << effect["name"];
    }
}

/// The values of held-out files do not change the answer, which is on disk before they are read, and they are not
/// reported. Their form is checked before the first run: text, times that go back and invalid numbers are errors.
TEST(Program, ReadsHeldOutValuesAfterTheAnswer)
{
    Workshop workshop;
    workshop.measure({});
    const auto file = workshop.path() / "dryBetween0.csv";
    const std::string good = contentOf(file);
    for (const auto& [bad, reported] :
        std::map<std::string, std::string>{{good + "broken,scale\n", "'broken' is not a number"},
            {good + "0.5,3\n", "time goes back"}, {good + "99,1e308\n", "is not a number from -1e30"}})
    {
        std::ofstream(file) << bad;
        EXPECT_NE(workshop.run("run"), 0);
        EXPECT_THAT(workshop.output, HasSubstr("dryBetween0.csv"));
        EXPECT_THAT(workshop.output, HasSubstr(reported));
        EXPECT_NE(workshop.run("plan"), 0);
        EXPECT_FALSE(fs::exists(workshop.path() / "surrogate.work/cache")) << "runs were made before the check";
    }
    std::ofstream(file) << good;
    for (int time = 0; time < 2; ++time)
    {
        ASSERT_EQ(workshop.run("run"), 0) << workshop.output;
    }
    const std::string answer = contentOf(workshop.path() / "results/answer.json");
    EXPECT_THAT(workshop.output, HasSubstr("dry2mm0.csv: "));
    EXPECT_THAT(workshop.output, HasSubstr("dryBetween0.csv: can be read (held out"));
    std::ofstream(file) << "t,m\n0,77777\n1,77000\n2,7\n3,0\n";
    ASSERT_EQ(workshop.run("run"), 0) << workshop.output;
    EXPECT_EQ(contentOf(workshop.path() / "results/answer.json"), answer);
    EXPECT_THAT(workshop.output, testing::Not(HasSubstr("7777")));
}

/// A wrong unit is reported after one run of each condition, not after all runs. A magnitudeLimit above the difference
/// allows it, and `plan` reports it if these runs are stored.
TEST(Program, ChecksUnitsAfterTheFirstRuns)
{
    Workshop workshop;
    workshop.measure({});
    const std::string right = contentOf(workshop.path() / "study.yaml");
    std::ofstream(workshop.path() / "study.yaml") << replaced(right, "column: m, unit: g", "column: m, unit: kg");
    EXPECT_EQ(workshop.run("plan"), 0) << workshop.output;
    for (const std::string command : {"run", "plan"})
    {
        EXPECT_NE(workshop.run(command), 0);
        EXPECT_THAT(workshop.output, HasSubstr("condition 'dry2mm': the largest value is"));
        EXPECT_THAT(workshop.output, HasSubstr("magnitudeLimit"));
        const auto runs = fs::directory_iterator(workshop.path() / "surrogate.work/cache");
        EXPECT_EQ(std::distance(begin(runs), end(runs)), 6);
    }
    workshop.append("magnitudeLimit: 2000\n");
    EXPECT_EQ(workshop.run("plan"), 0) << workshop.output;
}

/// Training files that have none of the features are reported before a run is made.
TEST(Program, RefusesFilesWithoutFeatures)
{
    Workshop workshop;
    workshop.measure({});
    for (const std::string file : {"dry2mm0.csv", "dry2mm1.csv", "dry2mm2.csv"})
    {
        std::ofstream(workshop.path() / file) << "t,m\n0,0\n1,0\n2,0\n";
    }
    EXPECT_NE(workshop.run("run"), 0);
    EXPECT_THAT(workshop.output, HasSubstr("'dry2mm' have none of the features"));
    EXPECT_FALSE(fs::exists(workshop.path() / "surrogate.work"));
}

/// A held-out condition without measurements is reported before a run is made, not after all runs as "none was held
/// out".
TEST(Program, RequiresHeldOutMeasurements)
{
    Workshop workshop;
    workshop.measure({});
    const std::string right = contentOf(workshop.path() / "study.yaml");
    std::ofstream(workshop.path() / "study.yaml")
        << std::regex_replace(right, std::regex("    measured: \\{ files: \\[wetBeyond0.*\n"), "");
    EXPECT_NE(workshop.run("run"), 0);
    EXPECT_THAT(workshop.output, HasSubstr("condition 'wetBeyond' has no 'measured'"));
    EXPECT_FALSE(fs::exists(workshop.path() / "surrogate.work"));
    EXPECT_EQ(workshop.run("plan"), 0) << workshop.output;
}

/// A plan reports its cost and makes no runs; with --execute it makes them and reports the detectable effects.
TEST(Program, PlansBeforeItRuns)
{
    Workshop workshop;
    workshop.measure({});
    ASSERT_EQ(workshop.run("plan"), 0) << workshop.output;
    EXPECT_TRUE(std::regex_search(workshop.output, std::regex("effect library: (\\d+) runs, \\1 of them not made yet")))
        << workshop.output;
    EXPECT_TRUE(std::regex_search(workshop.output,
        std::regex("\\d+ training conditions with \\d+ numbers; 1 fitted parameter \\(friction\\); \\d+ effects")))
        << workshop.output;
    EXPECT_THAT(workshop.output, HasSubstr("2 conditions held out"));
    EXPECT_THAT(workshop.output, HasSubstr("of wall-clock time with "));
    EXPECT_TRUE(fs::is_empty(workshop.path() / "surrogate.work/cache"));
    const std::string right = contentOf(workshop.path() / "study.yaml");
    std::ofstream(workshop.path() / "study.yaml")
        << std::regex_replace(right, std::regex("role: heldOut"), "role: training");
    ASSERT_EQ(workshop.run("plan"), 0) << workshop.output;
    EXPECT_THAT(workshop.output, HasSubstr("nothing is held out"));
    std::ofstream(workshop.path() / "ghosts.yaml") << "effects: [ { name: ghost, set: { ectoplasm: a } } ]\n";
    std::ofstream(workshop.path() / "study.yaml") << right << "effectsFrom: ghosts.yaml\n";
    ASSERT_EQ(workshop.run("plan"), 0) << workshop.output;
    EXPECT_THAT(workshop.output, HasSubstr("left out: ghost (the case has no entry ectoplasm)"));
    std::ofstream(workshop.path() / "study.yaml") << right;
    ASSERT_EQ(workshop.run("plan --execute"), 0) << workshop.output;
    EXPECT_THAT(workshop.output, HasSubstr("named from"));
    EXPECT_THAT(workshop.output, HasSubstr("An effect is named if its residual is at least "));
    EXPECT_THAT(workshop.output, HasSubstr("addedMass"));
}

/// A plan that went to a full disk is not a plan: the program ends with an error. Status 0 would let a script go on without it.
TEST(Program, FailsWhereItsOutputIsLost)
{
    Workshop workshop;
    workshop.measure({});
    const std::string message = (workshop.path() / "message").string();
    const int status = std::system((std::string(TRACE_RESIDUAL) + " plan " + (workshop.path() / "study.yaml").string()
                                    + " > /dev/full 2> " + message)
                                       .c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_THAT(contentOf(message), HasSubstr("traceResidual: standard output could not be written"));
}

/// The time of a run is stated as an assumption until one run has been timed, and is stored then. The surrogate takes
/// far less than the 60 s that a study assumes by default.
TEST(Program, PlansByTheTimeOfOneRun)
{
    Workshop workshop;
    workshop.measure({});
    ASSERT_EQ(workshop.run("plan"), 0) << workshop.output;
    EXPECT_THAT(workshop.output, HasSubstr("s per run, an assumption"));
    ASSERT_EQ(workshop.run("plan --time"), 0) << workshop.output;
    std::smatch found;
    const std::regex said(R"(effect library: (\d+) runs, (\d+) of them not made yet.*\((\S+) s per run\))");
    ASSERT_TRUE(std::regex_search(workshop.output, found, said)) << workshop.output;
    EXPECT_EQ(std::stoi(found[2]), std::stoi(found[1]) - 1);
    EXPECT_LT(std::stod(found[3]), 30);
    const fs::directory_iterator stored(workshop.path() / "surrogate.work/cache");
    EXPECT_EQ(std::distance(begin(stored), end(stored)), 1);
    // No further run is made.
    ASSERT_EQ(workshop.run("plan --time"), 0) << workshop.output;
    EXPECT_TRUE(std::regex_search(workshop.output, found, said) && found[2] == std::to_string(std::stoi(found[1]) - 1));
}

/// A study whose case always writes the same table. \param condition  further keys of the condition
struct QuietStudy
{
    explicit QuietStudy(const std::string& condition)
    {
        folder.write("case/parameters", "x 0;\n");
        fs::permissions(folder.write("case/Allrun", "#!/bin/sh\nprintf '# t m\\n0 1\\n1 0.5\\n2 0\\n' > table\n"),
            fs::perms::owner_all);
        folder.write("study.yaml", "study: s\n"
                                   "simulator: { case: case, seed: none }\n"
                                   "observable: { file: table, time: t, value: m, features: "
                                   "[ { kind: logMeanRate, from: 0.9, to: 0.3 } ] }\n"
                                   "conditions: [ { name: only, role: training"
                                       + condition
                                       + " } ]\n"
                                         "effects: [ { name: nothing, set: { x: a } } ]\n");
    }

    int run(const std::string& command)
    {
        const auto file = folder.path() / "out";
        const int status = std::system((std::string(TRACE_RESIDUAL) + ' ' + command + ' '
                                        + (folder.path() / "study.yaml").string() + " > " + file.string() + " 2>&1")
                                           .c_str());
        output = contentOf(file);
        return WEXITSTATUS(status);
    }

    TemporaryFolder folder;
    std::string output;
};

/// If nothing scatters and no effect has an influence, a plan reports that no effect is detectable; it once ended with
/// SIGSEGV.
TEST(Program, PlansWithoutDetectableEffects)
{
    QuietStudy study("");
    EXPECT_EQ(study.run("plan --execute"), 0) << study.output;
    EXPECT_THAT(study.output, HasSubstr("each data set: about 5 further runs"));
    EXPECT_THAT(study.output, HasSubstr("up to about 29 if")) << "8 rounds of a fit and a neighbour, 4 rounds of pairs";
    EXPECT_THAT(study.output, HasSubstr("No effect is detectable"));
}

/// If runs do not scatter, a value without repeats and without a declared error is reported before a run is made.
TEST(Program, RequiresNoiseBeforeItRuns)
{
    QuietStudy study(", measured: { numbers: [ { feature: logMeanRate, unit: g/s, values: [0.5] } ] }");
    for (const std::string command : {"run", "plan"})
    {
        EXPECT_NE(study.run(command), 0);
        EXPECT_THAT(study.output, HasSubstr("noise cannot be estimated"));
        EXPECT_FALSE(fs::exists(study.folder.path() / "s.work"));
    }
}

/// So is a held-out value, whose noise would be that of the training data, if these have declared errors only.
TEST(Program, RequiresNoiseOfHeldOutValues)
{
    const auto condition = [](const std::string& error) {
        const std::string number = "measured: { numbers: [ { feature: logMeanRate, unit: kg/s, values: [0.5]";
        return ", " + number + ", relativeError: 0.02 } ] } }, { name: unseen, role: heldOut, " + number + error
               + " } ] }";
    };
    for (const std::string command : {"run", "plan"})
    {
        QuietStudy study(condition(""));
        EXPECT_NE(study.run(command), 0);
        EXPECT_THAT(study.output,
            AllOf(HasSubstr("study.yaml: condition 'unseen': 'logMeanRate' would count as exact; allowed: "),
                HasSubstr("relativeError")));
        EXPECT_FALSE(fs::exists(study.folder.path() / "s.work"));
    }
    QuietStudy study(condition(", relativeError: 0.02"));
    EXPECT_EQ(study.run("plan"), 0) << study.output;
}

TEST(Program, SaysWhatIsWrongAndWritesNothing)
{
    Workshop workshop;
    workshop.measure({});
    workshop.append("nonsense: 1\n");
    EXPECT_NE(workshop.run("run"), 0);
    EXPECT_THAT(workshop.output, HasSubstr("study.yaml:"));
    EXPECT_THAT(workshop.output, HasSubstr("allowed here"));
    EXPECT_FALSE(fs::exists(workshop.path() / "results"));
}

/// A folder of stored runs that cannot be made is named, with the entry that chooses another one.
TEST(Program, NamesTheFolderThatCannotBeMade)
{
    Workshop workshop;
    workshop.measure({});
    workshop.append("work: study.yaml/runs\n");
    EXPECT_NE(workshop.run("run"), 0);
    EXPECT_THAT(workshop.output, AllOf(HasSubstr("study.yaml/runs/cache: Not a directory"), HasSubstr("`work`")));
}

/// If the disk is full when the reports are written, the old reports stay complete, the error names the file, and `run`
/// and `report` fail. Without a check, half a report would replace the old one.
TEST(Program, FullDiskLeavesTheOldReports)
{
    Workshop workshop;
    workshop.measure({});
    ASSERT_EQ(workshop.run("run"), 0) << workshop.output;
    const auto before = sha256OfPath(workshop.path() / "results");
    const std::string noLargeFiles = "ulimit -f 16; trap '' XFSZ; ";
    for (const std::string command : {"run", "report"})
    {
        EXPECT_NE(workshop.run(command, noLargeFiles), 0) << workshop.output;
        EXPECT_THAT(workshop.output, HasSubstr("answer.json.unfinished: File too large"));
        EXPECT_EQ(sha256OfPath(workshop.path() / "results"), before);
    }
    std::ofstream(workshop.path() / "results/report.json") << R"({ "summary": "half)";
    workshop.append("nonsense: 1\n");
    EXPECT_NE(workshop.run("report"), 0);
    EXPECT_THAT(workshop.output, HasSubstr("report.json is damaged"));
}

/// A stored run with any damaged part is reported and repeated with the same result. Without checksums, all of these
/// damages but the empty record would give another curve without a message.
TEST(Runner, DamagedStore)
{
    Workshop workshop;
    workshop.measure({});
    const Study study = readStudy(workshop.path() / "study.yaml");
    std::ostringstream progress;
    const auto orderOf = [&](long seed) {
        return RunOrder{"./Allrun", study.conditions[0].file, {{"seed", std::to_string(seed)}}, seed, "test"};
    };
    const RunOrder order = orderOf(10007);
    CaseSimulator simulator(study, progress);
    const auto results = simulator.run({order, orderOf(10009)});
    const fs::path stored = study.work / "cache" / simulator.keyOf(order);
    const fs::path table = stored / "postProcessing/massInHopper/0/massInHopper.dat";
    const fs::path record = stored / "record.json";
    const std::vector<std::function<void()>> damages = {
        [&] { fs::resize_file(table, fs::file_size(table) / 2); },
        [&] { fs::resize_file(table, 0); },
        [&] { fs::remove(table); },
        [&] { writeWhole(table, replaced(contentOf(table), "0.1", "0.2")); },
        [&] { fs::resize_file(record, 0); },
        [&] { fs::resize_file(record, fs::file_size(record) - 3); },
        [&] { writeWhole(record, "[]"); },
        [&] { writeWhole(record, replaced(contentOf(record), "seconds\": ", "seconds\": 1")); },
        [&] { fs::remove(record); },
        [&] {
            fs::remove_all(stored);
            fs::copy(study.work / "cache" / simulator.keyOf(orderOf(10009)), stored, fs::copy_options::recursive);
        },
    };
    for (std::size_t i = 0; i < damages.size(); ++i)
    {
        damages[i]();
        std::ostringstream reported;
        CaseSimulator again(study, reported);
        EXPECT_EQ(again.missing({order}), 1) << i;
        const RunResult result = again.run({order})[0];
        EXPECT_FALSE(result.cached) << i;
        EXPECT_EQ(result.curve.value, results[0].curve.value) << i;
        EXPECT_THAT(reported.str(), HasSubstr("damaged")) << i;
        EXPECT_EQ(again.missing({order}), 0) << i;
    }
}

/// Orders that differ only in the file of the observable share a run, and each gets the curve of its own file. Another
/// study with the same store that needs a third file repeats the run and keeps the stored files. Before orders were
/// distinguished by their files, the second order got the curve of the first.
TEST(Runner, SeveralFilesOfOneRun)
{
    const TemporaryFolder folder;
    folder.write("case/parameters", "x 0;\n");
    const Study study = readStudy(
        folder.write("study.yaml", "study: s\nsimulator: { case: case, seed: none }\n"
                                   "observable: { file: a, time: t, value: m, features: [ { kind: residue } ] }\n"
                                   "conditions: [ { name: only, role: training } ]\n"));
    std::ostringstream progress;
    CaseSimulator simulator(study, progress);
    const auto orderOf = [](const std::string& file) {
        return RunOrder{R"~(for i in 1 2 3; do printf "# t m\n0 $i\n1 $i\n" > $(printf abc | cut -c$i); done)~", file,
            {}, 0, "test"};
    };
    const auto results = simulator.run({orderOf("a"), orderOf("b"), orderOf("d")});
    EXPECT_EQ(results[0].curve.value.at(0), 1);
    EXPECT_EQ(results[1].curve.value.at(0), 2);
    EXPECT_FALSE(results[0].cached);
    EXPECT_TRUE(results[1].cached);
    EXPECT_THAT(results[2].failure, HasSubstr("has not written"));
    EXPECT_EQ(simulator.missing({orderOf("a"), orderOf("b"), orderOf("c")}), 1);
    EXPECT_EQ(simulator.run({orderOf("c")})[0].curve.value.at(0), 3);
    EXPECT_EQ(simulator.missing({orderOf("a"), orderOf("b"), orderOf("c")}), 0);
}

/// Two studies with the same store need the same run at the same time: one makes it, and the other waits and finds it
/// stored. Without a lock, both would make it in the same folder and disturb each other.
TEST(Runner, TwoAtOnceInOneStore)
{
    Workshop workshop;
    workshop.measure({});
    std::ofstream(workshop.path() / "case/Allrun") << "#!/bin/sh\nsleep 0.3\nexec " SURROGATE_PROGRAM "\n";
    const Study study = readStudy(workshop.path() / "study.yaml");
    const RunOrder order{"./Allrun", study.conditions[0].file, {{"seed", "10007"}}, 10007, "test"};
    std::array<RunResult, 2> results;
    std::array<std::thread, 2> studies;
    for (std::size_t i = 0; i < studies.size(); ++i)
    {
        studies[i] = std::thread([&, i]() {
            std::ostringstream progress;
            results[i] = CaseSimulator(study, progress).run({order})[0];
        });
    }
    for (auto& one : studies)
    {
        one.join();
    }
    EXPECT_EQ(results[0].failure + results[1].failure, "");
    EXPECT_NE(results[0].cached, results[1].cached);
    EXPECT_EQ(results[0].curve.value, results[1].curve.value);
}

/// A run that ends on a full disk may have lost the end of its table without noticing: it does not count, the study stops
/// with the reason, and with room again it is made once more. One that counts changes the answer.
TEST(Runner, RunsOnAFullDiskDoNotCount)
{
    Workshop workshop;
    workshop.measure({});
    const Study study = readStudy(workshop.path() / "study.yaml");
    std::ostringstream progress;
    CaseSimulator simulator(study, progress);
    const RunOrder order{"./Allrun", study.conditions[0].file, {{"seed", "10007"}}, 10007, "test"};
    {
        const FullDisk disk;
        try
        {
            simulator.run({order});
            ADD_FAILURE() << "the run was taken";
        }
        catch (const std::exception& error)
        {
            EXPECT_THAT(error.what(), HasSubstr("is full; the run of test does not count"));
        }
    }
    EXPECT_EQ(CaseSimulator(study, progress).missing({order}), 1);
    const auto results = simulator.run({order});
    EXPECT_EQ(results[0].failure, "");
    EXPECT_FALSE(results[0].cached);
}

/// What a failed run has printed is kept for the report, and the progress has one line for each run.
TEST(Runner, ProgressIsALineForARun)
{
    Workshop workshop;
    workshop.measure({});
    const Study study = readStudy(workshop.path() / "study.yaml");
    std::ostringstream progress;
    CaseSimulator simulator(study, progress);
    const RunOrder order{"echo FOAM FATAL; echo of OpenFOAM; exit 3", study.conditions[0].file, {}, 0, "test"};
    EXPECT_THAT(simulator.run({order})[0].failure, HasSubstr("FOAM FATAL\n    of OpenFOAM"));
    const std::string said = progress.str();
    EXPECT_THAT(said, HasSubstr("1/1 test FAILED: 'echo FOAM FATAL"));
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 2) << said;
}

/// A run that fails with its seed is repeated with another one, and the failure is reported. The same holds with Slurm,
/// which is replaced by a script that runs the tasks of the array one after the other.
TEST(Runner, FailuresCacheAndSlurm)
{
    Workshop workshop;
    workshop.measure({});
    Study study = readStudy(workshop.path() / "study.yaml");
    std::ostringstream progress;
    const auto orderOf = [&](long seed) {
        return RunOrder{"./Allrun", study.conditions[0].file, {{"seed", std::to_string(seed)}}, seed, "test"};
    };
    {
        CaseSimulator simulator(study, progress);
        EXPECT_EQ(simulator.missing({orderOf(10007), orderOf(10007), orderOf(10009)}), 2);
        const auto results = simulator.run({orderOf(10007), orderOf(10007)});
        EXPECT_EQ(results[0].curve.value, results[1].curve.value);
        EXPECT_FALSE(results[0].cached);
        EXPECT_TRUE(results[1].cached) << "requested twice, made and counted once";
        EXPECT_EQ(simulator.missing({orderOf(10007)}), 0);
        RunOrder failing = orderOf(10009);
        failing.entries["failWithSeed"] = "10009";
        const auto failed = simulator.run({failing});
        EXPECT_THAT(failed[0].failure, HasSubstr("asked to fail with seed 10009"));
        EXPECT_EQ(simulator.missing({failing}), 0) << "what has failed would fail again";
        EXPECT_EQ(CaseSimulator(study, progress).missing({failing}), 1) << "in another call, a failure is not a result";
        Study reported = study;
        reported.settings.budget = 0;
        CaseSimulator reports(reported, progress);
        EXPECT_EQ(reports.missing({failing}), 0) << "with a budget of 0 the stored failure is reported";
        EXPECT_EQ(reports.run({failing})[0].failure, failed[0].failure);
        RunOrder strange = orderOf(10037);
        strange.command = "true";
        EXPECT_THAT(simulator.run({strange})[0].failure, HasSubstr("has not written"));
        // As a case does that begins with its Allclean.
        strange.command = "rm -f log.*; echo 'the valve is stuck'; exit 3";
        EXPECT_THAT(simulator.run({strange})[0].failure, HasSubstr("the valve is stuck"));
        strange.command = "printf 'caf\\351 is Latin 1\\n'; exit 3";
        EXPECT_THAT(simulator.run({strange})[0].failure, HasSubstr("is Latin 1")) << "the record is UTF-8";
    }
    // Results of an earlier run of the case, as fields of a later time and checkpoints, are not copied: a run would
    // resume from them.
    for (const char* left : {"case/0.36", "case/2", "case/checkpoints", "case/processor12"})
    {
        fs::create_directories(workshop.path() / left);
        std::ofstream(workshop.path() / left / "U") << "fields\n";
    }
    EXPECT_EQ(CaseSimulator(study, progress).missing({orderOf(10007)}), 0);
    // The study is not copied either, whatever its file is called; all other files are.
    writeWhole(workshop.path() / "case/study.yaml", "study: s\n");
    {
        Study within = study;
        within.file = workshop.path() / "results/../case/../case/study.yaml";
        fs::create_directories(workshop.path() / "results");
        EXPECT_EQ(CaseSimulator(within, progress).missing({orderOf(10007)}), 0);
    }
    fs::remove(workshop.path() / "case/study.yaml");
    writeWhole(workshop.path() / "case/processors", "2\n");
    EXPECT_EQ(CaseSimulator(study, progress).missing({orderOf(10007)}), 1);
    fs::remove(workshop.path() / "case/processors");
    // The store was made in a checkout that does not exist any more; the links must point into this one.
    const auto sibling = study.work / "tree" / workshop.path().filename() / "study.yaml";
    fs::remove(sibling);
    fs::create_symlink("/of/another/checkout/study.yaml", sibling);
    ASSERT_FALSE(fs::exists(sibling));
    EXPECT_EQ(CaseSimulator(study, progress).missing({orderOf(10007)}), 0);
    EXPECT_TRUE(fs::exists(sibling));
    // After any change of the case's files the run is made again.
    std::ofstream(workshop.path() / "case/parameters", std::ios::app) << "// changed\n";
    EXPECT_EQ(CaseSimulator(study, progress).missing({orderOf(10007)}), 1);

    const auto sbatch = workshop.path() / "bin/sbatch";
    fs::create_directories(sbatch.parent_path());
    std::ofstream(sbatch) << "#!/bin/bash\nfor word in \"$@\"; do case $word in --array=0-*) last=${word#--array=0-};; "
                             "*slurmArray) script=$word;; esac; done\n"
                             "for task in $(seq 0 ${last%%%*}); do SLURM_ARRAY_TASK_ID=$task bash $script; done\n";
    fs::permissions(sbatch, fs::perms::owner_all);
    const std::string path = std::getenv("PATH");
    setenv("PATH", (sbatch.parent_path().string() + ':' + path).c_str(), 1);
    study.executor.kind = "slurm";
    study.executor.processes = 4;
    CaseSimulator simulator(study, progress);
    const auto results = simulator.run({orderOf(10007), orderOf(10039)});
    setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(results[0].failure, "");
    EXPECT_GT(results[1].curve.time.size(), 10U);
}

} // namespace

} // namespace clepsydra::identification::tests
