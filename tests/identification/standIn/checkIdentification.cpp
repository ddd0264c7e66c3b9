/// The statistics of the whole procedure, on the stand-in: many studies, each with its own library, its own data and a
/// truth that the procedure does not see. Prints and writes what came out.
#include "standIn/standIn.h"

#include "heldOut/heldOut.h"
#include "procedure/trace.h"
#include "study/readStudy.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <random>

namespace clepsydra::identification::tests
{

namespace
{

using Json = nlohmann::ordered_json;

struct Options
{
    std::string study;
    std::string output;
    int nulls = 300;
    int effects = 300;
    int unknowns = 100;
    int pairs = 0;
    unsigned seed = 1;
    int draws = 1000;
    bool check = false;
};

/// Share with its 95 % Wilson interval.
Json share(double count, double of)
{
    const double z = 1.96;
    if (of == 0.0)
    {
        return {{"of", 0}};
    }
    const double p = count / of;
    const double middle = (p + z * z / (2 * of)) / (1 + z * z / of);
    const double half = z * std::sqrt(p * (1 - p) / of + z * z / (4 * of * of)) / (1 + z * z / of);
    return {{"share", p}, {"wilson95", {middle - half, middle + half}}, {"count", count}, {"of", of}};
}

/// Effects that exist in the world of the stand-in but in no library.
std::vector<Effect> outsideLibrary()
{
    std::vector<Effect> effects;
    for (const auto& [name, formula] :
        std::map<std::string, std::string>{{"pumping", "0.5*a"}, {"heightLaw", "0.25*a"}, {"airDrag", "0.08*a"}})
    {
        Effect effect;
        effect.name = name;
        effect.entries.emplace(name, Expression(formula));
        effects.push_back(effect);
    }
    return effects;
}

struct Truth
{
    std::vector<std::size_t> effects; // of the world
    std::vector<double> amplitudes;
};

struct Outcome
{
    Decision decision;
    double pValue;
    bool topOne;
    bool inSet;
    std::size_t setSize;
    double error; // of the true effect's amplitude, in standard errors that the interval reaches
    bool covered;
    double before;
    double after;
    double oneMore;
    double gaussian;
    bool accepted;
};

/// One study from beginning to end.
class Trial
{
public:
    Trial(Study study, const Study& world, const Entries& defaults, unsigned seed)
        : study_(std::move(study)),
          world_(world),
          rig_(defaults),
          random_(seed)
    {
        study_.settings.seed = 2 * seed;
        world_.settings.seed = 2 * seed + 1;
    }

    Outcome run(const Truth& truth)
    {
        Simulator simulator(study_, rig_);
        const EffectLibrary library = makeLibrary(simulator);
        const auto measured = measure(truth);
        const Answer answer = trace(simulator, library, measured, random_);
        const HeldOutResult heldOut = evaluateHeldOut(simulator, library, answer, measured, measured, random_);

        Outcome outcome{answer.decision, answer.significance.pValue, false, false,
            answer.set.size() + answer.pairsAlike.size(), 0.0, false, heldOut.before.rmsLogError.value,
            heldOut.after ? heldOut.after->rmsLogError.value : heldOut.before.rmsLogError.value,
            heldOut.oneMoreParameter.rmsLogError.value, heldOut.gaussianProcess.rmsLogError.value, heldOut.accepted()};
        const bool inLibrary = !truth.effects.empty() && truth.effects.front() < study_.effects.size();
        if (inLibrary)
        {
            for (std::size_t member = 0; member < answer.set.size(); ++member)
            {
                if (answer.set[member].effects == truth.effects)
                {
                    outcome.inSet = true;
                    outcome.topOne = member == 0;
                }
            }
            outcome.inSet = outcome.inSet
                            || std::any_of(answer.pairsAlike.begin(), answer.pairsAlike.end(),
                                [&](const Explanation& pair) { return pair.effects == truth.effects; });
            const Score& score = answer.effects[truth.effects.front()].score();
            const double reach = intervalSds(answer.noise) * score.sd;
            outcome.covered = std::abs(score.amplitude - truth.amplitudes.front()) <= reach;
            outcome.error = (score.amplitude - truth.amplitudes.front()) / score.sd;
        }
        return outcome;
    }

private:
    /// Three repeats of every condition, with the true friction drawn from its prior.
    std::vector<MeasuredCondition> measure(const Truth& truth)
    {
        Simulator world(world_, rig_);
        std::normal_distribution<double> normal;
        Setting setting = world.plainSetting();
        setting.parameters(0) += 0.6 * study_.parameters.front().sd * normal(random_);
        for (std::size_t k = 0; k < truth.effects.size(); ++k)
        {
            setting.amplitudes(static_cast<Eigen::Index>(truth.effects[k])) = truth.amplitudes[k];
        }
        std::vector<MeasuredCondition> all(world_.conditions.size());
        for (std::size_t c = 0; c < all.size(); ++c)
        {
            const auto simulations = world.repeats({c}, setting, "measured", 3);
            all[c].features.resize(3, world_.featureCount());
            for (Eigen::Index row = 0; row < 3; ++row)
            {
                all[c].features.row(row) = simulations[static_cast<std::size_t>(row)].features.transpose();
            }
            all[c].declaredError = Eigen::VectorXd::Zero(world_.featureCount());
        }
        return all;
    }

