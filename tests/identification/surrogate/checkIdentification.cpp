/// Error rates of the whole procedure with the surrogate: several libraries, and for each of them many synthetic data
/// sets whose truth is hidden from the procedure. Prints the rates and writes them as JSON.
#include "surrogate/surrogate.h"

#include "lists.h"
#include "emulator/settings.h"
#include "heldOut/heldOut.h"
#include "procedure/trace.h"
#include "study/readStudy.h"
#include "study/yaml.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <optional>
#include <random>

namespace clepsydra::identification::tests
{

namespace
{

using Json = nlohmann::ordered_json;

struct Options
{
    std::string study;
    std::string gauged;
    std::string output;
    int libraries = 10;
    // Numbers of data sets for each library:
    int nulls = 20;
    int effects = 14; // with one effect, all effects in turn
    int decoys = 0;   // of these, answered also without that effect in the library
    int unknowns = 0; // with an effect that is not in the library, for each of three sizes
    int pairs = 0;    // with two effects
    int again = 0;    // of those with one effect, answered again with other seeds of the runs
    unsigned seed = 1;
    int draws = 1000;
    bool exact = false; // runs do not scatter, measurements do
    bool check = false;
};

/// A share with its 95 % Wilson interval.
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

/// Effects of the surrogate that are not in the library.
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
    std::vector<std::size_t> effects; // indices in the study with all effects
    std::vector<double> amplitudes;
};

struct Outcome
{
    Decision decision = Decision::noResidual;
    double pValue = 1.0;
    bool topOne = false;
    bool inSet = false;
    std::size_t setSize = 0;
    bool unlistedCause = false;
    bool covered = false;
    std::vector<std::vector<std::size_t>> set;
    bool better = false; // on the held-out conditions
    bool complete = false;
    std::optional<bool> fallCovered; // whether the fall of the held-out error agrees with its expectation

    bool isNamedRightly() const
    {
        return decision == Decision::named && inSet;
    }
};

struct Tally
{
    double trials = 0;
    double detected = 0;
    double topOne = 0;
    double inSet = 0;
    double setSize = 0;
    double named = 0;
    double namedRight = 0;
    double unknown = 0;
    double open = 0; // unknown, or a set with an unlisted cause
    double covered = 0;
    double wrongBetter = 0; // better than no effect and both controls, without being the truth
    double rightBetter = 0;
    double rightComplete = 0;
    double falls = 0;
    double fallsCovered = 0;

    void add(const Outcome& outcome)
    {
        trials += 1;
        if (outcome.decision == Decision::noResidual)
        {
            return;
        }
        detected += 1;
        topOne += outcome.topOne ? 1 : 0;
        inSet += outcome.inSet ? 1 : 0;
        setSize += static_cast<double>(outcome.setSize);
        const bool isName = outcome.decision == Decision::named;
        named += isName ? 1 : 0;
        namedRight += isName && outcome.inSet ? 1 : 0;
        unknown += outcome.decision == Decision::unknown ? 1 : 0;
        open += outcome.decision == Decision::unknown || outcome.unlistedCause ? 1 : 0;
        covered += outcome.covered ? 1 : 0;
        const bool isRight = outcome.isNamedRightly();
        wrongBetter += outcome.better && !isRight ? 1 : 0;
        rightBetter += outcome.better && isRight ? 1 : 0;
        rightComplete += outcome.complete && isRight ? 1 : 0;
        falls += outcome.fallCovered ? 1 : 0;
        fallsCovered += outcome.fallCovered.value_or(false) ? 1 : 0;
    }

