#include "report/json.h"

#include "identifiability/identifiability.h"
#include "report/words.h"

#include <clepsydra/version.h>

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

using Json = nlohmann::ordered_json;

/// NaN and infinity do not exist in JSON.
Json number(double value)
{
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json numbers(const Eigen::VectorXd& values)
{
    Json list = Json::array();
    for (const double value : values)
    {
        list.push_back(number(value));
    }
    return list;
}

Json estimate(const Estimate& value)
{
    return {{"value", number(value.value)}, {"standardError", number(value.standardError)}};
}

Json heldOutScore(const HeldOutScore& score)
{
    return {{"rmsLogError", number(score.rmsLogError.value)},
        {"standardError", number(score.rmsLogError.standardError)}, {"crps", estimate(score.crps)}};
}

Json parametersOf(const Study& study, const Eigen::VectorXd& values)
{
    Json json = Json::object();
    for (std::size_t i = 0; i < study.parameters.size(); ++i)
    {
        json[study.parameters[i].name] = values(static_cast<Eigen::Index>(i));
    }
    return json;
}

Json explanationJson(const Study& study, const Explanation& explanation)
{
    Json amplitudes = Json::object();
    for (const auto e : explanation.effects)
    {
        amplitudes[study.effects[e].name] = explanation.setting.amplitudes(static_cast<Eigen::Index>(e));
    }
    return {{"name", nameOf(study, explanation)}, {"amplitudes", amplitudes},
        {"parameters", parametersOf(study, explanation.setting.parameters)}, {"logOdds", explanation.logOdds},
        {"misfit", explanation.misfit}, {"misfitLimit", explanation.misfitLimit}, {"confirmed", explanation.confirmed}};
}

/// What the effect sets at its amplitude, in words that a user can check.
Json entriesAt(const Effect& effect, double amplitude)
{
    Json json = Json::object();
    if (effect.isOfChain())
    {
        json[effect.chainOperation] = (*effect.chainSize)({{"a", amplitude}});
    }
    for (const auto& [entry, formula] : effect.entries)
    {
        json[entry] = formula.text();
    }
    for (const auto& [entry, word] : effect.words)
    {
        json[entry] = word;
    }
    return json;
}

Json effectsJson(const Findings& findings)
{
    const Study& study = *findings.study;
    const Answer& answer = *findings.answer;
    const Identifiability table =
        identifiability(answer.problem, answer.noise, study.bounds(), answer.significance.bestGainCritical);
    // Probabilities among single effects and "something else", given that there is a residual.
    double largest = answer.otherLogOdds;
    for (const auto& finding : answer.effects)
    {
        largest = std::max(largest, finding.logOdds);
    }
    double sum = std::exp(answer.otherLogOdds - largest);
    for (const auto& finding : answer.effects)
    {
        sum += std::exp(finding.logOdds - largest);
    }
    Json list = Json::array();
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        const Effect& effect = study.effects[e];
        const EffectFinding& finding = answer.effects[e];
        const Score& score = finding.score();
        const auto i = static_cast<Eigen::Index>(e);
        const double reach = intervalSds(answer.noise) * score.sd;
        const auto [lower, upper] = effect.bounds;
        list.push_back({{"name", effect.name}, {"meaning", effect.meaning},
            {"kind", effect.isOfChain() ? "measuringChain" : "simulator"}, {"inSet", finding.inSet},
            {"amplitude", number(score.amplitude)}, {"standardError", number(score.sd)},
            {"interval95",
                {number(std::max(lower, score.amplitude - reach)), number(std::min(upper, score.amplitude + reach))}},
            {"range", {lower, upper}}, {"sets", entriesAt(effect, score.amplitude)}, {"misfit", number(score.misfit)},
            {"misfitLimit", finding.misfitLimit}, {"logEvidence", number(score.logEvidence)},
            {"logOdds", number(finding.logOdds)}, {"probability", number(std::exp(finding.logOdds - largest) / sum)},
            {"confirmed", finding.confirmed.has_value()}, {"parameters", parametersOf(study, finding.parameters)},
            {"maskedByParameters", number(table.masked(i))},
            {"smallestDetectable", number(table.smallestDetectable(i))}, {"howToMeasure", effect.hint}});
    }
    std::stable_sort(list.begin(), list.end(),
        [](const Json& a, const Json& b) { return a["logOdds"].get<double>() > b["logOdds"].get<double>(); });
    return list;
}

