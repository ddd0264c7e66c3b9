#include "study/draft/draftStudy.h"

#include "curves/table.h"
#include "features/features.h"
#include "files/wholeFile.h"
#include "lists.h"
#include "study/measurements.h"
#include "study/yaml.h"
#include "tokens/didYouMean.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

namespace fs = std::filesystem;

// The draft with its item of a condition. <word> stands for a guess, and <word|text> for a guess or, without one, for the
// text. A line is left out if there is no guess for one of its other words, which may stand before it in brackets. `case.`
// begins the entries of the case.
constexpr const char* studyTemplate =
#include "study/draft/study.template"
    ;
constexpr const char* conditionTemplate =
#include "study/draft/condition.template"
    ;

/// Guesses by the words of the templates. A word that is only a condition has an empty guess.
using Guesses = std::map<std::string, std::string>;

/// A word as a YAML value, quoted if necessary.
std::string yaml(const std::string& word)
{
    return YAML::Dump(YAML::Node(word));
}

/// What is known of the study so far.
struct Draft
{
    fs::path folder; // of the study file
    Guesses guesses = {};
    std::string said = {}; // for the user to check

    bool has(const std::string& word) const
    {
        return guesses.count(word) > 0;
    }
    void setIf(bool isTrue, const std::string& word, const std::string& guess = "")
    {
        if (isTrue)
        {
            guesses[word] = guess;
        }
    }
    void say(const std::string& what)
    {
        said += "\n  " + what;
    }
    std::string relative(const fs::path& file) const
    {
        return yaml(fs::absolute(file).lexically_normal().lexically_relative(folder).string());
    }
};

/// The text of a template.
std::string filled(const std::string& pattern, const Guesses& guesses)
{
    static const std::regex place(R"(^\[([\w.]+)\]|<([\w.]+)(\|([^>]*))?>)");
    std::istringstream lines(pattern);
    std::string text;
    for (std::string line; std::getline(lines, line);)
    {
        std::string written;
        std::smatch match;
        bool isKept = true;
        for (; isKept && std::regex_search(line, match, place); line = match.suffix())
        {
            const auto guess = guesses.find(match[1].matched ? match[1] : match[2]);
            isKept = guess != guesses.end() || match[3].matched;
            written += match.prefix();
            if (isKept && !match[1].matched)
            {
                written += guess == guesses.end() ? match[4].str() : guess->second;
            }
        }
        text += isKept ? written + line + '\n' : "";
    }
    return text;
}

/// A number rounded to two digits.
std::string rounded(double number)
{
    std::ostringstream text;
    text.precision(2);
    text << number;
    return textOf(std::stod(text.str()));
}

//--- The case -------------------------------------------------------------------------------------------------------

/// Folder identification/effects of the checkout that contains the case; without one, of that whose scripts/environment
/// was sourced, or that contains the program.
fs::path effectsFolder(const fs::path& caseFolder)
{
    const char* const sourced = std::getenv("CLEPSYDRA");
    for (fs::path folder :
        {caseFolder, fs::path(sourced == nullptr ? "" : sourced), fs::read_symlink("/proc/self/exe")})
    {
        for (; folder.has_relative_path(); folder = folder.parent_path())
        {
            if (fs::is_directory(folder / "identification/effects"))
            {
                return folder / "identification/effects";
            }
        }
    }
    return {};
}