    Json json() const
    {
        return {{"detected", share(detected, trials)}, {"topOneWhenDetected", share(topOne, detected)},
            {"truthInSetWhenDetected", share(inSet, detected)},
            {"meanSetSize", detected > 0 ? Json(setSize / detected) : Json(nullptr)},
            {"namedWhenDetected", share(named, detected)}, {"namedRightly", share(namedRight, named)},
            {"wrongNameWhenDetected", share(named - namedRight, detected)},
            {"unknownWhenDetected", share(unknown, detected)}, {"somethingElseWhenDetected", share(open, detected)},
            {"intervalCoversWhenDetected", share(covered, detected)}, {"falseAcceptance", share(wrongBetter, trials)},
            {"rightAcceptance", share(rightBetter, namedRight)},
            {"completeWhenNamedRightly", share(rightComplete, namedRight)},
            {"coverageOfFall", share(fallsCovered, falls)}};
    }
};

Entries withoutScatter(Entries entries)
{
    entries["scatter"] = "0";
    entries["chaos"] = "0";
    return entries;
}

Study withoutSeed(Study study)
{
    study.simulator.seedEntry.clear();
    return study;
}

/// One library, and synthetic data sets for it.
class SyntheticStudy
{
public:
    /// \param allEffects  the study with the effects that are not in the library
    /// \param exact  whether runs do not scatter; the measurements then have the scatter of other runs
    SyntheticStudy(const Study& study, const Study& allEffects, const Entries& defaults, unsigned seed, bool exact)
        : study_(exact ? withoutSeed(study) : study),
          allEffects_(exact ? withoutSeed(allEffects) : allEffects),
          scattering_(study),
          simulator_(exact ? withoutScatter(defaults) : defaults),
          scatteringSimulator_(defaults),
          seed_(seed)
    {
        study_.settings.seed = seed;
        StudySimulator studySimulator(study_, simulator_);
        library_ = makeLibrary(studySimulator);
    }

    std::vector<MeasuredCondition> measure(const Truth& truth, unsigned number)
    {
        allEffects_.settings.seed = seed_ * 4099U + number;
        StudySimulator simulator(allEffects_, simulator_);
        const Setting setting = settingOf(truth, simulator);
        std::vector<MeasuredCondition> all(allEffects_.conditions.size());
        for (std::size_t c = 0; c < all.size(); ++c)
        {
            all[c].features = measured(simulator, c, setting, "measured");
            all[c].declaredError = Eigen::VectorXd::Zero(allEffects_.featureCount());
        }
        return all;
    }

    /// \param without  effect that is left out of the library
    Outcome answer(const std::vector<MeasuredCondition>& data, const Truth& truth, unsigned runSeed,
        std::size_t without = static_cast<std::size_t>(-1))
    {
        Study study = study_;
        study.settings.seed = seed_ * 4099U + runSeed;
        Library library = library_;
        if (without < study.effects.size())
        {
            // Its runs stay in the library, but the effect cannot be found.
            study.effects[without].prior = 1e-300;
        }
        StudySimulator studySimulator(study, simulator_);
        std::mt19937_64 random(study.settings.seed);
        const Answer answer = trace(studySimulator, library, data, random);
        Outcome outcome;
        outcome.decision = answer.decision;
        outcome.pValue = answer.pValue;
        outcome.setSize = answer.set.size();
        outcome.unlistedCause = answer.unlistedCauseInSet;
        for (std::size_t member = 0; member < answer.set.size(); ++member)
        {
            outcome.set.push_back(answer.set[member].effects);
            if (answer.set[member].effects == truth.effects)
            {
                outcome.inSet = true;
                outcome.topOne = member == 0;
            }
        }
        if (truth.effects.size() == 1 && truth.effects.front() < answer.effects.size())
        {
            const EffectFinding& finding = answer.effects[truth.effects.front()];
            outcome.covered =
                finding.fit.lower <= truth.amplitudes.front() && truth.amplitudes.front() <= finding.fit.upper;
            // The most probable effect, whether it is in the set or not.
            outcome.topOne = std::all_of(answer.effects.begin(), answer.effects.end(),
                [&](const EffectFinding& other) { return other.probability <= finding.probability; });
        }
        if (!answer.set.empty())
        {
            const HeldOutResult heldOut = evaluateHeldOut(studySimulator, library, answer, data, data, random);
            outcome.better = heldOut.better;
            outcome.complete = heldOut.complete;
            const double miss = expectedFall(truth, answer, heldOut.conditions) - heldOut.improvement.value;
            outcome.fallCovered = std::abs(miss) <= 1.96 * heldOut.improvement.standardError;
        }
        return outcome;
    }

private:
    static constexpr int repeats = 3;
    static constexpr int repetitions = 40; // of measurement and prediction, for the expected fall

    /// The truth as measured: parameters and common errors are drawn from their distributions. The same for all
    /// measurements of a data set.
    Setting settingOf(const Truth& truth, const StudySimulator& simulator) const
    {
        std::mt19937_64 random(allEffects_.settings.seed);
        std::normal_distribution<double> normal;
        Setting setting = simulator.plainSetting();
        setting.parameters(0) += study_.parameters.front().sd * normal(random);
        setting.errors = Eigen::VectorXd::NullaryExpr(study_.commonErrors.size(), [&] { return normal(random); });
        for (std::size_t k = 0; k < truth.effects.size(); ++k)
        {
            setting.amplitudes(static_cast<Eigen::Index>(truth.effects[k])) = truth.amplitudes[k];
        }
        return setting;
    }

