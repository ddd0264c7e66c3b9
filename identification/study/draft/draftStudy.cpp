#include "study/draft/draftStudy.h"

#include "features/features.h"
#include "files/wholeFile.h"
#include "study/draft/draftedSimulator.h"
#include "study/draft/measuredFiles.h"
#include "study/yaml.h"
#include "tokens/didYouMean.h"

#include <yaml-cpp/emitter.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace clepsydra::identification
{

namespace
{

namespace fs = std::filesystem;

std::string fillIn(const std::string& what)
{
    return '"' + std::string(YamlPlace::toFillIn) + ": " + what + '"';
}

/// A text as a YAML value, quoted if necessary.
std::string yamlWord(const std::string& word)
{
    static const std::regex plain("[a-z][a-z0-9_./-]*", std::regex::icase);
    if (std::regex_match(word, plain) || word.rfind("../", 0) == 0)
    {
        return word;
    }
    YAML::Emitter emitter;
    emitter << YAML::DoubleQuoted << word;
    return emitter.c_str();
}

/// A number rounded to two digits.
std::string rounded(double number)
{
    std::ostringstream text;
    text.precision(2);
    text << number;
    return textOf(std::stod(text.str()));
}

/// Whether a number of a name may be a length in mm, beside the case's length in m.
bool isInMillimetres(const std::string& number, const std::string& length)
{
    constexpr double farApart = 10.0;
    const double ratio = number.empty() ? 0.0 : 1e-3 * std::atof(number.c_str()) / std::atof(length.c_str());
    return ratio > 1.0 / farApart && ratio < farApart;
}

class Draft
{
public:
    Draft(const fs::path& caseFolder, const std::vector<fs::path>& measured, const fs::path& study);

    std::string text() const
    {
        return text_.str();
    }
    const std::vector<std::string>& said() const
    {
        return said_;
    }

private:
    void writeHead();
    void writeSimulator();
    void writeObservable();
    void writeFeatures();
    void writeWindows(double last);
    void writePositions();
    void writeMeasured();
    void writeConditions();
    void writeCondition(const DraftedCondition& condition, const std::string& entry);
    void writeParameters();
    void writeEnd();

    void say(const std::string& what)
    {
        said_.push_back(what);
    }
    std::string relative(const fs::path& file) const
    {
        return yamlWord(fs::absolute(file).lexically_normal().lexically_relative(folder_).string());
    }
    /// The entry that is most likely to differ from condition to condition.
    std::string varied() const
    {
        return measured_.conditions.size() < 2      ? ""
               : simulator_.has("orificeDiameter")  ? "orificeDiameter"
               : simulator_.has("particleDiameter") ? "particleDiameter"
                                                    : "";
    }
    std::string twiceTheTank() const
    {
        return simulator_.has("tankDiameter") ? rounded(2.0 * std::atof(simulator_.entries.at("tankDiameter").c_str()))
                                              : fillIn("m, twice the tank's diameter");
    }
    bool isUnderWater(const DraftedCondition& condition) const
    {
        static const std::regex water("wet|water|subm", std::regex::icase);
        return std::regex_search(condition.name, water);
    }

    DraftedSimulator simulator_;
    MeasuredFiles measured_;
    fs::path folder_; // of the study file
    std::string name_;
    std::ostringstream text_;
    std::vector<std::string> said_;
};

Draft::Draft(const fs::path& caseFolder, const std::vector<fs::path>& measured, const fs::path& study)
    : simulator_(draftSimulator(caseFolder)),
      measured_(readMeasuredFiles(measured, simulator_)),
      folder_(fs::weakly_canonical(fs::absolute(study)).parent_path()),
      name_(simulator_.folder.filename().string()),
      said_(measured_.remarks)
{
    writeHead();
    writeSimulator();
    writeObservable();
    writeMeasured();
    writeConditions();
    writeParameters();
    writeEnd();
}

void Draft::writeHead()
{
    text_ << "# Drafted by `traceResidual new`. All values are guesses; check each line. Values \""
          << YamlPlace::toFillIn
          << "\"\n# could not be guessed; no run starts before they are replaced. All keys: docs/reference/study.md\n"
          << "study: " << yamlWord(name_) << "\n\n";
}

void Draft::writeSimulator()
{
    text_ << "simulator:\n  case: " << relative(simulator_.folder)
          << "\n  seed: " << (simulator_.has("seed") ? "seed" : "none")
          << (simulator_.has("seed") ? "          # this entry changes the packing\n"
                                     : "          # the case has no such entry; repeated runs do not differ\n");
    const std::vector<std::pair<std::string, std::string>> apparatus = {
        {"particleDiameter", "m"},
        {"particleDensity", "kg/m3"},
        {"particleCount", "number of particles in the hopper"},
        {"hopperDiameter", "m"},
        {"orificeDiameter", "m"},
        {"fluidDensity", "kg/m3"},
        {"fluidViscosity", "m2/s, kinematic"},
        {"tankDiameter", "m"},
        {"tankHeight", "m"},
        {"releaseHeight", "m, of the particle's centre above the floor"},
    };
    // A particle in a tank with one-way coupling: see docs/howTo/ownMeasurement.md.
    const std::vector<std::pair<std::string, std::string>> falling = {
        {"smoothingBandwidth",
            twiceTheTank() + "    # m, twice the tank's diameter, so that the liquid stays at rest on any mesh"},
        {"cellsCore", "2"},
        {"cellsRing", "2"},
        {"cellsHigh", "8"},
        {"couplingTimeStep", "5e-3"},
        {"demStep", "1e-4             # there are no contacts"},
        {"maxRayleighFraction", "100"},
    };
    text_ << "  set:                  # your apparatus; an entry that is left out keeps the value of the case\n"
          << "    checked: "
          << fillIn("the values below are those of the case; make them those of your apparatus, then "
                    "delete this line")
          << '\n';
    const bool isParticle = simulator_.observable == "particleHeight";
    if (isParticle && simulator_.has("vessel"))
    {
        text_ << "    vessel: tank        # or box; see the case's file parameters\n";
    }
    const bool isWet = isParticle || !simulator_.hasSteps
                       || std::any_of(measured_.conditions.begin(), measured_.conditions.end(),
                           [&](const auto& c) { return isUnderWater(c); });
    for (const auto& [entry, unit] : apparatus)
    {
        const bool isOfWater = entry.rfind("fluid", 0) == 0 || (!isParticle && entry.rfind("tank", 0) == 0);
        if (simulator_.has(entry) && entry != varied() && (isWet || !isOfWater))
        {
            text_ << "    " << entry << ": " << simulator_.entries.at(entry) << "    # " << unit << '\n';
        }
    }
    const double seconds = 1.5 * measured_.shape.duration * measured_.columns.time.siUnits();
    for (const std::string entry : {"dryTime", "submergedTime", "endTime"})
    {
        if (simulator_.has(entry) && (isWet || entry != "submergedTime"))
        {
            text_ << "    " << entry << ": "
                  << (measured_.columns.time.unit.empty()
                             ? fillIn("s, more than the longest record")
                             : rounded(seconds) + "        # 1.5 times the longest training record")
                  << '\n';
        }
    }
    for (const auto& [entry, value] : falling)
    {
        if (isParticle && measured_.shape.bounces == 0 && simulator_.has(entry))
        {
            text_ << "    " << entry << ": " << value << '\n';
        }
    }
}

void Draft::writeObservable()
{
    text_ << "\nobservable:\n";
    if (simulator_.observable.empty())
    {
        text_ << "  file: " << fillIn("the table that a run writes, as post/*/m.dat; a folder * stands for start times")
              << '\n'
              << "  value: " << fillIn("its column") << '\n';
        say("observable: unknown, because the case writes no known table");
    }
    else
    {
        const bool isSpeed = measured_.columns.quantity == "speed";
        text_ << "  file: " << (simulator_.hasSteps ? "steps/dry/" : "") << "postProcessing/" << simulator_.observable
              << "/*/" << simulator_.observable << ".dat\n"
              << "  value: "
              << (simulator_.observable == "massInHopper" ? "mass"
                     : isSpeed                            ? "velocity"
                                                          : "height")
              << '\n';
        if (isSpeed)
        {
            text_ << "  factor: -1            # in the case, upward speeds are positive\n";
        }
        if (measured_.columns.quantity == "length" && measured_.shape.bounces > 0)
        {
            text_ << "  offset: -particleDiameter/2       # gives the gap below the particle instead of the height of "
                     "its "
                     "centre\n";
        }
        if (measured_.columns.quantity == "length" && !measured_.shape.falls)
        {
            text_ << "  # The measured position grows while the particle falls: it is the distance from the release\n"
                  << "  factor: -1\n  offset: releaseHeight\n";
        }
        say("observable: " + simulator_.observable + ", which the case writes");
    }
    text_ << "  # modelError: 0.01    # standard deviation of the model error (mesh, time steps) of each feature\n"
          << "  features:\n";
    writeFeatures();
}

void Draft::writeFeatures()
{
    const bool isShare = measured_.columns.quantity == "share";
    if (measured_.columns.quantity == "mass" || isShare)
    {
        writeWindows(measured_.shape.falls ? measured_.shape.largestRest : 0.2);
    }
    else if (measured_.columns.quantity == "length")
    {
        writePositions();
    }
    else if (measured_.columns.quantity == "speed")
    {
        text_ << "    - { kind: logMaximum }\n";
    }
    else
    {
        text_ << "    - { kind: " << fillIn("one of " + listed(namesOf(featureKinds()))) << " }\n";
    }
}

/// Three windows of the mass that all curves pass through.
void Draft::writeWindows(double last)
{
    constexpr double from = 0.95;
    const double to = std::ceil((last + 0.03) * 20.0) / 20.0;
    if (to > 0.85)
    {
        text_ << "    - { kind: logMeanRate, from: 0.95, to: "
              << fillIn("smaller share of the fill; a training file ends at " + rounded(last)) << " }\n";
        return;
    }
    const std::vector<std::string> names = {"early", "middle", "late"};
    text_ << "    # Mean rates between two shares of the fill, which all training files pass through\n";
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        const auto share = [&](std::size_t end) {
            return rounded(from - (from - to) * static_cast<double>(end) / static_cast<double>(names.size()));
        };
        text_ << "    - { name: " << names[i] << ", kind: logMeanRate, from: " << share(i) << ", to: " << share(i + 1)
              << " }\n";
    }
    if (measured_.shape.endsFlat)
    {
        text_ << "    - { kind: residue }   # all training files end with a constant mass\n";
    }
}

void Draft::writePositions()
{
    const double unit = measured_.columns.value.siUnits();
    const double way = (measured_.shape.highest - measured_.shape.lowest) * unit;
    for (int bounce = 1; bounce <= measured_.shape.bounces && bounce <= 3; ++bounce)
    {
        const std::string number = std::to_string(bounce);
        text_ << "    - { name: height" << number << ", kind: logBounceHeight, bounce: " << number
              << ", level: " << rounded(0.02 * way) << " }\n";
        if (bounce < measured_.shape.bounces)
        {
            text_ << "    - { name: duration" << number << ", kind: logBounceDuration, bounce: " << number
                  << ", level: " << rounded(0.02 * way) << " }\n";
        }
    }
    if (measured_.shape.bounces > 0)
    {
        return;
    }
    const bool isKnown = way > 0.0 && !measured_.columns.value.unit.empty();
    text_ << "    # Speeds between two positions [m], which all training files pass through\n";
    const auto position = [&](double share) {
        const double at = measured_.shape.falls ? measured_.shape.highest * unit - share * way
                                                : measured_.shape.lowest * unit + share * way;
        return isKnown ? rounded(at) : fillIn("m");
    };
    for (const auto& [name, from, to] : {std::tuple("first", 0.2, 0.5), std::tuple("second", 0.5, 0.8)})
    {
        text_ << "    - { name: " << name << ", kind: logSpeed, from: " << position(from) << ", to: " << position(to)
              << " }\n";
    }
}

void Draft::writeMeasured()
{
    const auto unit = [](const GuessedColumn& column, const std::string& allowed) {
        return column.unit.empty() ? fillIn(allowed) : yamlWord(column.unit);
    };
    text_ << "\nmeasured:               # columns of all files, by name or number\n"
          << "  time: { column: " << yamlWord(measured_.columns.time.column)
          << ", unit: " << unit(measured_.columns.time, "s, ms, min or h") << " }\n"
          << "  value: { column: " << yamlWord(measured_.columns.value.column)
          << ", unit: " << unit(measured_.columns.value, "one of g, kg, mm, m, ...");
    const std::string fill = "the mass in the hopper at the start, in kg";
    const bool isShare = measured_.columns.quantity == "share";
    const bool isOfHopper = isShare || measured_.columns.quantity == "mass";
    const bool isRising = isOfHopper && !measured_.shape.falls;
    const bool isDownwards =
        measured_.columns.quantity == "speed" && measured_.shape.lowest + measured_.shape.highest < 0.0;
    if (isShare)
    {
        text_ << ", factor: " << fillIn((isRising ? "minus " : "") + fill);
    }
    else if (isRising || isDownwards)
    {
        text_ << ", factor: -1";
    }
    if (isRising)
    {
        text_ << ", offset: " << fillIn(fill + "; the files contain the discharged mass");
    }
    const bool isValidKnown =
        measured_.shape.hasBlanks && measured_.shape.smallestSeen > 0.0 && !measured_.columns.value.unit.empty();
    if (isValidKnown)
    {
        const double si = measured_.columns.value.siUnits();
        text_ << ", valid: [" << rounded(0.5 * measured_.shape.smallestSeen * si) << ", "
              << rounded(2.0 * measured_.shape.largest * si) << ']';
    }
    text_ << " }\n";
    if (isValidKnown)
    {
        text_ << "  # valid [m]: rows of 0 before or after all others count as missing\n";
        say("valid: rows of 0 at the ends of files count as missing");
    }
}

void Draft::writeConditions()
{
    text_ << R"(
# One item per condition; its files are repeats. Files whose names differ in a mark at the end (10a and 10b, _1 and _2)
# are taken for repeats, all others for conditions; move a file to correct that. A condition with `role: heldOut` enters
# no fit, and the answer is tested on it. Roles are PROPOSED by the names alone, one condition inside the range and one
# at its end: decide now, before any of these values or any result has been seen, and do not change the roles later.
conditions:
)";
    for (const auto& condition : measured_.conditions)
    {
        writeCondition(condition, varied());
    }
    if (std::none_of(
            measured_.conditions.begin(), measured_.conditions.end(), [](const auto& c) { return c.isHeldOut; }))
    {
        say("held out: none, because there are fewer than three conditions; the prediction cannot be tested");
    }
}