/// \return the quantity that the case writes: mass, length, or empty if it is unknown
std::string guessCase(const fs::path& folder, Draft& draft)
{
    if (!fs::is_regular_file(folder / entriesFile) || !fs::is_regular_file(folder / "Allrun"))
    {
        throw std::runtime_error(folder.string()
                                 + " is not a case, which needs a file 'parameters' of lines 'name value;' and "
                                   "a program 'Allrun' that reads it");
    }
    for (const auto& [entry, value] : readEntries(folder / entriesFile))
    {
        draft.guesses["case." + entry] = value;
    }
    draft.guesses["case"] = draft.relative(folder);
    draft.guesses["study"] = yaml(folder.filename());
    draft.setIf(draft.has("case.seed"), "seed", "seed");
    draft.setIf(!draft.has("case.friction"), draft.has("case.fluidViscosity") ? "viscosity" : "otherParameter");
    const fs::path controlDict = folder / "system/controlDict";
    const std::string functions = fs::exists(controlDict) ? clepsydra::textOf(controlDict) : "";
    const bool isHopper = functions.find("massInHopper") != std::string::npos;
    const bool isParticle = !isHopper && functions.find("particleHeight") != std::string::npos;
    const std::string observable = isHopper ? "massInHopper" : "particleHeight";
    const bool hasSteps = fs::exists(folder / "step.dry") && fs::exists(folder / "step.submerged");
    draft.setIf(isHopper, "medium", "air");
    draft.setIf(isHopper && hasSteps, "step", "dry");
    draft.setIf(isHopper || isParticle, "file",
        std::string(hasSteps ? "steps/dry/" : "") + "postProcessing/" + observable + "/*/" + observable + ".dat");
    draft.say("observable: "
              + (isHopper || isParticle ? observable + ", which the case writes" : "unknown, it must be filled in"));
    return isHopper ? "mass" : isParticle ? "length" : "";
}

//--- The measured files -----------------------------------------------------------------------------------------------

/// Files, which must be tables, and all tables of folders.
std::vector<fs::path> tablesOf(const std::vector<fs::path>& places, Draft& draft)
{
    std::set<fs::path> tables;
    for (const auto& place : places)
    {
        if (!fs::is_directory(place))
        {
            readTable(place);
            tables.insert(place);
            continue;
        }
        const std::size_t before = tables.size();
        for (const auto& entry : fs::directory_iterator(place))
        {
            const fs::path& file = entry.path();
            try
            {
                if (contains(std::vector<fs::path>{".csv", ".txt", ".dat", ".tsv"}, file.extension()))
                {
                    readTable(file);
                    tables.insert(file);
                }
            }
            catch (const std::runtime_error& error)
            {
                draft.say("left out: " + std::string(error.what()));
            }
        }
        if (tables.size() == before)
        {
            throw std::runtime_error(place.string()
                                     + ": contains no table of numbers; expected are files .csv, .txt, .dat or .tsv "
                                       "with a column of times and one of values");
        }
    }
    return {tables.begin(), tables.end()};
}

/// Reads all files; the values of held-out conditions are checked and left out.
std::vector<Curve> trainingCurves(
    const std::vector<DraftedCondition>& conditions, const GuessedColumns& columns, const fs::path& first)
{
    std::vector<Curve> curves;
    for (const auto& condition : conditions)
    {
        for (const auto& file : condition.files)
        {
            try
            {
                curves.insert(
                    curves.end(), condition.isHeldOut ? 0 : 1, readMeasured(file, columns.time, columns.value));
            }
            catch (const std::runtime_error& error)
            {
                throw std::runtime_error(std::string(error.what()) + " (the study has the columns of " + first.string()
                                         + "; files with other columns need another study)");
            }
        }
    }
    return curves;
}

/// Valid range of positions that are exactly 0 in three rows or more at an end of a file, where a camera saw nothing.
void guessBlanks(const std::vector<Curve>& curves, ColumnSpecification& column)
{
    std::vector<double> seen;
    bool hasBlanks = false;
    for (const auto& curve : curves)
    {
        const auto& value = curve.value;
        hasBlanks = hasBlanks || std::count(value.begin(), value.begin() + 3, 0.0) == 3
                    || std::count(value.end() - 3, value.end(), 0.0) == 3;
        std::copy_if(value.begin(), value.end(), std::back_inserter(seen), [](double number) { return number != 0.0; });
    }
    const auto [smallest, largest] = std::minmax_element(seen.begin(), seen.end());
    if (hasBlanks && !seen.empty() && *smallest > 0.0)
    {
        column.lowest = 0.5 * *smallest;
        column.highest = 2.0 * *largest;
    }
}