    /// Repeated measurements in one condition, one per row.
    Eigen::MatrixXd measured(
        StudySimulator& simulator, std::size_t condition, const Setting& setting, const std::string& purpose)
    {
        const Eigen::Index features = allEffects_.featureCount();
        Eigen::MatrixXd rows =
            featureRows(simulator.repeats({condition}, setting, purpose, repeats), condition, features);
        if (!study_.simulator.scatters())
        {
            scattering_.settings.seed = allEffects_.settings.seed;
            StudySimulator scattering(scattering_, scatteringSimulator_);
            const Eigen::MatrixXd runs = featureRows(
                scattering.repeats({condition}, scattering.plainSetting(), purpose, 2 * repeats), condition, features);
            rows += (runs.topRows(repeats) - runs.bottomRows(repeats)) / std::sqrt(2.0);
        }
        return rows;
    }

    /// Fall of the held-out error from the fit without an effect to the best one, averaged over repetitions of the
    /// held-out measurements and of the simulations at both fits. Called after `measure`.
    double expectedFall(const Truth& truth, const Answer& answer, const std::vector<std::size_t>& conditions)
    {
        StudySimulator simulator(allEffects_, simulator_);
        const Setting trueSetting = settingOf(truth, simulator);
        const auto extended = [&](Setting setting) {
            setting.amplitudes.conservativeResizeLike(Eigen::VectorXd::Zero(trueSetting.amplitudes.size()));
            return setting;
        };
        const auto means = [&](const Setting& setting, const std::string& purpose, int runs) {
            const auto simulations = simulator.repeats(conditions, setting, purpose, runs);
            return mapped(conditions,
                [&](std::size_t c) { return meanFeatures(featureRows(simulations, c, allEffects_.featureCount())); });
        };
        double sum = 0.0;
        for (int i = 0; i < repetitions; ++i)
        {
            const std::string again = ", again " + std::to_string(i);
            const auto truths = mapped(conditions, [&](std::size_t c) -> Eigen::VectorXd {
                return meanFeatures(measured(simulator, c, trueSetting, "measured" + again));
            });
            const auto rms = [&](const Setting& setting, const std::string& purpose) {
                const auto predicted = means(extended(setting), purpose + again, study_.settings.repeatsHeldOut);
                double squares = 0.0;
                double count = 0.0;
                for (std::size_t c = 0; c < truths.size(); ++c)
                {
                    for (Eigen::Index f = 0; f < truths[c].size(); ++f)
                    {
                        const double error = truths[c](f) - predicted[c](f);
                        if (study_.features[f].kind->isLog() && std::isfinite(error))
                        {
                            squares += error * error;
                            count += 1.0;
                        }
                    }
                }
                return std::sqrt(squares / count);
            };
            sum += rms(answer.null.setting, "before") - rms(answer.set.front().setting, "after");
        }
        return sum / repetitions;
    }