    Study study_;
    Study world_;
    StandInRig rig_;
    std::mt19937_64 random_;
};

struct Tally
{
    double trials = 0;
    double detected = 0;
    double topOne = 0;
    double inSet = 0;
    double setSize = 0;
    double sets = 0;
    double named = 0;
    double namedWrong = 0;
    double unknown = 0;
    double covered = 0;
    double before = 0;
    double after = 0;
    double oneMore = 0;
    double gaussian = 0;
    double accepted = 0;

    void add(const Outcome& outcome)
    {
        const bool seen = outcome.decision != Decision::noResidual;
        trials += 1;
        detected += seen ? 1 : 0;
        topOne += seen && outcome.topOne ? 1 : 0;
        inSet += seen && outcome.inSet ? 1 : 0;
        unknown += outcome.decision == Decision::unknown ? 1 : 0;
        named += outcome.decision == Decision::named ? 1 : 0;
        namedWrong += outcome.decision == Decision::named && !outcome.inSet ? 1 : 0;
        covered += seen && outcome.covered ? 1 : 0;
        if (outcome.setSize > 0)
        {
            sets += 1;
            setSize += static_cast<double>(outcome.setSize);
        }
        if (seen)
        {
            before += outcome.before;
            after += outcome.after;
            oneMore += outcome.oneMore;
            gaussian += outcome.gaussian;
            accepted += outcome.accepted ? 1 : 0;
        }
    }