void Draft::writeCondition(const DraftedCondition& condition, const std::string& entry)
{
    text_ << "  - name: " << yamlWord(condition.name)
          << "\n    role: " << (condition.isHeldOut ? "heldOut       # PROPOSED" : "training") << '\n';
    if (!simulator_.tagValues.empty() && simulator_.observable == "massInHopper")
    {
        const bool isWet = isUnderWater(condition);
        text_ << "    tags: { medium: " << (isWet ? "water" : "air") << " }\n";
        if (simulator_.hasSteps)
        {
            text_ << "    command: ./Allrun mesh filling " << (isWet ? "submerged" : "dry") << '\n'
                  << (isWet ? "    file: steps/submerged/postProcessing/massInHopper/*/massInHopper.dat\n" : "");
        }
    }
    if (!entry.empty())
    {
        const bool isPlausible = isInMillimetres(condition.number, simulator_.entries.at(entry));
        text_ << "    set: { " << entry << ": "
              << (isPlausible ? condition.number + "e-3 }   # m, from the name; or another entry that differs here"
                              : fillIn("m; or replace the entry by one that differs in this condition") + " }")
              << '\n';
    }
    text_ << "    measured:\n      files:\n";
    std::string names;
    for (const auto& file : condition.files)
    {
        text_ << "        - " << relative(file) << '\n';
        names += ' ' + file.filename().string();
    }
    say("condition " + condition.name + (condition.isHeldOut ? ", proposed to be held out:" : ":") + names
        + (condition.files.size() > 1 ? " (repeats)" : " (one file; the noise is estimated from repeats)"));
}

