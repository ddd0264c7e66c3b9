#include "report/fitted.h"

#include "effects/measuringChain.h"
#include "emulator/settings.h"
#include "report/text.h"
#include "tokens/didYouMean.h"

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

Json unitJson(const std::string& name, double siUnits)
{
    return {{"unit", name}, {"si", siUnits}};
}

/// All entries of a run that are numbers.
Expression::Variables numbersAt(const StudySimulator& studySimulator, std::size_t condition, const Setting& setting)
{
    return numbersOf(studySimulator.entriesOf(condition, setting), studySimulator.simulator().defaults());
}

/// The first training condition in which an effect acts; the entries of that condition are shown.
std::size_t shownCondition(const Study& study, const Effect* effect)
{
    const auto trained = study.conditionsOf(Role::training);
    const auto shown = std::find_if(trained.begin(), trained.end(),
        [&](std::size_t c) { return effect == nullptr || acts(*effect, study.conditions[c]); });
    return shown == trained.end() ? trained.front() : *shown;
}

/// Standard errors of the physical values of an explanation's parameters.
Eigen::VectorXd parameterErrors(const Study& study, const Explanation& explanation)
{
    const Eigen::MatrixXd& covariance = explanation.fits.front().marginal;
    return Eigen::VectorXd::NullaryExpr(study.parameters.size(), [&](Eigen::Index i) {
        return i < covariance.rows() ? std::sqrt(covariance(i, i)) * study.parameters[i].sd : 0.0;
    });
}

/// An amplitude changed by its error towards 0, where the formulas are certainly defined.
double movedInwards(double amplitude, double error)
{
    return amplitude > 0.0 ? amplitude - error : amplitude + error;
}

/// An entry at the fit of an explanation. Its error follows to first order from those of parameters and amplitudes.
Estimate entryAt(const StudySimulator& studySimulator, std::size_t condition, const std::string& entry,
    const Explanation& explanation)
{
    const auto value = [&](const Setting& setting) { return numbersAt(studySimulator, condition, setting).at(entry); };
    Estimate estimate{value(explanation.setting), 0.0};
    const auto add = [&](const Setting& moved) {
        estimate.standardError = std::hypot(estimate.standardError, value(moved) - estimate.value);
    };
    const Eigen::VectorXd errors = parameterErrors(studySimulator.study(), explanation);
    for (Eigen::Index i = 0; i < errors.size(); ++i)
    {
        Setting moved = explanation.setting;
        moved.parameters(i) += errors(i);
        add(moved);
    }
    for (std::size_t k = 0; k < explanation.effects.size(); ++k)
    {
        Setting moved = explanation.setting;
        double& amplitude = moved.amplitudes(explanation.effects[k]);
        amplitude = movedInwards(amplitude, explanation.fits[k].sd);
        add(moved);
    }
    return estimate;
}

double sizeOfChain(const Effect& effect, double amplitude)
{
    return (*effect.chainSize)({{"a", amplitude}});
}

} // namespace

Json fittedNumbers(const Findings& findings)
{
    const Study& study = *findings.study;
    const Explanation& null = findings.answer->null;
    const Explanation* best = findings.answer->set.empty() ? nullptr : &findings.answer->set.front();
    Json all = Json::array();
    const auto add = [&](const std::string& name, const std::string& unit, auto estimateAt) {
        all.push_back({{"name", name}, {"unit", unit}, {"independent", nullptr}, {"assumed", nullptr},
            {"from", nullptr}, {"withoutEffect", estimateAt(null)},
            {"withEffect", best == nullptr ? Json() : Json(estimateAt(*best))}});
    };
    const auto addEntry = [&](const std::string& entry, const Effect* effect) {
        add(entry, "", [&](const Explanation& explanation) {
            return entryAt(*findings.studySimulator, shownCondition(study, effect), entry, explanation);
        });
    };
    for (std::size_t p = 0; p < study.parameters.size(); ++p)
    {
        const Parameter& parameter = study.parameters[p];
        add(parameter.name, parameter.unit, [&](const Explanation& explanation) {
            return Estimate{explanation.setting.parameters(p), parameterErrors(study, explanation)(p)};
        });
        all.back()[parameter.from == Origin::measured ? "independent" : "assumed"] =
            Estimate{parameter.mean, parameter.sd};
        all.back()["from"] = nameOf(parameter.from);
        for (const auto& [entry, formula] : parameter.entries)
        {
            if (formula.text() != parameter.name)
            {
                addEntry(entry, nullptr);
            }
        }
    }
    for (std::size_t k = 0; best != nullptr && k < best->effects.size(); ++k)
    {
        const Effect& effect = study.effects[best->effects[k]];
        if (effect.isOfChain())
        {
            const double amplitude = best->setting.amplitudes(best->effects[k]);
            const double size = sizeOfChain(effect, amplitude);
            const double moved = sizeOfChain(effect, movedInwards(amplitude, best->fits[k].sd));
            add(effect.chainOperation, chainOperations().at(effect.chainOperation).unit, [&](const Explanation& one) {
                return &one == best ? Estimate{size, std::abs(moved - size)} : Estimate{};
            });
        }
        for (const auto& [entry, formula] : effect.entries)
        {
            addEntry(entry, &effect);
        }
    }
    return all;
}

