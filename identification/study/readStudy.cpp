#include "study/readStudy.h"

#include "effects/measuringChain.h"
#include "study/units.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace clepsydra::identification
{

namespace
{

Entries readWords(const YamlPlace& place)
{
    Entries words;
    for (const auto& [key, value] : place.map())
    {
        words[key] = value.text();
    }
    return words;
}

Entries readValues(const YamlPlace& place)
{
    for (const auto& [entry, value] : place.map())
    {
        requireEntryValue(value);
    }
    return readWords(place);
}

RigSpecification readRig(const YamlPlace& place)
{
    place.allow({"case", "command", "entriesFile", "set", "seed", "dependsOn", "version", "costPerRun", "timeLimit",
        "keepRuns"});
    RigSpecification rig;
    rig.caseFolder = place.at("case").path();
    rig.command = place.textOr("command", rig.command);
    rig.entriesFile = place.textOr("entriesFile", rig.entriesFile);
    rig.seedEntry = place.at("seed").text() == "none" ? "" : place.at("seed").text();
    rig.version = place.textOr("version", "");
    rig.keepRuns = place.flagOr("keepRuns", false);
    rig.costPerRun = place.has("costPerRun") ? place.at("costPerRun").positive() : rig.costPerRun;
    rig.timeLimit = place.has("timeLimit") ? place.at("timeLimit").positive() : 0.0;
    if (place.has("set"))
    {
        rig.entries = readValues(place.at("set"));
    }
    if (place.has("dependsOn"))
    {
        for (const auto& file : place.at("dependsOn").oneOrMore())
        {
            rig.dependsOn.push_back(file.path());
            if (!std::filesystem::exists(rig.dependsOn.back()))
            {
                file.fail("no such file: " + rig.dependsOn.back().string());
            }
        }
    }
    if (!std::filesystem::is_regular_file(rig.caseFolder / rig.entriesFile))
    {
        place.at("case").fail("there is no file " + (rig.caseFolder / rig.entriesFile).string());
    }
    return rig;
}

Feature readFeature(const YamlPlace& place, double& modelError)
{
    std::vector<std::string> kinds;
    for (const auto& [name, kind] : featureKinds())
    {
        kinds.push_back(name);
    }
    const FeatureKind& kind = featureKinds().at(place.at("kind").oneOf(kinds));
    std::vector<std::string> allowed = {"name", "kind", "modelError"};
    for (const auto& parameter : kind.parameters)
    {
        allowed.push_back(parameter.name);
    }
    place.allow(allowed);
    Feature feature{place.textOr("name", kind.name), &kind, {}};
    for (const auto& parameter : kind.parameters)
    {
        if (std::isnan(parameter.byDefault) && !place.has(parameter.name))
        {
            place.fail("a " + kind.name + " needs '" + parameter.name + "': " + parameter.meaning);
        }
        feature.parameters[parameter.name] = place.numberOr(parameter.name, parameter.byDefault);
    }
    modelError = place.numberOr("modelError", modelError);
    return feature;
}

void readObservable(const YamlPlace& place, Study& study, std::string& file)
{
    place.allow({"file", "time", "value", "factor", "offset", "features", "modelError"});
    file = place.at("file").text();
    study.timeColumn = place.textOr("time", "time");
    study.valueColumn = place.at("value").text();
    study.valueFactor = place.numberOr("factor", 1.0);
    study.valueOffset = place.numberOr("offset", 0.0);
    std::vector<double> errors;
    for (const auto& each : place.at("features").list())
    {
        errors.push_back(place.numberOr("modelError", 0.0));
        study.features.push_back(readFeature(each, errors.back()));
        const auto& name = study.features.back().name;
        if (std::count_if(study.features.begin(), study.features.end(), [&](const auto& f) { return f.name == name; })
            > 1)
        {
            each.fail("there are two features named '" + name + "': give them a 'name'");
        }
    }
    if (study.features.empty())
    {
        place.at("features").fail("needs at least one");
    }
    study.modelError = Eigen::Map<Eigen::VectorXd>(errors.data(), static_cast<Eigen::Index>(errors.size()));
}

double unitOf(const YamlPlace& place)
{
    try
    {
        return siUnitsPer(place.at("unit").text());
    }
    catch (const std::invalid_argument& error)
    {
        place.at("unit").fail(error.what());
    }
}

/// The unit must be stated; `factor` (of sign or scale) and `offset`, in SI units, come after it.
ColumnSpecification readColumn(const YamlPlace& place)
{
    place.allow({"column", "unit", "factor", "offset", "valid"});
    ColumnSpecification column;
    column.column = place.at("column").text();
    column.factor = unitOf(place) * place.numberOr("factor", 1.0);
    column.offset = place.numberOr("offset", 0.0);
    if (place.has("valid"))
    {
        const auto ends = place.at("valid").list();
        if (ends.size() != 2 || ends[0].number() >= ends[1].number())
        {
            place.at("valid").fail("must be [lowest, highest], in SI units");
        }
        column.lowest = ends[0].number();
        column.highest = ends[1].number();
    }
    return column;
}

MeasuredNumber readNumber(const YamlPlace& place, const Study& study)
{
    place.allow({"feature", "values", "unit", "relativeError", "standardError"});
    std::vector<std::string> names;
    for (const auto& feature : study.features)
    {
        names.push_back(feature.name);
    }
    const std::string name = place.at("feature").oneOf(names);
    MeasuredNumber number;
    number.feature = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    const bool isLog = study.features[number.feature].kind->isLog();
    for (const auto& value : place.at("values").oneOrMore())
    {
        number.values.push_back(isLog ? std::log(value.positive() * unitOf(place)) : value.number() * unitOf(place));
    }
    number.standardError = isLog ? place.numberOr("relativeError", 0.0) : place.numberOr("standardError", 0.0);
    if (place.has(isLog ? "standardError" : "relativeError"))
    {
        place.fail(isLog ? "the feature is a logarithm: state a relativeError" : "state a standardError");
    }
    return number;
}

Measurement readMeasurement(const YamlPlace& place, const Study& study, const YamlPlace& root)
{
    place.allow({"files", "time", "value", "numbers"});
    Measurement measured;
    if (place.has("files"))
    {
        for (const auto& file : place.at("files").oneOrMore())
        {
            measured.files.push_back(file.path());
            if (!std::filesystem::is_regular_file(measured.files.back()))
            {
                file.fail("no such file: " + measured.files.back().string());
            }
        }
        const auto column = [&](const std::string& key) {
            if (!place.has(key) && root.has("measured") && root.at("measured").has(key))
            {
                return readColumn(root.at("measured").at(key));
            }
            return readColumn(place.at(key));
        };
        measured.time = column("time");
        measured.value = column("value");
    }
    if (place.has("numbers"))
    {
        for (const auto& number : place.at("numbers").list())
        {
            measured.numbers.push_back(readNumber(number, study));
        }
    }
    if (measured.empty())
    {
        place.fail("needs 'files' or 'numbers'");
    }
    return measured;
}

Role roleOf(const YamlPlace& place)
{
    const std::string word = place.oneOf({"training", "heldOut", "candidate"});
    return word == "training" ? Role::training : word == "heldOut" ? Role::heldOut : Role::candidate;
}

Condition readCondition(const YamlPlace& place, const Study& study, const std::string& file, const YamlPlace& root)
{
    place.allow({"name", "role", "set", "tags", "coordinates", "command", "file", "measured", "cost"});
    Condition condition;
    condition.name = place.at("name").text();
    condition.role = roleOf(place.at("role"));
    condition.command = place.textOr("command", "");
    condition.file = place.textOr("file", file);
    condition.cost = place.has("cost") ? place.at("cost").positive() : 1.0;
    if (place.has("set"))
    {
        condition.entries = readValues(place.at("set"));
    }
    if (place.has("tags"))
    {
        condition.tags = readWords(place.at("tags"));
    }
    if (place.has("coordinates"))
    {
        for (const auto& [name, value] : place.at("coordinates").map())
        {
            condition.coordinates[name] = value.number();
        }
    }
    if (place.has("measured"))
    {
        if (condition.role == Role::candidate)
        {
            place.at("measured")
                .fail("nobody reads it: a candidate is not measured yet; with role: training or heldOut "
                      "it would be read");
        }
        condition.measured = readMeasurement(place.at("measured"), study, root);
    }
    return condition;
}

void readConditions(const YamlPlace& root, Study& study, const std::string& file)
{
    if (root.has("measured"))
    {
        root.at("measured").allow({"time", "value"});
    }
    for (const auto& place : root.at("conditions").list())
    {
        study.conditions.push_back(readCondition(place, study, file, root));
        const auto& name = study.conditions.back().name;
        if (std::count_if(study.conditions.begin(), study.conditions.end(),
                [&](const auto& condition) { return condition.name == name; })
            > 1)
        {
            place.at("name").fail("there are two conditions named '" + name + "'");
        }
    }
    if (study.conditionsOf(Role::training).empty())
    {
        root.at("conditions").fail("at least one condition needs 'role: training'");
    }
}

Parameter readParameter(const YamlPlace& place)
{
    place.allow({"name", "set", "prior", "range"});
    Parameter parameter;
    parameter.name = place.at("name").text();
    for (const auto& [entry, value] : place.at("set").map())
    {
        try
        {
            parameter.entries.emplace(entry, Expression(value.text()));
        }
        catch (const std::invalid_argument& error)
        {
            value.fail(error.what());
        }
    }
    place.at("prior").allow({"mean", "sd"});
    parameter.mean = place.at("prior").at("mean").number();
    parameter.sd = place.at("prior").at("sd").positive();
    const auto range = place.at("range").list();
    if (range.size() != 2 || range[0].number() >= range[1].number())
    {
        place.at("range").fail("must be [lowest, highest]");
    }
    parameter.lower = range[0].number();
    parameter.upper = range[1].number();
    if (parameter.mean <= parameter.lower || parameter.mean >= parameter.upper)
    {
        place.at("prior").at("mean").fail("must lie within the range");
    }
    return parameter;
}

/// Entries that an effect needs and the case does not have.
std::vector<std::string> missingEntries(const Effect& effect, const Entries& known)
{
    std::vector<std::string> missing;
    for (const auto& [entry, value] : effect.entries)
    {
        if (known.count(entry) == 0)
        {
            missing.push_back(entry);
        }
    }
    for (const auto& [entry, value] : effect.words)
    {
        if (known.count(entry) == 0)
        {
            missing.push_back(entry);
        }
    }
    return missing;
}

/// A library is for many cases: what this one cannot switch on is left out, and said.
std::vector<Effect> possible(const std::vector<Effect>& library, Study& study)
{
    const Entries known = readEntries(study.rig.caseFolder / study.rig.entriesFile);
    std::vector<Effect> kept;
    for (const auto& effect : library)
    {
        const auto missing = missingEntries(effect, known);
        if (missing.empty())
        {
            kept.push_back(effect);
        }
        else
        {
            study.leftOut.push_back(effect.name + " (the case has no entry " + listed(missing) + ")");
        }
    }
    return kept;
}

/// The study's own effects come last and replace those of a library that have the same name.
void readAllEffects(const YamlPlace& root, Study& study)
{
    std::vector<Effect> all;
    const auto add = [&](const std::vector<Effect>& more) {
        for (const auto& effect : more)
        {
            const auto same =
                std::find_if(all.begin(), all.end(), [&](const Effect& e) { return e.name == effect.name; });
            if (same == all.end())
            {
                all.push_back(effect);
            }
            else
            {
                *same = effect;
            }
        }
    };
    if (root.has("effectsFrom"))
    {
        for (const auto& file : root.at("effectsFrom").oneOrMore())
        {
            const auto library = YamlPlace::fileAt(file.path());
            library.allow({"about", "effects"});
            add(possible(readEffects(library.at("effects")), study));
        }
    }
    if (root.has("effects"))
    {
        add(readEffects(root.at("effects")));
    }
    const auto chosen = [&](const std::string& key, bool keepListed) {
        if (!root.has(key))
        {
            return;
        }
        std::vector<std::string> known(all.size());
        std::transform(all.begin(), all.end(), known.begin(), [](const Effect& effect) { return effect.name; });
        std::vector<std::string> names;
        for (const auto& name : root.at(key).oneOrMore())
        {
            names.push_back(name.oneOf(known));
        }
        all.erase(std::remove_if(all.begin(), all.end(),
                      [&](const Effect& effect) {
                          return (std::find(names.begin(), names.end(), effect.name) != names.end()) != keepListed;
                      }),
            all.end());
    };
    chosen("onlyEffects", true);
    chosen("withoutEffects", false);
    study.effects = std::move(all);
}

void readSettings(const YamlPlace& root, Settings& settings)
{
    if (root.has("budget"))
    {
        root.at("budget").allow({"runs"});
        settings.budget = root.at("budget").countOr("runs", settings.budget, 1);
    }
    settings.seed = static_cast<unsigned>(root.countOr("seed", static_cast<int>(settings.seed), 0));
    if (root.has("repeats"))
    {
        const auto place = root.at("repeats");
        place.allow({"base", "alone", "deciding", "heldOut"});
        settings.repeatsBase = place.countOr("base", settings.repeatsBase, 2);
        settings.repeatsAlone = place.countOr("alone", settings.repeatsAlone, 1);
        settings.decidingRuns = place.countOr("deciding", settings.decidingRuns, 3);
        settings.repeatsHeldOut = place.countOr("heldOut", settings.repeatsHeldOut, 1);
    }
    if (root.has("failures"))
    {
        const auto place = root.at("failures");
        place.allow({"attempts", "then"});
        settings.attempts = place.countOr("attempts", settings.attempts, 1);
        settings.onFailure = place.has("then") ? place.at("then").oneOf({"exclude", "stop"}) : settings.onFailure;
    }
    if (root.has("inference"))
    {
        const auto place = root.at("inference");
        place.allow({"level", "draws", "coverage", "wrongNames", "otherWeight", "oneMoreParameter"});
        const auto share = [&](const std::string& key, double byDefault, const std::string& example) {
            const double value = place.has(key) ? place.at(key).positive() : byDefault;
            if (value >= 1.0)
            {
                place.at(key).fail("must be below 1, not " + place.at(key).text() + ": " + example);
            }
            return value;
        };
        settings.level = share("level", settings.level, ".05 for 5 %");
        settings.coverage = share("coverage", settings.coverage, ".9 for 90 %");
        settings.wrongNames = share("wrongNames", settings.wrongNames, ".05 for 5 %");
        settings.draws = place.countOr("draws", settings.draws, 100);
        settings.otherWeight = place.has("otherWeight") ? place.at("otherWeight").positive() : settings.otherWeight;
        if (place.has("oneMoreParameter"))
        {
            std::vector<std::string> known;
            for (const auto& [name, operation] : chainOperations())
            {
                known.push_back(name);
            }
            settings.oneMoreParameter = place.at("oneMoreParameter").oneOf(known);
        }
    }
}

ExecutorSpecification readExecutor(const YamlPlace& place)
{
    place.allow({"kind", "processes", "options"});
    ExecutorSpecification executor;
    executor.kind = place.has("kind") ? place.at("kind").oneOf({"pool", "slurm"}) : executor.kind;
    executor.processes = place.countOr("processes", 0, 1);
    if (place.has("options"))
    {
        for (const auto& word : place.at("options").oneOrMore())
        {
            executor.options.push_back(word.text());
            if (executor.options.back().find_first_of(" \t\n") != std::string::npos)
            {
                word.fail("holds blanks; allowed: a list of words, each given to sbatch as it is: "
                          "[--partition=short, --mem=4G]");
            }
        }
    }
    return executor;
}

/// Entries that the case does not have would be found only when the first run starts.
void checkEntries(const YamlPlace& root, const Study& study)
{
    const auto file = study.rig.caseFolder / study.rig.entriesFile;
    const Entries known = readEntries(file);
    const auto check = [&](const std::string& entry, const std::string& where) {
        if (known.count(entry) == 0)
        {
            std::vector<std::string> names(known.size());
            std::transform(known.begin(), known.end(), names.begin(), [](const auto& each) { return each.first; });
            root.fail(where + " sets '" + entry + "', but " + file.string() + " has no such entry"
                      + didYouMean(entry, names));
        }
    };
    for (const auto& [entry, value] : study.rig.entries)
    {
        check(entry, "rig");
    }
    if (!study.rig.seedEntry.empty())
    {
        check(study.rig.seedEntry, "rig.seed");
    }
    for (const auto& condition : study.conditions)
    {
        for (const auto& [entry, value] : condition.entries)
        {
            check(entry, "condition '" + condition.name + "'");
        }
    }
    for (const auto& parameter : study.parameters)
    {
        for (const auto& [entry, value] : parameter.entries)
        {
            check(entry, "parameter '" + parameter.name + "'");
        }
    }
    for (const auto& effect : study.effects)
    {
        for (const auto& entry : missingEntries(effect, known))
        {
            check(entry, "effect '" + effect.name + "'");
        }
    }
}

/// An effect that asks for a tag acts nowhere where the tag is misspelt, and nobody would be told.
void checkTags(const YamlPlace& root, const Study& study)
{
    std::map<std::string, std::set<std::string>> asked;
    for (const auto& effect : study.effects)
    {
        for (const auto& [tag, values] : effect.actsIn)
        {
            asked[tag].insert(values.begin(), values.end());
        }
    }
    const std::string file = study.file.string();
    for (const auto& [tag, values] : asked)
    {
        std::vector<std::string> without;
        std::vector<std::string> known;
        for (const auto& condition : study.conditions)
        {
            if (condition.tags.count(tag) == 0)
            {
                without.push_back(condition.name);
            }
            for (const auto& [name, value] : condition.tags)
            {
                known.push_back(name);
            }
        }
        if (!without.empty() && without.size() < study.conditions.size())
        {
            root.at("conditions")
                .fail("effects act by the tag '" + tag + "', which some conditions have, but not " + listed(without));
        }
        if (!without.empty())
        {
            const std::string near = didYouMean(tag, known);
            if (!near.empty())
            {
                root.at("conditions").fail("effects act by the tag '" + tag + "', which no condition has" + near);
            }
        }
    }
    for (const auto& condition : study.conditions)
    {
        for (const auto& [tag, value] : condition.tags)
        {
            const auto values = asked.find(tag);
            if (values != asked.end() && values->second.count(value) == 0)
            {
                const std::string near = didYouMean(value, {values->second.begin(), values->second.end()});
                if (!near.empty())
                {
                    root.at("conditions")
                        .fail("condition '" + condition.name + "': no effect acts where the tag '" + tag + "' is '"
                              + value + "'" + near);
                }
            }
        }
    }
}

/// Names in formulas that are no entries would be found only when the first run starts.
void checkFormulas(const YamlPlace& root, const Study& study)
{
    Entries all = study.rig.entries;
    const Entries known = readEntries(study.rig.caseFolder / study.rig.entriesFile);
    all.insert(known.begin(), known.end());
    for (const auto& condition : study.conditions)
    {
        all.insert(condition.entries.begin(), condition.entries.end());
    }
    const auto check = [&](const std::string& where, const std::map<std::string, Expression>& formulas,
                           const std::string& variable, double value) {
        auto variables = numbersOf(all);
        variables[variable] = value;
        for (const auto& [entry, formula] : formulas)
        {
            try
            {
                formula(variables);
            }
            catch (const std::invalid_argument& error)
            {
                root.fail(where + ", entry '" + entry + "': " + error.what());
            }
        }
    };
    for (const auto& parameter : study.parameters)
    {
        check("parameter '" + parameter.name + "'", parameter.entries, parameter.name, parameter.mean);
    }
    for (const auto& effect : study.effects)
    {
        check("effect '" + effect.name + "'", effect.entries, "a", effect.bounds.upper);
        if (effect.chainSize)
        {
            check(
                "effect '" + effect.name + "'", {{effect.chainOperation, *effect.chainSize}}, "a", effect.bounds.upper);
        }
    }
}

} // namespace

Study readStudy(const std::filesystem::path& file)
{
    const YamlPlace root = YamlPlace::fileAt(file);
    root.allow({"study", "about", "rig", "observable", "measured", "conditions", "parameters", "effectsFrom", "effects",
        "onlyEffects", "withoutEffects", "budget", "seed", "repeats", "failures", "inference", "executor",
        "work", "assumptions", "magnitudeLimit"});
    Study study;
    study.file = file;
    study.name = root.at("study").text();
    study.rig = readRig(root.at("rig"));
    std::string observableFile;
    readObservable(root.at("observable"), study, observableFile);
    readConditions(root, study, observableFile);
    if (root.has("parameters"))
    {
        for (const auto& place : root.at("parameters").list())
        {
            study.parameters.push_back(readParameter(place));
            const auto& name = study.parameters.back().name;
            if (std::count_if(study.parameters.begin(), study.parameters.end(),
                    [&](const Parameter& parameter) { return parameter.name == name; })
                > 1)
            {
                place.at("name").fail("there are two parameters named '" + name + "'");
            }
        }
    }
    readAllEffects(root, study);
    readSettings(root, study.settings);
    if (root.has("executor"))
    {
        study.executor = readExecutor(root.at("executor"));
    }
    study.work = root.has("work") ? root.at("work").path()
                                  : std::filesystem::absolute(file).parent_path() / (study.name + ".work");
    if (root.has("assumptions"))
    {
        for (const auto& place : root.at("assumptions").list())
        {
            study.assumptions.push_back(place.text());
        }
    }
    study.magnitudeLimit = root.numberOr("magnitudeLimit", study.magnitudeLimit);
    if (study.magnitudeLimit <= 1.0)
    {
        root.at("magnitudeLimit").fail("must be above 1");
    }
    checkEntries(root, study);
    checkFormulas(root, study);
    checkTags(root, study);
    return study;
}

} // namespace clepsydra::identification