void Draft::writeParameters()
{
    text_ << "\n# Fitted parameters have one value in all conditions; the prior is an independent measurement, a "
             "handbook's\n# value or a guess (from: measured, handbook, guess), never these data\n"
          << "parameters:\n";
    if (simulator_.has("friction"))
    {
        text_ << "  - name: friction\n    set: { friction: friction }\n    prior: { mean: "
              << fillIn("friction between particles, measured independently on a tilted plate")
              << ", sd: " << fillIn("its standard error") << ", from: measured }\n    range: [0.02, 0.8]\n";
    }
    else if (simulator_.has("fluidViscosity"))
    {
        text_ << "  - name: logViscosity  # relative to fluidViscosity above\n"
              << "    set: { fluidViscosity: \"fluidViscosity*exp(logViscosity)\" }\n    prior: { mean: 0, sd: "
              << fillIn("relative standard error of the viscosity, 0.05 for 5 %")
              << ", from: " << fillIn("of the viscosity: measured, handbook or guess") << " }\n    range: [-1, 1]\n";
    }
    else
    {
        text_ << "  - name: " << fillIn("a word")
              << "\n    set: " << fillIn("{ entry: formula in the parameter's name }")
              << "\n    prior: { mean: " << fillIn("number") << ", sd: " << fillIn("number")
              << ", from: " << fillIn("measured, handbook or guess") << " }\n    range: " << fillIn("[lowest, highest]")
              << '\n';
    }
}

