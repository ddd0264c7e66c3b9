#include "study/readStudy.h"

#include "effects/measuringChain.h"
#include "study/readParts.h"
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
    place.allow({"case", "command", "entriesFile", "set", "seed", "dependsOn", "version", "costPerRun", "timeLimit"});
    SimulatorSpecification simulator;
    simulator.caseFolder = place.at("case").path();
    simulator.command = place.textOr("command", simulator.command);
    simulator.entriesFile = place.textOr("entriesFile", simulator.entriesFile);
    simulator.seedEntry = place.at("seed").text() == "none" ? "" : place.at("seed").text();
    simulator.version = place.textOr("version", "");
    simulator.costPerRun = place.positiveOr("costPerRun", simulator.costPerRun);
    simulator.timeLimit = place.positiveOr("timeLimit", 0.0);
    for (const auto& file : place.optional("dependsOn").oneOrMore())
    {
        simulator.dependsOn.push_back(file.path());
        if (!std::filesystem::exists(simulator.dependsOn.back()))
        {
            file.fail("no such file: " + simulator.dependsOn.back().string());
        }
    }
    if (!std::filesystem::is_regular_file(simulator.caseFolder / simulator.entriesFile))
    {
        place.at("case").fail("there is no file " + (simulator.caseFolder / simulator.entriesFile).string());
    }
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
    for (const auto& [entry, value] : place.at("set").map())
    {
        requireEntry(value, entry, simulator);
        parameter.entries.emplace(entry, readFormula(value));
    }
    const YamlPlace prior = place.at("prior");
    prior.allow({"mean", "sd", "from"});
    parameter.mean = prior.at("mean").number();
    parameter.sd = prior.at("sd").positive();
    if (!prior.has("from"))
    {
        prior.fail("parameter '" + parameter.name
                   + "' does not say where its prior comes from; allowed are 'from: measured' (an independent "
                     "measurement of these particles or this fluid), 'from: handbook' (a published value) and 'from: "
                     "guess' (also a value that was chosen after a look at the data)");
    }
    const auto origins = {Origin::measured, Origin::handbook, Origin::guess};
    const std::string from = prior.at("from").oneOf(mapped(origins, [](Origin origin) { return nameOf(origin); }));
    parameter.from =
        *std::find_if(origins.begin(), origins.end(), [&](Origin origin) { return nameOf(origin) == from; });
    std::tie(parameter.lower, parameter.upper) = place.at("range").range("[lowest, highest]");
    if (parameter.mean <= parameter.lower || parameter.mean >= parameter.upper)
    {
        place.at("prior").at("mean").fail("must lie within the range");
    }
    return parameter;
}

/// A library serves many cases. Effects that this case has no entries for are left out, and the report lists them.
std::vector<Effect> possible(const std::vector<Effect>& library, Study& study)
{
    const Entries known = ownEntries(study.simulator);
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

/// Reads the effects of the libraries and of the study. The study's own effects replace those of the same name.
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
    for (const auto& file : root.optional("effectsFrom").oneOrMore())
    {
        const auto library = YamlPlace::fileAt(file.path());
        library.allow({"about", "effects"});
        add(possible(readEffects(library.at("effects")), study));
    }
    const auto own = readEffects(root.optional("effects"));
    for (std::size_t i = 0; i < own.size(); ++i)
    {
        for (const auto& entry : missingEntries(own[i], ownEntries(study.simulator)))
        {
            requireEntry(root.at("effects").list()[i].at("set").at(entry), entry, study.simulator);
        }
    }
    add(own);
    const auto chosen = [&](const std::string& key, bool keepListed) {
        if (!root.has(key))
        {
            return;
        }
        const auto names =
            mapped(root.at(key).oneOrMore(), [&](const YamlPlace& name) { return name.oneOf(namesOfItems(all)); });
        all.erase(std::remove_if(all.begin(), all.end(),
                      [&](const Effect& effect) { return contains(names, effect.name) != keepListed; }),
            all.end());
    };
    chosen("onlyEffects", true);
    chosen("withoutEffects", false);
    study.effects = std::move(all);
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
        study.leftOut.push_back(effect.name + " (it acts in no training condition)");
        study.effects.erase(study.effects.begin() + static_cast<std::ptrdiff_t>(e));
        auto& parameters = study.parameters;
        parameters.erase(std::remove_if(parameters.begin(), parameters.end(),
                             [&](const Parameter& parameter) { return parameter.effect == e; }),
            parameters.end());
        for (auto& parameter : parameters)
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
    settings.onFailure = failures.has("then") ? failures.at("then").oneOf({"exclude", "stop"}) : settings.onFailure;
    const auto inference = root.optional("inference");
    inference.allow({"level", "draws", "coverage", "wrongNames", "oneMoreParameter"});
    const auto share = [&](const std::string& key, double byDefault, const std::string& example) {
        const double value = inference.positiveOr(key, byDefault);
        if (value >= 1.0)
        {
            inference.at(key).fail("must be below 1, not " + inference.at(key).text() + "; for example " + example);
        }
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
    if (inference.has("oneMoreParameter"))
    {
        settings.oneMoreParameter = inference.at("oneMoreParameter").oneOf(namesOf(chainOperations()));
    }
}

ExecutorSpecification readExecutor(const YamlPlace& place)
{
    place.allow({"kind", "processes", "options"});
    ExecutorSpecification executor;
    executor.kind = place.has("kind") ? place.at("kind").oneOf({"pool", "slurm"}) : executor.kind;
    executor.processes = place.countOr("processes", 0, 1);
    for (const auto& option : place.optional("options").oneOrMore())
    {
        executor.options.push_back(option.text());
        if (executor.options.back().find_first_of(" \t\n") != std::string::npos)
        {
            option.fail("contains blanks; allowed is a list of options without blanks, which are passed to sbatch: "
                        "[--partition=short, --mem=4G]");
        }
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
    if (study.parameters.size() > mostParameters)
    {
        root.at("parameters")
            .fail("there are " + std::to_string(study.parameters.size()) + " parameters; allowed are up to "
                  + std::to_string(mostParameters));
    }
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
    if (study.magnitudeLimit <= 1.0)
    {
        root.at("magnitudeLimit").fail("must be above 1");
    }
    checkEffects(root, study);
    leaveOutIdle(study);
    return study;
}

} // namespace clepsydra::identification
