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
    if (fit.problem.residual.size() <= fit.problem.parameterColumns.cols())
    {
        throw std::runtime_error(
            study.file.string() + ": the training conditions have too few features in common with the simulation");
    }
    // Without scatter a fit can be followed to its end: what is left of it would be taken for a residual.
    const bool exact = study.rig.seedEntry.empty();
    bool far = true;
    for (int round = 0; far && round < (exact ? exactNullFits : nullFits); ++round)
    {
        anchor = shifted(study, fit.problem, Fits(whitened(fit.problem, noise)).parameterShift());
        fit.simulations = simulator.repeats(training, simulator.plainSetting(anchor),
            round == 0 ? "null fit" : "null fit, again", study.settings.repeatsAtFit);
        fit.problem = assemble(study, library, data, fit.simulations, anchor);
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