void Draft::writeEnd()
{
    text_
        << "\n# Effects that the model may lack. Narrow their ranges to your knowledge; add your own below `effects:`\n"
        << "effectsFrom: "
        << (simulator_.library.empty() ? fillIn("a library, as identification/effects/hopper.yaml")
                                       : relative(simulator_.library))
        << "\n# withoutEffects: [effects that you have measured or excluded]\n"
        << "# commonErrors: errors common to all repeats, as that of a particle's diameter that was measured once\n"
        << "\nbudget: { runs: 300 }\n";
    if (!simulator_.library.empty())
    {
        say("effects: " + simulator_.library.filename().string() + "; the case has the entries of "
            + std::to_string(simulator_.fitting) + " of its " + std::to_string(simulator_.effects) + " effects");
    }
}

} // namespace

void draftStudy(
    const fs::path& caseFolder, const std::vector<fs::path>& measured, const fs::path& study, std::ostream& out)
{
    if (fs::exists(fs::symlink_status(study)))
    {
        throw std::runtime_error(
            study.string() + " exists already and is not overwritten; --output chooses another file");
    }
    const Draft draft(caseFolder, measured, study);
    writeWhole(study, draft.text());
    out << study.string() << " has been written. Please check these guesses:\n";
    for (const auto& each : draft.said())
    {
        out << "  " << each << '\n';
    }
    out << "Please fill in these values:\n"
        << YamlPlace::placesToFillIn(study) << "Then run: traceResidual plan " << study.string() << '\n';
}

} // namespace clepsydra::identification