/// Guesses from the curves of the training conditions, which are in SI units if their units are known.
void guessFeatures(const std::vector<Curve>& curves, const GuessedColumns& columns, Draft& draft)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto& quantity = columns.quantity;
    const bool isOfHopper = quantity == "share" || quantity == "mass";
    bool bounces = quantity == "length";
    bool endsFlat = true;
    int falling = 0;
    double duration = 0.0;
    double rest = 0.0;         // largest ratio of last to first value
    double lowest = -infinity; // limits of the range that all curves pass through
    double highest = infinity;
    for (const auto& curve : curves)
    {
        const auto& value = curve.value;
        const auto [low, high] = std::minmax_element(value.begin(), value.end());
        const double range = *high - *low;
        // A bouncing particle is highest at the start.
        const bool falls = value.front() - *low > 0.5 * range;
        falling += falls ? 1 : -1;
        double lowestYet = value.front();
        double rise = 0.0; // largest, above the lowest value before
        for (const double here : value)
        {
            lowestYet = std::min(lowestYet, here);
            rise = std::max(rise, here - lowestYet);
        }
        bounces = bounces && falls && rise > 0.03 * range;
        lowest = std::max(lowest, *low);
        highest = std::min(highest, *high);
        rest = std::max(rest, value.back() / value.front());
        const double nearEnd = valueAt(curve, 0.1 * curve.time.front() + 0.9 * curve.time.back());
        endsFlat = endsFlat && std::abs(nearEnd - value.back()) < 0.01 * range;
        duration = std::max(duration, curve.time.back() - curve.time.front());
    }
    const bool falls = falling > 0;
    const double way = highest - lowest;
    const double to = std::ceil(((falls ? rest : 0.2) + 0.03) * 20.0) / 20.0;
    draft.setIf(!columns.time.unit.empty(), "duration", rounded(1.5 * duration));
    for (int i = 1; i <= 3; ++i)
    {
        const double at = falls ? highest - (0.3 * i - 0.1) * way : lowest + (0.3 * i - 0.1) * way;
        draft.setIf(to < 0.87, "share" + std::to_string(i), rounded(0.95 - (0.95 - to) * i / 3.0));
        draft.setIf(way > 0.0 && !columns.value.unit.empty(), "position" + std::to_string(i), rounded(at));
    }
    draft.setIf(isOfHopper, "isOfHopper");
    draft.setIf(!quantity.empty(), "of." + quantity);
    draft.setIf(quantity.empty(), "kinds", listed(namesOf(featureKinds())));
    draft.setIf(true, falls ? "falls" : "rises");
    draft.setIf(true, bounces ? "bounces" : "isSmooth", rounded(0.02 * way));
    draft.setIf(endsFlat, "endsFlat");
    draft.setIf(lowest + highest < 0.0, "isNegative");
    if (!isOfHopper && !bounces && draft.has("case.smoothingBandwidth") && draft.has("case.tankDiameter"))
    {
        draft.guesses["twiceTheTank"] = rounded(2.0 * std::atof(draft.guesses["case.tankDiameter"].c_str()));
    }
    draft.say("columns: time is '" + columns.time.column + "' [" + columns.time.unit + "], value '"
              + columns.value.column + "' [" + columns.value.unit + "], "
              + (quantity.empty() ? "of unknown kind" : "a " + quantity)
              + (bounces  ? " that bounces"
                  : falls ? " that falls"
                          : " that rises"));
}

