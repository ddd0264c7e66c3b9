#include "report/fitted.h"

#include "effects/measuringChain.h"
#include "report/numbers.h"

#include <cmath>

namespace clepsydra::identification
{

namespace
{

/// All numbers of a run's entries.
Expression::Variables numbersAt(const Simulator& simulator, std::size_t condition, const Setting& setting)
{
    Entries all = simulator.entriesOf(condition, setting);
    const Entries defaults = simulator.rig().defaults();
    all.insert(defaults.begin(), defaults.end());
    return numbersOf(all);
}

/// The first training condition where an effect acts; its entries are shown.
std::size_t shownCondition(const Study& study, const Effect* effect)
{
    const auto trained = study.conditionsOf(Role::training);
    for (const auto c : trained)
    {
        if (effect == nullptr || acts(*effect, study.conditions[c]))
        {
            return c;
        }
    }
    return trained.front();
}

/// A fit: where it is, and the standard errors of its parameters (physical) and amplitude.
struct Fitted
{
    Setting setting;
    Eigen::VectorXd parameterErrors;
    double amplitudeError = 0.0;
};

Eigen::VectorXd physicalErrors(const Study& study, const Eigen::MatrixXd& covariance)
{
    Eigen::VectorXd errors(static_cast<Eigen::Index>(study.parameters.size()));
    for (Eigen::Index i = 0; i < errors.size(); ++i)
    {
        const bool known = i < covariance.rows();
        errors(i) = known ? std::sqrt(covariance(i, i)) * study.parameters[static_cast<std::size_t>(i)].sd : 0.0;
    }
    return errors;
}

Fitted fittedOf(const Study& study, const Answer& answer, const Explanation& explanation)
{
    if (explanation.effects.size() != 1)
    {
        return {explanation.setting, physicalErrors(study, answer.nullCovariance)};
    }
    const Fit& fit = answer.effects[explanation.effects.front()].fit;
    return {explanation.setting, physicalErrors(study, fit.covariance), fit.sd};
}

/// An entry at a fit, its error to first order from those of parameters and amplitude.
Estimate entryAt(const Simulator& simulator, std::size_t condition, const Fitted& fitted, const std::string& entry,
    const Explanation& explanation)
{
    const auto value = [&](const Setting& setting) { return numbersAt(simulator, condition, setting).at(entry); };
    Estimate estimate{value(fitted.setting), 0.0};
    const auto add = [&](const Setting& moved) {
        estimate.standardError = std::hypot(estimate.standardError, value(moved) - estimate.value);
    };
    for (Eigen::Index i = 0; i < fitted.parameterErrors.size(); ++i)
    {
        Setting moved = fitted.setting;
        moved.parameters(i) += fitted.parameterErrors(i);
        add(moved);
    }
    for (const auto e : explanation.effects)
    {
        Setting moved = fitted.setting;
        double& amplitude = moved.amplitudes(static_cast<Eigen::Index>(e));
        amplitude += amplitude > 0.0 ? -fitted.amplitudeError : fitted.amplitudeError; // inwards: formulas hold there
        add(moved);
    }
    return estimate;
}

double sizeOfChain(const Effect& effect, double amplitude)
{
    return (*effect.chainSize)({{"a", amplitude}});
}

} // namespace

std::vector<FittedNumber> fittedNumbers(const Findings& findings)
{
    const Study& study = *findings.study;
    const Answer& answer = *findings.answer;
    const Fitted null{answer.null.setting, physicalErrors(study, answer.nullCovariance)};
    std::optional<Fitted> best;
    if (!answer.set.empty())
    {
        best = fittedOf(study, answer, answer.set.front());
    }
    std::vector<FittedNumber> all;
    const auto addEntry = [&](const std::string& entry, std::size_t condition) {
        const auto at = [&](const Fitted& fitted, const Explanation& explanation) {
            return entryAt(*findings.simulator, condition, fitted, entry, explanation);
        };
        FittedNumber number{entry, "", {}, at(null, answer.null), {}};
        if (best)
        {
            number.after = at(*best, answer.set.front());
        }
        all.push_back(number);
    };
    for (std::size_t p = 0; p < study.parameters.size(); ++p)
    {
        const Parameter& parameter = study.parameters[p];
        const auto i = static_cast<Eigen::Index>(p);
        FittedNumber number{parameter.name, parameter.unit, Estimate{parameter.mean, parameter.sd},
            {null.setting.parameters(i), null.parameterErrors(i)}, {}};
        if (best)
        {
            number.after = Estimate{best->setting.parameters(i), best->parameterErrors(i)};
        }
        all.push_back(number);
        for (const auto& [entry, formula] : parameter.entries)
        {
            if (formula.text() != parameter.name)
            {
                addEntry(entry, shownCondition(study, nullptr));
            }
        }
    }
    for (const auto e : best ? answer.set.front().effects : std::vector<std::size_t>{})
    {
        const Effect& effect = study.effects[e];
        const double amplitude = best->setting.amplitudes(static_cast<Eigen::Index>(e));
        if (effect.isOfChain())
        {
            const double size = sizeOfChain(effect, amplitude);
            const double inwards = amplitude > 0.0 ? -best->amplitudeError : best->amplitudeError;
            all.push_back({effect.chainOperation, chainOperations().at(effect.chainOperation).unit, {}, {0.0, 0.0},
                Estimate{size, std::abs(sizeOfChain(effect, amplitude + inwards) - size)}});
        }
        for (const auto& [entry, formula] : effect.entries)
        {
            addEntry(entry, shownCondition(study, &effect));
        }
    }
    return all;
}

std::string sizeInWords(const Findings& findings, const Explanation& explanation)
{
    const Study& study = *findings.study;
    if (explanation.effects.size() != 1 || study.effects[explanation.effects.front()].isSwitch)
    {
        return "";
    }
    const Effect& effect = study.effects[explanation.effects.front()];
    const auto e = static_cast<Eigen::Index>(explanation.effects.front());
    if (effect.isOfChain())
    {
        const std::string& unit = chainOperations().at(effect.chainOperation).unit;
        return effect.chainOperation + ' ' + rounded(sizeOfChain(effect, explanation.setting.amplitudes(e)))
               + (unit.empty() ? "" : ' ' + unit);
    }
    const std::size_t condition = shownCondition(study, &effect);
    Setting without = explanation.setting;
    without.amplitudes(e) = 0.0;
    const auto before = numbersAt(*findings.simulator, condition, without);
    const auto after = numbersAt(*findings.simulator, condition, explanation.setting);
    std::string text;
    for (const auto& [entry, formula] : effect.entries)
    {
        const double share = after.at(entry) / before.at(entry) - 1.0;
        text += (text.empty() ? "" : ", ") + entry + ' '
                + (std::isfinite(share) ? rounded(100.0 * std::abs(share)) + (share < 0.0 ? " % smaller" : " % larger")
                                        : rounded(after.at(entry)));
    }
    return text;
}

} // namespace clepsydra::identification
