#include "report/report.h"

#include "lists.h"
#include "runner/studySimulator.h"
#include "report/fitted.h"
#include "report/text.h"

#include <clepsydra/version.h>

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

void to_json(Json& json, const LogRatio& ratio)
{
    json = {{"logRatio", ratio.value}, {"pValue", ratio.pValue}};
}

void to_json(Json& json, const HeldOutScore& score)
{
    json = {{"rmsLogError", score.rmsLogError.value}, {"standardError", score.rmsLogError.standardError},
        {"chiSquare", score.chiSquare}, {"pValue", score.pValue}, {"overNull", score.overNull}};
}

namespace
{

template<class Value>
Json orNull(const std::optional<Value>& value)
{
    return value ? Json(*value) : Json();
}

Json parametersOf(const Study& study, const Eigen::VectorXd& values)
{
    Json json = Json::object();
    for (std::size_t i = 0; i < study.parameters.size(); ++i)
    {
        json[study.parameters[i].name] = values(i);
    }
    return json;
}

Json explanationJson(const Study& study, const Explanation& explanation)
{
    Json amplitudes = Json::object();
    for (const auto e : explanation.effects)
    {
        amplitudes[study.effects[e].name] = explanation.setting.amplitudes(e);
    }
    return {{"name", nameOf(study, explanation.effects)}, {"amplitudes", amplitudes},
        {"parameters", parametersOf(study, explanation.setting.parameters)}, {"logOdds", explanation.logOdds},
        {"probability", explanation.probability}, {"chiSquare", explanation.chiSquare},
        {"simulated", !explanation.runs.empty()}};
}

/// The independent measurement of an amplitude, the fit without it, and whether the two agree within two standard
/// deviations; null for an effect that was not measured.
Json measuredJson(const Effect& effect, const EffectFinding& finding)
{
    const auto agrees = agreesWithMeasurement(effect, finding);
    if (!agrees)
    {
        return nullptr;
    }
    const auto& [mean, sd] = *effect.measured;
    return {{"mean", mean}, {"sd", sd}, {"fittedWithout", Estimate{finding.alone->amplitude, finding.alone->sd}},
        {"agrees", *agrees}};
}

Json effectsJson(const Findings& findings)
{
    const Study& study = *findings.study;
    const Answer& answer = *findings.answer;
    Json list = Json::array();
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        const Effect& effect = study.effects[e];
        const EffectFinding& finding = answer.effects[e];
        list.push_back({{"name", effect.name}, {"meaning", effect.meaning}, {"family", effect.family},
            {"inSet", finding.inSet}, {"amplitude", finding.fit.amplitude}, {"standardError", finding.fit.sd},
            {"interval95", {finding.fit.lower, finding.fit.upper}},
            {"range", {effect.bounds.lower, effect.bounds.upper}}, {"chiSquare", finding.chiSquare},
            {"logOdds", finding.logOdds}, {"probability", finding.probability},
            {"probabilityNeeded", finding.threshold},
            {"notInSetBecause", finding.notInSetBecause.empty() ? Json() : Json(finding.notInSetBecause)},
            {"measured", measuredJson(effect, finding)}, {"judged", finding.known},
            {"parameters", finding.known ? parametersOf(study, finding.parameters) : Json::object()},
            {"smallestDetectable", answer.visibility.detected(e)}, {"smallestNamed", answer.visibility.named(e)},
            {"howToMeasure", effect.hint}});
    }
    return list;
}

Json residualJson(const Findings& findings)
{
    const Study& study = *findings.study;
    Json list = Json::array();
    for (const auto& residual : residualsOf(findings, findings.answer->null.setting))
    {
        const std::string& condition = study.conditions[residual.condition].name;
        if (list.empty() || list.back()["condition"] != condition)
        {
            list.push_back({{"condition", condition}, {"measuredMinusSimulated", Json::object()}});
        }
        list.back()["measuredMinusSimulated"][study.features[residual.feature].name] = residual.estimate;
    }
    return list;
}

/// An estimate of a feature as the quantity itself, where the feature is a logarithm.
Json quantity(const Feature& feature, const Estimate& value)
{
    return feature.kind->isLog() ? Estimate{std::exp(value.value), std::exp(value.value) * value.standardError} : value;
}