/// \param written  quantity that the case writes
void guessMeasured(const std::vector<DraftedCondition>& conditions, const std::string& written, Draft& draft)
{
    const auto isTraining = [](const DraftedCondition& condition) { return !condition.isHeldOut; };
    const fs::path first = std::find_if(conditions.begin(), conditions.end(), isTraining)->files.front();
    GuessedColumns columns = guessColumns(first);
    columns.quantity = columns.quantity.empty() ? written : columns.quantity;
    const std::string other = written == "mass" ? "share" : "speed";
    if (!written.empty() && columns.quantity != written && columns.quantity != other)
    {
        throw std::runtime_error(first.string() + ": column '" + columns.value.column + "' is a " + columns.quantity
                                 + ", but the case writes a " + written + "; is it the right case?");
    }
    auto curves = trainingCurves(conditions, columns, first);
    if (columns.quantity == "length")
    {
        guessBlanks(curves, columns.value);
        curves = trainingCurves(conditions, columns, first);
    }
    draft.guesses["timeColumn"] = yaml(columns.time.column);
    draft.guesses["valueColumn"] = yaml(columns.value.column);
    draft.setIf(!columns.time.unit.empty(), "timeUnit", columns.time.unit);
    draft.setIf(!columns.value.unit.empty(), "valueUnit", yaml(columns.value.unit));
    const bool hasRange = columns.value.highest > 0.0 && !columns.value.unit.empty();
    draft.setIf(hasRange, "lowestValid", rounded(columns.value.lowest));
    draft.setIf(hasRange, "highestValid", rounded(columns.value.highest));
    const std::string ofParticle = columns.quantity == "speed" ? "velocity" : "height";
    draft.setIf(!written.empty(), "value", written == "mass" ? "mass" : ofParticle);
    guessFeatures(curves, columns, draft);
}

void writeConditions(const std::vector<DraftedCondition>& conditions, Draft& draft)
{
    static const std::regex water("wet|water|subm", std::regex::icase);
    const std::string entry = draft.has("case.orificeDiameter") ? "orificeDiameter" : "particleDiameter";
    const bool isVaried = conditions.size() > 1 && draft.has("case." + entry);
    for (const auto& condition : conditions)
    {
        Draft own{draft.folder, draft.guesses};
        own.guesses["name"] = yaml(condition.name);
        own.guesses["role"] = condition.isHeldOut ? "heldOut       # PROPOSED" : "training";
        const bool isWet = std::regex_search(condition.name, water);
        own.setIf(isWet && own.has("medium"), "medium", "water");
        own.setIf(isWet && own.has("step"), "isSubmerged");
        own.setIf(isWet && own.has("step"), "step", "submerged");
        own.setIf(isVaried, "entry", entry);
        // Lengths in names are in mm; a number that is far from the case's length means something else.
        const double ratio =
            1e-3 * std::atof(condition.number.c_str()) / std::atof(own.guesses["case." + entry].c_str());
        own.setIf(ratio > 0.1 && ratio < 10.0, "length", condition.number + "e-3");
        std::string names;
        for (const auto& file : condition.files)
        {
            own.guesses["files"] += (names.empty() ? "        - " : "\n        - ") + draft.relative(file);
            names += ' ' + file.filename().string();
        }
        draft.guesses["conditions"] += filled(conditionTemplate, own.guesses);
        draft.say("condition " + condition.name + (condition.isHeldOut ? ", proposed to be held out:" : ":") + names
                  + (condition.files.size() > 1 ? " (repeats)" : " (one file; the noise is estimated from repeats)"));
    }
    draft.guesses.erase(isVaried ? "case." + entry : "");
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
    Draft draft{fs::weakly_canonical(fs::absolute(study)).parent_path()};
    const fs::path folder = fs::weakly_canonical(caseFolder);
    const std::string written = guessCase(folder, draft);
    const auto conditions = draftConditions(tablesOf(measured, draft));
    guessMeasured(conditions, written, draft);
    writeConditions(conditions, draft);
    const fs::path library =
        effectsFolder(folder) / (draft.has("isOfHopper") ? "hopper.yaml" : "settlingParticle.yaml");
    draft.setIf(fs::exists(library) && !draft.has("kinds"), "library", draft.relative(library));
    draft.say(
        "effects: " + (draft.has("library") ? library.filename().string() : "unknown, a library must be filled in"));
    writeWhole(study, filled(studyTemplate, draft.guesses));
    out << study.string() << " has been written. Please check these guesses:" << draft.said
        << "\nPlease fill in these values:\n"
        << YamlPlace::placesToFillIn(study) << "Then run: traceResidual plan " << study.string() << '\n';
}

} // namespace clepsydra::identification
