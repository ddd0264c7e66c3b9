#include "study/readStudy.h"

#include "study/readValues.h"
#include "tokens/didYouMean.h"

#include <algorithm>
#include <functional>
#include <tuple>

namespace clepsydra::identification
{

namespace
{

SimulatorSpecification readSimulator(const YamlPlace& place)
{
    place.allow({"case", "command", "set", "seed", "dependsOn", "costPerRun", "timeLimit"});
    SimulatorSpecification simulator;
    simulator.caseFolder = place.at("case").path();
    simulator.command = place.textOr("command", simulator.command);
    simulator.seedEntry = place.at("seed").text() == "none" ? "" : place.at("seed").text();
    simulator.costPerRun = place.positiveOr("costPerRun", simulator.costPerRun);
    simulator.timeLimit = place.positiveOr("timeLimit", 0.0);
    for (const auto& file : place.optional("dependsOn").oneOrMore())
    {
        simulator.dependsOn.push_back(file.path());
        file.failIf(!std::filesystem::exists(file.path()), "no such file: " + file.path().string());
    }
    const auto entries = simulator.caseFolder / entriesFile;
    place.at("case").failIf(!std::filesystem::is_regular_file(entries), "there is no file " + entries.string());
    if (simulator.scatters())
    {
        requireEntry(place.at("seed"), simulator.seedEntry, simulator);
    }
    simulator.entries = readValues(place.optional("set"), simulator);
    return simulator;
}

Parameter readParameter(const YamlPlace& place, const SimulatorSpecification& simulator)
{
    place.allow({"name", "unit", "set", "prior", "range", "of"});
    Parameter parameter;
    parameter.name = place.at("name").text();
    parameter.unit = place.textOr("unit", "");
    const YamlPlace prior = place.at("prior");
    prior.allow({"mean", "sd", "from"});
    parameter.mean = prior.at("mean").number();
    parameter.sd = prior.at("sd").positive();
    prior.failIf(!prior.has("from"),
        "parameter '" + parameter.name
            + "' does not say where its prior comes from; allowed are 'from: measured' (an independent measurement of "
              "these particles or this fluid), 'from: handbook' (a published value) and 'from: guess' (also a value "
              "that was chosen after a look at the data)");
    parameter.from = static_cast<Origin>(prior.at("from").indexIn(namesOfOrigins()));
    std::tie(parameter.lower, parameter.upper) = place.at("range").range("[lowest, highest]");
    prior.at("mean").failIf(
        parameter.mean <= parameter.lower || parameter.mean >= parameter.upper, "must lie within the range");
    auto variables = numbersOf(plainEntries(simulator, {}));
    variables[parameter.name] = parameter.mean;
    for (const auto& [entry, value] : place.at("set").map())
    {
        requireEntry(value, entry, simulator);
        const Expression& formula = parameter.entries.emplace(entry, readFormula(value)).first->second;
        // Only its names are checked: the value may be finite with the entries of the conditions alone.
        checkedAt(value, [&] { return formula(variables); });
    }
    place.at("set").failIf(std::none_of(parameter.entries.begin(), parameter.entries.end(),
                               [&](const auto& entry) { return entry.second.holds(parameter.name); }),
        "no formula of parameter '" + parameter.name + "' contains it; allowed is \"entry: " + parameter.name
            + "\" or a formula with " + parameter.name);
    return parameter;
}

/// Why an effect is not absent at amplitude 0, or never present; empty if it is as it must be.
/// \param entries  of the case, by condition
/// \param atZero  the entries that are numbers, and a = 0
std::string objectionTo(const YamlPlace& place, const Effect& effect, const Study& study,
    const std::vector<Entries>& entries, const std::vector<Expression::Variables>& atZero)
{
    if (effect.chainSize)
    {
        const double value = valueOf(place.at("chain"), *effect.chainSize, {{"a", 0.0}});
        return isUnchanged(value, 0.0) ? "" : "the size in 'chain' is " + textOf(value) + " at a = 0, not 0";
    }
    bool changes = !effect.isSwitch;
    bool isIdle = true;
    for (std::size_t c = 0; c < entries.size(); ++c)
    {
        if (!acts(effect, study.conditions[c]))
        {
            continue;
        }
        isIdle = false;
        changes = changes || std::any_of(effect.textEntries.begin(), effect.textEntries.end(), [&](const auto& own) {
            return entries[c].at(own.first) != own.second;
        });
        for (const auto& [entry, formula] : effect.entries)
        {
            const auto own = atZero[c].find(entry);
            if (own == atZero[c].end())
            {
                return entry + " is '" + entries[c].at(entry) + "' in the case, which is no number for a formula";
            }
            const double value = valueOf(place.at("set").at(entry), formula, atZero[c]);
            changes = changes || !isUnchanged(value, own->second);
            // Without `a` it is a setting that the effect needs, as a shorter step.
            if (formula.holds("a") && !isUnchanged(value, own->second))
            {
                return entry + " is " + textOf(own->second) + " in the case, but " + textOf(value) + " at a = 0";
            }
        }
    }
    return changes || isIdle ? "" : "the case has these values already";
}

/// Reads the effects of the libraries and of the study. The study's own effects replace those of the same name. A
/// library serves many cases: effects that this case has no entries for, whose formulas start from other values than
/// the case's, or that the case has already, are left out, and the report lists them.
void readAllEffects(const YamlPlace& root, Study& study)
{
    std::vector<Effect>& all = study.effects;
    const auto add = [&](const Effect& effect) {
        const auto names = namesOfItems(all);
        const std::size_t same = std::find(names.begin(), names.end(), effect.name) - names.begin();
        all.resize(std::max(all.size(), same + 1));
        all[same] = effect;
        eraseIf(study.leftOut, [&](const LeftOut& one) { return one.name == effect.name; });
    };
    const Entries known = ownEntries(study.simulator);
    const auto entries =
        mapped(study.conditions, [&](const Condition& condition) { return plainEntries(study.simulator, condition); });
    const auto atZero = mapped(entries, [](const Entries& ofOne) {
        auto numbers = numbersOf(ofOne);
        numbers["a"] = 0.0;
        return numbers;
    });
    for (const auto& file : root.optional("effectsFrom").oneOrMore())
    {
        const auto library = YamlPlace::fileAt(file.path());
        library.allow({"about", "effects"});
        const auto offered = readEffects(library.at("effects"));
        for (std::size_t i = 0; i < offered.size(); ++i)
        {
            const auto missing = missingEntries(offered[i], known);
            const std::string reason =
                missing.empty() ? objectionTo(library.at("effects").list()[i], offered[i], study, entries, atZero)
                                : "the case has no entry " + listed(missing);
            if (reason.empty())
            {
                add(offered[i]);
            }
            else
            {
                study.leftOut.push_back({offered[i].name, reason});
            }
        }
    }
    const auto own = readEffects(root.optional("effects"));
    for (std::size_t i = 0; i < own.size(); ++i)
    {
        const YamlPlace place = root.at("effects").list()[i];
        for (const auto& entry : missingEntries(own[i], known))
        {
            requireEntry(place.at("set").at(entry), entry, study.simulator);
        }
        const std::string objection = objectionTo(place, own[i], study, entries, atZero);
        place.failIf(
            !objection.empty(), "effect '" + own[i].name + "': " + objection
                                    + "; allowed is an effect that is absent at amplitude 0, with a formula such "
                                      "as \"entry*(1 + 0.1*a)\", \"entry + 0.1*a\" or, in 'chain', \"0.1*a\", "
                                      "or a switch to another value than the case's");
    }
    std::for_each(own.begin(), own.end(), add);
    for (const std::string key : {"onlyEffects", "withoutEffects"})
    {
        auto mayBeNamed = namesOfItems(all);
        if (key == "withoutEffects")
        {
            // Those that this case has already may be named as well.
            append(mayBeNamed, namesOfItems(study.leftOut));
        }
        const auto names =
            mapped(root.optional(key).oneOrMore(), [&](const YamlPlace& name) { return name.oneOf(mayBeNamed); });
        eraseIf(all, [&](const Effect& effect) {
            return root.has(key) && contains(names, effect.name) == (key == "withoutEffects");
        });
    }
}

/// Leaves out effects that act in no training condition, together with their parameters. The data contain no
/// information on them, and they would keep their prior probability and enter the set.
void leaveOutIdle(Study& study)
{
    const auto trained = study.conditionsOf(Role::training);
    for (std::size_t e = study.effects.size(); e-- > 0;)
    {
        const Effect& effect = study.effects[e];
        if (std::any_of(
                trained.begin(), trained.end(), [&](std::size_t c) { return acts(effect, study.conditions[c]); }))
        {
            continue;
        }
        study.leftOut.push_back({effect.name, "it acts in no training condition"});
        study.effects.erase(study.effects.begin() + static_cast<std::ptrdiff_t>(e));
        eraseIf(study.parameters, [&](const Parameter& parameter) { return parameter.effect == e; });
        for (auto& parameter : study.parameters)
        {
            if (parameter.effect > e)
            {
                --*parameter.effect;
            }
        }
    }
}

void readSettings(const YamlPlace& root, Study& study)
{
    Settings& settings = study.settings;
    const auto budget = root.optional("budget");
    budget.allow({"runs"});
    settings.budget = budget.countOr("runs", settings.budget, 1);
    settings.seed = static_cast<unsigned>(root.countOr("seed", static_cast<int>(settings.seed), 0));
    const auto repeats = root.optional("repeats");
    repeats.allow({"base", "alone", "deciding", "heldOut"});
    settings.repeatsBase = repeats.countOr("base", settings.repeatsBase, 2);
    settings.repeatsAlone = repeats.countOr("alone", settings.repeatsAlone, 1);
    settings.decidingRuns = repeats.countOr("deciding", settings.decidingRuns, 0);
    settings.repeatsHeldOut = repeats.countOr("heldOut", settings.repeatsHeldOut, 1);
    const auto failures = root.optional("failures");
    failures.allow({"attempts", "then"});
    settings.attempts = failures.countOr("attempts", settings.attempts, 1);
    settings.onFailure = failures.wordOr("then", settings.onFailure, {"exclude", "stop"});
    const auto inference = root.optional("inference");
    inference.allow({"level", "draws", "coverage", "wrongNames", "oneMoreParameter"});
    const auto share = [&](const std::string& key, double byDefault, const std::string& example) {
        const double value = inference.positiveOr(key, byDefault);
        inference.optional(key).failIf(
            value >= 1.0, "must be below 1, not " + inference.textOr(key, "") + "; for example " + example);
        return value;
    };
    settings.level = share("level", settings.level, "0.05 for 5 %");
    settings.coverage = share("coverage", settings.coverage, "0.9 for 90 %");
    settings.wrongNames = share("wrongNames", settings.wrongNames, "0.05 for 5 %");
    settings.draws = inference.countOr("draws", settings.draws, 100);
    if (study.simulator.scatters() && settings.level * (settings.draws + 1) <= 1.0)
    {
        inference.at("level").fail(
            std::to_string(settings.draws) + " draws cannot resolve so small a level; raise 'level' or 'draws'");
    }
    settings.oneMoreParameter = inference.wordOr("oneMoreParameter", settings.oneMoreParameter, {"gain", "timeFactor"});
}

ExecutorSpecification readExecutor(const YamlPlace& place)
{
    place.allow({"kind", "processes", "options"});
    ExecutorSpecification executor;
    executor.kind = place.wordOr("kind", executor.kind, {"pool", "slurm"});
    executor.processes = place.countOr("processes", 0, 1);
    for (const auto& option : place.optional("options").oneOrMore())
    {
        executor.options.push_back(option.text());
        option.failIf(option.text().find_first_of(" \t\n") != std::string::npos,
            "contains blanks; allowed is a list of options without blanks, which are passed to sbatch: "
            "[--partition=short, --mem=4G]");
    }
    return executor;
}

} // namespace

Study readStudy(const std::filesystem::path& file)
{
    const YamlPlace root = YamlPlace::fileAt(file);
    root.allow({"study", "about", "simulator", "observable", "measured", "conditions", "parameters", "effectsFrom",
        "effects", "onlyEffects", "withoutEffects", "commonErrors", "budget", "seed", "repeats", "failures",
        "inference", "executor", "work", "assumptions", "magnitudeLimit"});
    Study study;
    study.file = file;
    study.name = root.at("study").text();
    study.simulator = readSimulator(root.at("simulator"));
    readObservable(root.at("observable"), study);
    readConditions(root, study);
    study.parameters = readNamed(root.optional("parameters"), "parameters",
        [&](const YamlPlace& place) { return readParameter(place, study.simulator); });
    root.optional("parameters")
        .failIf(study.parameters.size() > mostParameters, "there are " + std::to_string(study.parameters.size())
                                                              + " parameters; allowed are up to "
                                                              + std::to_string(mostParameters));
    readAllEffects(root, study);
    readCommonErrors(root.optional("commonErrors"), study);
    for (std::size_t p = 0; p < study.parameters.size(); ++p)
    {
        const auto place = root.at("parameters").list()[p];
        if (place.has("of"))
        {
            study.parameters[p].effect = indexOf(place.at("of"), study.effects);
        }
    }
    readSettings(root, study);
    study.executor = readExecutor(root.optional("executor"));
    study.work = root.has("work") ? root.at("work").path()
                                  : std::filesystem::absolute(file).parent_path() / (study.name + ".work");
    study.assumptions = mapped(root.optional("assumptions").list(), std::mem_fn(&YamlPlace::text));
    study.magnitudeLimit = root.numberOr("magnitudeLimit", study.magnitudeLimit);
    root.optional("magnitudeLimit").failIf(study.magnitudeLimit <= 1.0, "must be above 1");
    checkEffects(root, study);
    leaveOutIdle(study);
    return study;
}

} // namespace clepsydra::identification