    Study study_;
    Study allEffects_;
    Study scattering_;
    SurrogateSimulator simulator_;
    SurrogateSimulator scatteringSimulator_;
    unsigned seed_;
    Library library_;
};

Json check(const Options& options)
{
    Study study = readStudy(options.study);
    study.settings.draws = options.draws;
    if (!options.gauged.empty())
    {
        readCommonErrors(YamlPlace::fileAt(options.gauged).at("commonErrors"), study);
    }
    Study allEffects = study;
    append(allEffects.effects, outsideLibrary());
    const Entries defaults = readEntries(study.simulator.caseFolder / entriesFile);
    std::mt19937_64 random(options.seed);
    const auto anyOf = [&](std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
    };
    const auto signedAmplitude = [&](std::size_t e, double size) {
        return allEffects.effects[e].bounds.lower < 0.0 && anyOf(2) == 0 ? -size : size;
    };
    const auto size = [&] { return std::uniform_real_distribution<double>(0.25, 1.0)(random); };
    constexpr unsigned perKind = 500; // more than the number of data sets of one kind for one library

    Tally nulls;
    Tally effects;
    Tally decoys;
    Tally pairs;
    std::map<std::string, Tally> byEffect;
    std::map<std::string, Tally> bySize;
    std::map<std::string, Tally> outside;
    std::map<std::string, int> wrongNames; // by "truth size: name"
    double oneOfTwo = 0;                   // pairs of which one effect is named alone
    double sameAnswer = 0;
    double askedAgain = 0;
    double wrongBetter = 0; // over all data sets
    double answered = 0;
    double below = 0;
    std::size_t turn = 0;
    for (int l = 0; l < options.libraries; ++l)
    {
        SyntheticStudy synthetic(
            study, allEffects, defaults, options.seed * 1000U + static_cast<unsigned>(l), options.exact);
        unsigned number = 1;
        for (int i = 0; i < options.nulls; ++i, ++number)
        {
            const Outcome outcome = synthetic.answer(synthetic.measure({}, number), {}, number);
            nulls.add(outcome);
            below += outcome.pValue < 0.5 ? 1 : 0;
        }
        number = perKind;
        for (int i = 0; i < options.effects; ++i, ++number)
        {
            const std::size_t e = turn++ % study.effects.size();
            const double large = size();
            const Truth truth{{e}, {signedAmplitude(e, large)}};
            const auto data = synthetic.measure(truth, number);
            const Outcome outcome = synthetic.answer(data, truth, number);
            effects.add(outcome);
            byEffect[study.effects[e].name].add(outcome);
            bySize[large < 0.5 ? "0.25-0.5" : large < 0.75 ? "0.5-0.75" : "0.75-1"].add(outcome);
            // other effects in each library
            if ((i + l * options.again) % options.effects < options.again)
            {
                const Outcome second = synthetic.answer(data, truth, number + 3 * perKind);
                askedAgain += 1;
                sameAnswer += second.decision == outcome.decision
                                      && (outcome.decision != Decision::named || second.set == outcome.set)
                                  ? 1
                                  : 0;
            }
            if (i < options.decoys)
            {
                decoys.add(synthetic.answer(data, truth, number, e));
            }
        }
        number = 2 * perKind;
        for (const double part : {0.25, 0.5, 1.0})
        {
            for (int i = 0; i < options.unknowns; ++i, ++number)
            {
                const std::size_t e =
                    study.effects.size() + number % (allEffects.effects.size() - study.effects.size());
                const Truth truth{{e}, {part}};
                const Outcome outcome = synthetic.answer(synthetic.measure(truth, number), truth, number);
                const std::string label = std::to_string(part).substr(0, 4);
                outside[label].add(outcome);
                if (outcome.decision == Decision::named)
                {
                    ++wrongNames[allEffects.effects[e].name + ' ' + label + ": "
                                 + study.effects[outcome.set.front().front()].name];
                }
            }
        }
        for (int i = 0; i < options.pairs; ++i, ++number)
        {
            const auto a = anyOf(study.effects.size() - 1);
            const auto b = a + 1 + anyOf(study.effects.size() - a - 1);
            const Truth truth{{a, b}, {signedAmplitude(a, 0.8), signedAmplitude(b, 0.8)}};
            const Outcome outcome = synthetic.answer(synthetic.measure(truth, number), truth, number);
            pairs.add(outcome);
            const bool isOne = outcome.decision == Decision::named && outcome.set.front().size() == 1
                               && (outcome.set.front().front() == a || outcome.set.front().front() == b);
            oneOfTwo += isOne ? 1 : 0;
        }
        std::cerr << "library " << l + 1 << ": false alarms " << nulls.detected << " of " << nulls.trials
                  << "; detected " << effects.detected << " of " << effects.trials << "; of these, truth most probable "
                  << effects.topOne << ", truth in the set " << effects.inSet << ", named " << effects.named
                  << ", named correctly " << effects.namedRight << ", sum of set sizes " << effects.setSize
                  << ", amplitude in its interval " << effects.covered << "; same answer with other seeds "
                  << sameAnswer << " of " << askedAgain << std::endl;
    }
    const auto all = [](const std::map<std::string, Tally>& tallies) {
        Json json = Json::object();
        for (const auto& [name, tally] : tallies)
        {
            json[name] = tally.json();
        }
        return json;
    };
    const auto count = [&](const Tally& tally) {
        wrongBetter += tally.wrongBetter;
        answered += tally.trials;
    };
    count(nulls);
    count(effects);
    for (const auto& [label, tally] : outside)
    {
        count(tally);
    }
    return {{"study", study.name}, {"gauged", mapped(study.commonErrors, std::mem_fn(&CommonError::name))},
        {"seed", options.seed}, {"exact", options.exact}, {"libraries", options.libraries}, {"draws", options.draws},
        {"falseAlarms", share(nulls.detected, nulls.trials)}, {"pValueBelowHalf", share(below, nulls.trials)},
        {"nulls", nulls.json()}, {"effects", effects.json()}, {"bySize", all(bySize)}, {"byEffect", all(byEffect)},
        {"sameAnswerWithOtherSeeds", share(sameAnswer, askedAgain)}, {"leftOutOfTheLibrary", decoys.json()},
        {"outsideLibrary", all(outside)}, {"wrongNames", wrongNames}, {"pairs", pairs.json()},
        {"oneOfTwoNamed", share(oneOfTwo, pairs.detected)}, {"falseAcceptance", share(wrongBetter, answered)},
        {"rightAcceptance", effects.json().at("rightAcceptance")},
        {"coverageOfFall", effects.json().at("coverageOfFall")}};
}

/// The 95 % Wilson interval of the false alarms must contain the nominal level. The other limits lie far below the
/// rates of the full study (identification/results) and far above those of an answer by chance.
bool meetsLimits(const Json& result, double level)
{
    bool good = true;
    const auto require = [&](bool held, const std::string& what) {
        if (!held)
        {
            std::cerr << "This requirement is not met: " << what << '\n';
            good = false;
        }
    };
    const Json& alarms = result["falseAlarms"]["wilson95"];
    require(alarms[0].get<double>() <= level && level <= alarms[1].get<double>(),
        "the rate of false alarms agrees with the nominal level");
    const Json& effects = result["effects"];
    require(effects["detected"]["share"].get<double>() > 0.7, "more than 70 % of the effects are detected");
    require(
        effects["truthInSetWhenDetected"]["share"].get<double>() > 0.8, "more than 80 % of the sets contain the truth");
    require(effects["meanSetSize"].get<double>() < 2.0, "sets have fewer than 2 members on average");
    require(effects["intervalCoversWhenDetected"]["share"].get<double>() > 0.8,
        "more than 80 % of the intervals contain the amplitude that was put in");
    require(effects["wrongNameWhenDetected"]["share"].get<double>() < 0.15, "fewer than 15 % of the names are wrong");
    require(result["falseAcceptance"]["share"].get<double>() <= level,
        "at most the nominal share of the data sets has a wrong effect that enters the model");
    require(
        result["rightAcceptance"]["share"].get<double>() > 0.3, "more than 30 % of the right names enter the model");
    require(result["coverageOfFall"]["share"].get<double>() > 0.8,
        "more than 80 % of the intervals of the error's fall contain its expectation");
    return good;
}

} // namespace

} // namespace clepsydra::identification::tests

