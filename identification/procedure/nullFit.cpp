#include "procedure/nullFit.h"

#include "procedure/assemble.h"
#include "procedure/problemAt.h"

#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

constexpr int nullFits = 2;
constexpr int exactNullFits = 5;

std::string failuresOf(const Simulator& simulator)
{
    return simulator.failures().empty() ? "" : "; the last run that failed: " + simulator.failures().back().reason;
}

/// \param simulation  "the library's runs", say
void requireEnough(const ResidualProblem& problem, const TraceInputs& inputs, const std::string& simulation)
{
    if (problem.residual.size() <= problem.parameterColumns.cols())
    {
        throw std::runtime_error(inputs.study.file.string() + ": measurements and " + simulation + " have "
                                 + std::to_string(problem.residual.size())
                                 + " features in common in the training conditions; allowed: more than there are "
                                   "parameters, "
                                 + std::to_string(problem.parameterColumns.cols()) + failuresOf(inputs.simulator));
    }
}

/// The library's runs at the base setting, as simulations.
std::vector<Simulation> baseSimulations(const TraceInputs& inputs)
{
    std::vector<Simulation> base;
    for (const auto condition : inputs.training)
    {
        for (const auto row : inputs.library.conditions[condition].baseFeatures.rowwise())
        {
            base.push_back({condition, row.transpose(), {}, {}, 0, false});
        }
    }
    return base;
}

} // namespace

std::vector<const ResidualProblem*> NullFit::anchors() const
{
    const Eigen::ArrayXd away = (problem.parameterOffset - atBase.parameterOffset).array().abs();
    if ((away >= farInPriorSds).any() && atBase.residual.size() == problem.residual.size())
    {
        return {&problem, &atBase};
    }
    return {&problem};
}

NullFit fitNull(const TraceInputs& inputs, const Noise& noise)
{
    const auto& [simulator, study, library, data, training] = inputs;
    NullFit fit;
    Eigen::VectorXd anchor = simulator.plainSetting().parameters;
    fit.atBase = assemble(study, library, data, baseSimulations(inputs), anchor);
    fit.problem = fit.atBase;
    requireEnough(fit.atBase, inputs, "the library's runs");
    // Without scatter a fit can be followed to its end: what is left of it would be taken for a residual.
    const bool exact = study.rig.seedEntry.empty();
    bool far = true;
    for (int round = 0; far && round < (exact ? exactNullFits : nullFits); ++round)
    {
        anchor = shifted(study, fit.problem, Fits(whitened(fit.problem, noise)).parameterShift());
        fit.simulations = simulator.repeats(training, simulator.plainSetting(anchor),
            round == 0 ? "null fit" : "null fit, again", study.settings.repeatsAtFit);
        fit.problem = assemble(study, library, data, fit.simulations, anchor);
        requireEnough(fit.problem, inputs, "the runs at the null fit");
        const Fits refit(whitened(fit.problem, noise));
        const Eigen::VectorXd shift = refit.parameterShift();
        fit.setting = simulator.plainSetting(shifted(study, fit.problem, shift));
        fit.misfit = refit.nullMisfit();
        fit.parameterSd = refit.parameterCovariance().diagonal().cwiseSqrt();
        const Eigen::ArrayXd away = shift.cwiseAbs();
        far = (away >= farInPriorSds).any() || (exact && (away > nearInErrors * fit.parameterSd.array()).any());
    }
    return fit;
}

} // namespace clepsydra::identification