Json unitsOf(const Study& study)
{
    Json units = Json::object();
    for (const auto& condition : study.conditions)
    {
        const auto& [files, time, value, numbers] = condition.measured;
        for (const auto& feature : files.empty() ? std::vector<Feature>{} : study.features)
        {
            const Dimension dimension = feature.kind->dimension;
            units[feature.name] = dimension == Dimension::value  ? unitJson(value.unit, value.siUnits)
                                  : dimension == Dimension::time ? unitJson(time.unit, time.siUnits)
                                  : dimension == Dimension::rate
                                      ? unitJson(value.unit + '/' + time.unit, value.siUnits / time.siUnits)
                                      : unitJson("1", 1.0);
        }
        for (const auto& number : numbers)
        {
            units[study.features[number.feature].name] = unitJson(number.unit, number.siUnits);
        }
    }
    return units;
}

std::string endOfRange(double value, double error, const Bounds& range)
{
    constexpr double errors = 1.2;
    const double near = std::max(errors * error, 1e-6 * (range.upper - range.lower));
    // An interval wider than half of the range says nothing of an end.
    return 4.0 * near >= range.upper - range.lower ? ""
           : value <= range.lower + near           ? "lower"
           : value >= range.upper - near           ? "upper"
                                                   : "";
}

std::vector<std::string> valuesAtEnds(const Findings& findings)
{
    const Study& study = *findings.study;
    std::vector<std::string> all;
    const auto look = [&](const std::string& name, double value, double error, const Bounds& range,
                          const std::string& where) {
        const std::string end = endOfRange(value, error, range);
        // An amplitude near 0, where its range may begin, is small and nothing else.
        if (!end.empty() && !(error > 0.0 && end == "lower" && range.lower == 0.0))
        {
            all.push_back(name + " lies at the " + end + " end of its range, " + rounded(range.lower) + " to "
                          + rounded(range.upper) + ", in the fit " + where);
        }
    };
    const auto lookAt = [&](const Explanation& explanation, const std::string& where) {
        for (std::size_t p = 0; p < study.parameters.size(); ++p)
        {
            const Parameter& parameter = study.parameters[p];
            look(parameter.name, explanation.setting.parameters(p), 0.0, {parameter.lower, parameter.upper}, where);
        }
        for (std::size_t k = 0; k < explanation.effects.size(); ++k)
        {
            const Effect& effect = study.effects[explanation.effects[k]];
            if (!effect.isSwitch)
            {
                look("the size of " + effect.name, explanation.setting.amplitudes(explanation.effects[k]),
                    explanation.fits[k].sd, effect.bounds, where);
            }
        }
    };
    lookAt(findings.answer->null, "without an effect");
    for (const auto& each : findings.answer->set)
    {
        lookAt(each, "with " + nameOf(study, each.effects));
    }
    return all;
}

std::string describeSize(const Findings& findings, const Explanation& explanation)
{
    const Study& study = *findings.study;
    if (explanation.effects.size() != 1 || study.effects[explanation.effects.front()].isSwitch)
    {
        return "";
    }
    const std::size_t e = explanation.effects.front();
    const Effect& effect = study.effects[e];
    if (effect.isOfChain())
    {
        const std::string& unit = chainOperations().at(effect.chainOperation).unit;
        return effect.chainOperation + ' ' + rounded(sizeOfChain(effect, explanation.setting.amplitudes(e)))
               + (unit.empty() ? "" : ' ' + unit);
    }
    const std::size_t condition = shownCondition(study, &effect);
    Setting without = explanation.setting;
    without.amplitudes(e) = 0.0;
    const auto before = numbersAt(*findings.studySimulator, condition, without);
    const auto after = numbersAt(*findings.studySimulator, condition, explanation.setting);
    const auto sizes = mapped(namesOf(effect.entries), [&](const std::string& entry) {
        constexpr double least = 1e-4;
        const double share = after.at(entry) / before.at(entry) - 1.0;
        const std::string size = std::abs(share) < least ? "less than 0.01" : rounded(100.0 * std::abs(share));
        return entry + ' '
               + (std::isfinite(share) ? size + (share < 0.0 ? " % smaller" : " % larger") : rounded(after.at(entry)));
    });
    return listed(sizes, ", ");
}

std::vector<Residual> residualsOf(const Findings& findings, const Setting& setting)
{
    const Answer& answer = *findings.answer;
    const Eigen::VectorXd parameters = inSds(*findings.study, setting.parameters);
    const auto on =
        numbersWhere(findings.study->effects.size(), [&](std::size_t e) { return setting.amplitudes(e) != 0.0; });
    const auto present = mapped(on, [&](std::size_t e) { return Present{e, setting.amplitudes(e)}; });
    std::vector<Residual> all;
    for (const auto& block : answer.layout.blocks)
    {
        const ConditionEmulator& emulator = *(*answer.emulator)[block.condition];
        const Eigen::VectorXd expected = emulator.at(parameters, present)(block.places);
        const Eigen::MatrixXd unknown = emulator.uncertainty(parameters, present)(block.places, block.places);
        const Eigen::VectorXd noise =
            (block.ofOne(emulator, present).cwiseProduct(block.meanShare) + block.unshown()).diagonal();
        for (Eigen::Index k = 0; k < block.size(); ++k)
        {
            const std::size_t feature = emulator.features[block.places[k]];
            const double measured = answer.measured.mean(block.first + k);
            all.push_back({block.condition, feature, {measured - expected(k), std::sqrt(noise(k) + unknown(k, k))},
                {measured, std::sqrt(noise(k))}, {expected(k), std::sqrt(unknown(k, k))}});
        }
    }
    return all;
}

double rmsInErrors(const std::vector<Residual>& residuals)
{
    double squares = 0.0;
    for (const auto& one : residuals)
    {
        squares += std::pow(one.estimate.value / one.estimate.standardError, 2);
    }
    return std::sqrt(squares / static_cast<double>(residuals.size()));
}

} // namespace clepsydra::identification