    Json json() const
    {
        const auto mean = [](double sum, double of) { return of > 0 ? Json(sum / of) : Json(nullptr); };
        return {{"trials", trials}, {"detected", share(detected, trials)},
            {"topOneWhenDetected", share(topOne, detected)}, {"truthInSetWhenDetected", share(inSet, detected)},
            {"meanSetSize", mean(setSize, sets)}, {"unknownWhenDetected", share(unknown, detected)},
            {"namedWhenDetected", share(named, detected)}, {"wrongNameWhenDetected", share(namedWrong, detected)},
            {"intervalCoversWhenDetected", share(covered, detected)},
            {"heldOutRms",
                {{"before", mean(before, detected)}, {"after", mean(after, detected)},
                    {"oneMoreParameter", mean(oneMore, detected)}, {"gaussianProcess", mean(gaussian, detected)}}},
            {"acceptedWhenDetected", share(accepted, detected)}};
    }
};

Json check(const Options& options)
{
    Study study = readStudy(options.study);
    study.settings.draws = options.draws;
    Study world = study;
    for (const auto& effect : outsideLibrary())
    {
        world.effects.push_back(effect);
    }
    const Entries defaults = readEntries(study.rig.caseFolder / study.rig.entriesFile);
    std::mt19937_64 random(options.seed);
    unsigned next = options.seed * 100000;
    const auto trial = [&](const Truth& truth) { return Trial(study, world, defaults, next++).run(truth); };
    const auto anyOf = [&](std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
    };
    const auto signedAmplitude = [&](std::size_t e, double size) {
        return world.effects[e].bounds.lower < 0.0 && anyOf(2) == 0 ? -size : size;
    };

    Tally nulls;
    std::vector<double> pValues;
    for (int i = 0; i < options.nulls; ++i)
    {
        const Outcome outcome = trial({});
        nulls.add(outcome);
        pValues.push_back(outcome.pValue);
    }
    std::cerr << "nulls done" << std::endl;

    Tally effects;
    std::map<std::string, Tally> byEffect;
    std::map<std::string, Tally> bySize;
    for (int i = 0; i < options.effects; ++i)
    {
        const auto e = static_cast<std::size_t>(i) % study.effects.size();
        const double size = std::uniform_real_distribution<double>(0.25, 1.0)(random);
        const Outcome outcome = trial({{e}, {signedAmplitude(e, size)}});
        effects.add(outcome);
        byEffect[study.effects[e].name].add(outcome);
        bySize[size < 0.5 ? "0.25-0.5" : size < 0.75 ? "0.5-0.75" : "0.75-1"].add(outcome);
    }
    std::cerr << "effects done" << std::endl;

    Json outside = Json::object();
    for (const double size : {0.25, 0.5, 1.0})
    {
        Tally tally;
        for (int i = 0; i < options.unknowns; ++i)
        {
            const std::size_t e =
                study.effects.size() + static_cast<std::size_t>(i) % (world.effects.size() - study.effects.size());
            tally.add(trial({{e}, {size}}));
        }
        outside[std::to_string(size).substr(0, 4)] = tally.json();
    }
    Tally pairs;
    for (int i = 0; i < options.pairs; ++i)
    {
        const auto a = anyOf(study.effects.size() - 1);
        const auto b = a + 1 + anyOf(study.effects.size() - a - 1);
        pairs.add(trial({{a, b}, {signedAmplitude(a, 0.8), signedAmplitude(b, 0.8)}}));
    }

    Json perEffect = Json::object();
    for (const auto& [name, tally] : byEffect)
    {
        perEffect[name] = tally.json();
    }
    Json perSize = Json::object();
    for (const auto& [name, tally] : bySize)
    {
        perSize[name] = tally.json();
    }
    double below = 0;
    for (const double p : pValues)
    {
        below += p < 0.5 ? 1 : 0;
    }
    return {{"study", study.name}, {"seed", options.seed}, {"draws", options.draws},
        {"falseAlarms", share(nulls.detected, nulls.trials)}, {"pValueBelowHalf", share(below, nulls.trials)},
        {"nulls", nulls.json()}, {"effects", effects.json()}, {"bySize", perSize}, {"byEffect", perEffect},
        {"outsideLibrary", outside}, {"pairs", pairs.json()}};
}

/// The 95 % Wilson interval of the false alarms must hold the nominal level; the other limits lie far below what the
/// full study measured (identification/results), and far above what an answer drawn by chance would give.
bool asPromised(const Json& result, double level)
{
    bool good = true;
    const auto require = [&](bool held, const std::string& what) {
        if (!held)
        {
            std::cerr << "not as promised: " << what << '\n';
            good = false;
        }
    };
    const Json& alarms = result["falseAlarms"]["wilson95"];
    require(alarms[0].get<double>() <= level && level <= alarms[1].get<double>(), "false alarms at the nominal level");
    const Json& effects = result["effects"];
    require(effects["detected"]["share"].get<double>() > 0.5, "more than half of the effects are detected");
    require(effects["truthInSetWhenDetected"]["share"].get<double>() > 0.7, "the truth is in the set in 70 %");
    require(effects["meanSetSize"].get<double>() < 4.0, "sets have fewer than 4 members");
    require(effects["heldOutRms"]["after"].get<double>() < effects["heldOutRms"]["before"].get<double>(),
        "the held-out error falls");
    return good;
}

} // namespace

} // namespace clepsydra::identification::tests

int main(int argc, char** argv)
{
    clepsydra::identification::tests::Options options;
    CLI::App app("Checks the statistics of traceResidual from end to end on a stand-in for the solver");
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.add_option("study", options.study, "study file of the stand-in")->required();
    app.add_option("--nulls", options.nulls, "studies without any effect");
    app.add_option("--effects", options.effects, "studies with one effect of the library");
    app.add_option("--unknowns", options.unknowns, "studies with an effect outside it, for each of three sizes");
    app.add_option("--pairs", options.pairs, "studies with two effects");
    app.add_option("--seed", options.seed, "of everything");
    app.add_option("--draws", options.draws, "of each Monte Carlo test");
    app.add_option("--output", options.output, "JSON file to write");
    app.add_flag("--check", options.check, "fail where the result is worse than the procedure promises");
    CLI11_PARSE(app, argc, argv);
    try
    {
        const auto result = clepsydra::identification::tests::check(options);
        std::cout << result.dump(1) << '\n';
        if (!options.output.empty())
        {
            std::ofstream(options.output) << result.dump(1) << '\n';
        }
        return !options.check || clepsydra::identification::tests::asPromised(result, 0.05) ? 0 : 1;
    }
    catch (const std::exception& error)
    {
        std::cerr << "checkIdentification: " << error.what() << '\n';
        return 1;
    }
}