Json rowOf(const Condition& condition, const Feature& feature, const Estimate& measured, const Estimate& before,
    const std::optional<Estimate>& after)
{
    return {{"condition", condition.name}, {"feature", feature.name}, {"measured", quantity(feature, measured)},
        {"before", quantity(feature, before)}, {"after", after ? quantity(feature, *after) : Json(nullptr)}};
}

/// Measured and predicted features of the training conditions, by the emulator.
Json trainingNumbers(const Findings& findings)
{
    const Study& study = *findings.study;
    const Explanation* best = bestOf(*findings.answer);
    const auto before = residualsOf(findings, findings.answer->null.setting);
    const auto after = best == nullptr ? std::vector<Residual>{} : residualsOf(findings, best->setting);
    Json list = Json::array();
    for (std::size_t i = 0; i < before.size(); ++i)
    {
        list.push_back(rowOf(study.conditions[before[i].condition], study.features[before[i].feature],
            before[i].measured, before[i].predicted, after.empty() ? std::nullopt : std::optional(after[i].predicted)));
    }
    return list;
}

/// Measured and predicted features of the held-out conditions. Logarithms are converted into the quantities themselves.
Json heldOutNumbers(const Study& study, const HeldOutResult& result)
{
    Json list = Json::array();
    for (std::size_t i = 0; i < result.conditions.size(); ++i)
    {
        const HeldOutData& data = result.data[i];
        const Eigen::VectorXd error =
            (result.predictedBefore[i].dataCovariance.cwiseProduct(data.meanShare).diagonal() + data.declaredVariance)
                .cwiseSqrt();
        for (std::size_t f = 0; f < study.features.size(); ++f)
        {
            if (!std::isfinite(data.mean(f)))
            {
                continue;
            }
            const auto predicted = [&](const Prediction& prediction) {
                return Estimate{
                    prediction.mean(f), std::sqrt(prediction.variance(f) + data.errorSlopes.row(f).squaredNorm())};
            };
            list.push_back(rowOf(study.conditions[result.conditions[i]], study.features[f], {data.mean(f), error(f)},
                predicted(result.predictedBefore[i]),
                result.predictedAfter.empty() ? std::nullopt : std::optional(predicted(result.predictedAfter[i]))));
        }
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
    const Json names = mapped(result.conditions, [&](std::size_t c) { return study.conditions[c].name; });
    if (result.conditions.empty())
    {
        return {{"conditions", names}, {"before", nullptr}, {"after", nullptr}, {"nearest", nullptr},
            {"oneMoreParameter", nullptr}, {"gaussianProcess", nullptr}, {"better", false}, {"complete", false}};
    }
    Json oneMore = result.oneMoreParameter;
    oneMore["operation"] = study.settings.oneMoreParameter;
    oneMore["size"] = result.oneMoreAmplitude;
    return {{"conditions", names}, {"before", result.before}, {"after", orNull(result.after)},
        {"nearest", orNull(result.nearest)}, {"oneMoreParameter", oneMore},
        {"gaussianProcess", orNull(result.gaussianProcess)}, {"improvement", result.improvement},
        {"overOneMoreParameter", result.overOneMore},
        {"overGaussianProcess", result.gaussianProcess ? Json(result.overGaussianProcess) : Json(nullptr)},
        {"noiseFloor", result.noiseFloor}, {"better", result.better}, {"complete", result.complete},
        {"notBetterBecause", result.notBetterBecause}, {"notScored", result.notScored},
        {"numbers", heldOutNumbers(study, result)}};
}

Json runsJson(const StudySimulator& studySimulator)
{
    const Json failures = mapped(studySimulator.effort().failures, [&](const Failure& failure) -> Json {
        return {{"purpose", failure.purpose}, {"condition", failure.condition}, {"seed", failure.seed},
            {"reason", fromStudy(studySimulator.study(), failure.reason)},
            {"repeatedWithAnotherSeed", failure.repeated}};
    });
    int all = 0;
    for (const auto& [purpose, count] : studySimulator.effort().runsByPurpose)
    {
        all += purpose == checkOfUnits ? 0 : count;
    }
    return {{"used", all}, {"executed", studySimulator.effort().executed},
        {"fromCache", all - studySimulator.effort().executed}, {"seconds", studySimulator.effort().seconds},
        {"secondsOfStored", studySimulator.effort().secondsOfStored},
        {"byPurpose", studySimulator.effort().runsByPurpose}, {"failures", failures}};
}

Json nextJson(const Findings& findings)
{
    Json list = Json::array();
    for (const auto& next : findings.next == nullptr ? std::vector<NextExperiment>{} : *findings.next)
    {
        Json outcomes = Json::array();
        for (const auto& outcome : next.outcomes)
        {
            Json features = Json::object();
            for (std::size_t f = 0; f < findings.study->features.size(); ++f)
            {
                features[findings.study->features[f].name] = {{"value", outcome.features(f)}, {"sd", outcome.sd(f)}};
            }
            outcomes.push_back({{"if", outcome.name}, {"probability", outcome.probability}, {"features", features}});
        }
        list.push_back({{"condition", findings.study->conditions[next.condition].name}, {"separation", next.separation},
            {"perCost", next.perCost}, {"predicted", outcomes}});
    }
    return list;
}

} // namespace