Json residualJson(const Findings& findings)
{
    const Study& study = *findings.study;
    const Answer& answer = *findings.answer;
    Json list = Json::array();
    for (std::size_t block = 0; block < answer.problem.blocks.size(); ++block)
    {
        const auto& b = answer.problem.blocks[block];
        const Eigen::VectorXd sd = answer.problem.covariance(block, answer.noise).diagonal().cwiseSqrt();
        Json features = Json::object();
        for (std::size_t k = 0; k < b.features.size(); ++k)
        {
            const auto row = b.firstRow + static_cast<Eigen::Index>(k);
            features[study.features[static_cast<std::size_t>(b.features[k])].name] = {
                {"value", answer.problem.residual(row)}, {"standardError", sd(static_cast<Eigen::Index>(k))}};
        }
        list.push_back({{"condition", study.conditions[b.condition].name}, {"measuredMinusSimulated", features}});
    }
    return list;
}

Json heldOutJson(const Findings& findings)
{
    if (findings.heldOut == nullptr)
    {
        return nullptr;
    }
    const Study& study = *findings.study;
    const HeldOutResult& result = *findings.heldOut;
    Json names = Json::array();
    for (const auto c : result.conditions)
    {
        names.push_back(study.conditions[c].name);
    }
    Json members = Json::array();
    for (const auto& member : result.members)
    {
        Json json = heldOutScore(member.score);
        json["name"] = nameOf(study, findings.answer->set[member.member]);
        members.push_back(json);
    }
    if (result.conditions.empty())
    {
        return {{"conditions", names}, {"before", nullptr}, {"after", nullptr}, {"oneMoreParameter", nullptr},
            {"gaussianProcess", nullptr}, {"accepted", false}};
    }
    Json oneMore = heldOutScore(result.oneMoreParameter);
    oneMore["operation"] = study.settings.oneMoreParameter;
    oneMore["size"] = result.oneMoreAmplitude;
    Json bestOfUnknown = nullptr;
    if (result.bestOfUnknown)
    {
        bestOfUnknown = heldOutScore(*result.bestOfUnknown);
        bestOfUnknown["explanation"] = explanationJson(study, *findings.answer->bestOfUnknown);
    }
    return {{"conditions", names}, {"before", heldOutScore(result.before)},
        {"after", result.after ? heldOutScore(*result.after) : Json(nullptr)}, {"oneMoreParameter", oneMore},
        {"gaussianProcess", heldOutScore(result.gaussianProcess)}, {"improvement", estimate(result.improvement)},
        {"overOneMoreParameter", estimate(result.overOneMore)}, {"noiseFloor", result.noiseFloor},
        {"noiseLimit", result.noiseLimit}, {"accepted", result.accepted()},
        {"notAcceptedBecause", result.notAcceptedBecause}, {"members", members}, {"bestOfUnknown", bestOfUnknown}};
}

Json runsJson(const Simulator& simulator)
{
    Json failures = Json::array();
    for (const auto& failure : simulator.failures())
    {
        failures.push_back({{"purpose", failure.purpose}, {"condition", failure.condition}, {"seed", failure.seed},
            {"reason", failure.reason}, {"repeatedWithAnotherSeed", failure.repeated}});
    }
    int all = 0;
    for (const auto& [purpose, count] : simulator.runsByPurpose())
    {
        all += count;
    }
    return {{"used", all}, {"executed", simulator.executed()}, {"fromCache", all - simulator.executed()},
        {"seconds", simulator.seconds()}, {"secondsOfStored", simulator.secondsOfStored()},
        {"byPurpose", simulator.runsByPurpose()}, {"failures", failures}};
}