int main(int argc, char** argv)
{
    clepsydra::identification::tests::Options options;
    CLI::App app("Measures the error rates of the whole procedure of traceResidual with a surrogate simulator");
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.add_option("study", options.study, "study file of the surrogate")->required();
    app.add_option("--libraries", options.libraries, "number of libraries; the numbers of data sets are per library");
    app.add_option("--nulls", options.nulls, "number of data sets without an effect");
    app.add_option("--effects", options.effects, "number of data sets with one effect of the library");
    app.add_option(
        "--decoys", options.decoys, "number of these that are also answered without that effect in the library");
    app.add_option("--again", options.again, "number of these that are also answered with other seeds of the runs");
    app.add_option("--unknowns", options.unknowns,
        "number of data sets with an effect that is not in the library, for each of three sizes");
    app.add_option("--pairs", options.pairs, "number of data sets with two effects");
    app.add_option("--seed", options.seed, "seed of all random numbers");
    app.add_option("--draws", options.draws, "number of draws from the null distribution of the test");
    app.add_option("--gauged", options.gauged, "file of the effects that are measured with a gauge (commonErrors)");
    app.add_option("--output", options.output, "JSON file to write");
    app.add_flag("--exact", options.exact, "runs do not scatter (seed: none), only measurements do");
    app.add_flag("--check", options.check, "fail if the rates are outside of wide limits");
    CLI11_PARSE(app, argc, argv);
    try
    {
        const auto result = clepsydra::identification::tests::check(options);
        std::cout << result.dump(1) << '\n';
        if (!options.output.empty())
        {
            std::ofstream(options.output) << result.dump(1) << '\n';
        }
        return !options.check || clepsydra::identification::tests::meetsLimits(result, 0.05) ? 0 : 1;
    }
    catch (const std::exception& error)
    {
        std::cerr << "checkIdentification: " << error.what() << '\n';
        return 1;
    }
}