Json jsonOf(const Findings& findings)
{
    const Study& study = *findings.study;
    const Answer& answer = *findings.answer;
    Json json;
    json["study"] = study.name;
    json["program"] = std::string("traceResidual ") + version + " (" + gitCommit + ")";
    json["decision"] = nameOf(answer.decision);
    json["name"] = answer.decision != Decision::named ? Json(nullptr)
                   : answer.family.empty()            ? Json(nameOf(study, answer.set.front().effects))
                                                      : Json(answer.family);
    json["summary"] = nullptr; // the sentences, which state what follows, get their places
    json["details"] = nullptr;
    json["fitted"] = fittedNumbers(findings);
    json["measureNext"] = nullptr;
    json["set"] = mapped(answer.set, [&](const Explanation& each) { return explanationJson(study, each); });
    json["family"] = answer.family;
    json["somethingElseInSet"] = answer.unlistedCauseInSet;
    json["somethingElse"] = {
        {"probability", answer.decision == Decision::unknown ? Json(nullptr) : Json(answer.otherProbability)},
        {"probabilityNeeded", answer.otherThreshold}};
    json["oddsOfName"] = answer.oddsOfName
                             ? Json{{"logOdds", answer.oddsOfName->first}, {"needed", answer.oddsOfName->second}}
                             : Json(nullptr);
    json["nearest"] = answer.nearest ? explanationJson(study, *answer.nearest) : Json();
    if (answer.nearest)
    {
        json["nearest"]["takes"] = shareTaken(answer, *answer.nearest);
        json["nearest"]["left"] = 1.0 - shareTaken(answer, *answer.nearest);
    }
    json["pValue"] = answer.pValue;
    json["null"] = explanationJson(study, answer.null);
    json["null"]["parameterSds"] = Eigen::VectorXd(answer.null.fits.front().covariance.diagonal().cwiseSqrt());
    json["effects"] = effectsJson(findings);
    json["residual"] = residualJson(findings);
    json["numbers"] = trainingNumbers(findings);
    json["units"] = unitsOf(study);
    json["heldOut"] = heldOutJson(findings);
    json["calibration"] = {{"critical", answer.calibration.critical}, {"level", study.settings.level},
        {"draws", study.settings.draws}, {"coverage", study.settings.coverage},
        {"wrongNamesAllowed", study.settings.wrongNames}, {"wrongNamesOfDecoys", answer.calibration.wrongNames},
        {"decoys", "each effect of the library left out in turn; patterns of any shape, orthogonal to the parameters"}};
    json["calibration"]["lookAlikes"] = mapped(answer.visibility.alike, [&](const auto& pair) {
        return std::vector<std::string>{study.effects[pair.first].name, study.effects[pair.second].name};
    });
    json["nextExperiment"] = nextJson(findings);
    json["emulator"] = {{"noiseOfARun", Eigen::VectorXd(answer.emulator->noise().diagonal().cwiseSqrt())},
        {"noiseOfAMeasurement", Eigen::VectorXd(answer.layout.noise.diagonal().cwiseSqrt())},
        {"degreesOfFreedom", answer.layout.noiseFreedom}};
    json["runs"] = runsJson(*findings.studySimulator);
    json["seeds"] = {{"study", study.settings.seed}, {"byPurpose", findings.studySimulator->effort().seedsByPurpose}};
    json["assumptions"] = nullptr;
    json["remarks"] = answer.remarks;
    json = Json::parse(json.dump()); // NaN and infinity, which JSON does not have, become null
    addSentences(json, findings);
    std::stable_sort(json["effects"].begin(), json["effects"].end(),
        [](const Json& a, const Json& b) { return a["probability"].get<double>() > b["probability"].get<double>(); });
    return json;
}

} // namespace clepsydra::identification