Json nextJson(const Findings& findings)
{
    Json list = Json::array();
    if (findings.next == nullptr)
    {
        return list;
    }
    for (const auto& next : *findings.next)
    {
        Json outcomes = Json::array();
        for (const auto& outcome : next.outcomes)
        {
            Json features = Json::object();
            for (std::size_t f = 0; f < findings.study->features.size(); ++f)
            {
                const auto i = static_cast<Eigen::Index>(f);
                features[findings.study->features[f].name] = {
                    {"value", number(outcome.features(i))}, {"sd", number(outcome.sd(i))}};
            }
            outcomes.push_back({{"if", outcome.name}, {"probability", outcome.probability}, {"features", features}});
        }
        list.push_back({{"condition", findings.study->conditions[next.condition].name}, {"separation", next.separation},
            {"perCost", next.perCost}, {"predicted", outcomes}});
    }
    return list;
}

Json noiseJson(const Findings& findings)
{
    const Noise& noise = findings.answer->noise;
    return {{"pooled", noise.pooled}, {"dataSd", numbers(noise.data.matrix.diagonal().cwiseSqrt())},
        {"dataDegreesOfFreedom", noise.data.nu}, {"dataShrinkage", noise.data.shrinkage},
        {"simulationSd", numbers(noise.simulation.matrix.diagonal().cwiseSqrt())},
        {"simulationDegreesOfFreedom", noise.simulation.nu}, {"simulationShrinkage", noise.simulation.shrinkage},
        {"modelError", numbers(noise.modelError)}, {"seedCorrelation", findings.library->seedCorrelation},
        {"seedCorrelationError", findings.library->seedCorrelationError},
        {"commonSeeds", findings.library->commonSeeds}, {"spreadRatio", number(findings.answer->spread.ratio)},
        {"spreadPValue", findings.answer->spread.pValue}};
}

Json identifiabilityJson(const Findings& findings)
{
    const Study& study = *findings.study;
    const Answer& answer = *findings.answer;
    const Identifiability table =
        identifiability(answer.problem, answer.noise, study.bounds(), answer.significance.bestGainCritical);
    Json pairs = Json::array();
    for (const auto& [i, j] : lookAlikes(table, 2.0))
    {
        pairs.push_back({study.effects[i].name, study.effects[j].name});
    }
    return {{"lookAlikes", pairs}, {"collinearityOfAll", table.collinearityOfAll}};
}

} // namespace

Json jsonOf(const Findings& findings)
{
    const Study& study = *findings.study;
    const Answer& answer = *findings.answer;
    const auto listed = [&](const std::vector<Explanation>& explanations) {
        Json list = Json::array();
        for (const auto& explanation : explanations)
        {
            list.push_back(explanationJson(study, explanation));
        }
        return list;
    };
    Json json;
    json["study"] = study.name;
    json["program"] = std::string("traceResidual ") + version + " (" + gitCommit + ")";
    json["decision"] = nameOf(answer.decision);
    json["name"] = answer.decision == Decision::named ? Json(nameOf(study, answer.set.front())) : Json(nullptr);
    json["summary"] = inWords(findings);
    json["set"] = listed(answer.set);
    json["pairsAlike"] = listed(answer.pairsAlike);
    json["somethingElseInSet"] = !answer.somethingElseBecause.empty();
    json["somethingElseBecause"] = answer.somethingElseBecause;
    json["pValue"] = answer.significance.pValue;
    json["test"] = {{"omnibus", answer.significance.omnibus}, {"omnibusPValue", answer.significance.omnibusPValue},
        {"bestGain", answer.significance.bestGain}, {"bestGainPValue", answer.significance.bestGainPValue},
        {"noticedShape", answer.significance.noticed}, {"level", study.settings.level},
        {"draws", study.settings.draws}};
    json["null"] = explanationJson(study, answer.null);
    json["null"]["parameterSds"] = numbers(answer.parameterSd);
    json["somethingElse"] = {{"logOdds", answer.otherLogOdds}};
    json["effects"] = effectsJson(findings);
    json["pairs"] = listed(answer.pairs);
    json["residual"] = residualJson(findings);
    json["heldOut"] = heldOutJson(findings);
    json["identifiability"] = identifiabilityJson(findings);
    json["nextExperiment"] = nextJson(findings);
    json["noise"] = noiseJson(findings);
    json["runs"] = runsJson(*findings.simulator);
    json["seeds"] = {{"study", study.settings.seed}, {"byPurpose", findings.simulator->seedsByPurpose()}};
    json["assumptions"] = assumptionsOf(findings);
    json["remarks"] = answer.remarks;
    return json;
}

} // namespace clepsydra::identification
