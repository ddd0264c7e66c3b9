#include "report/residual.h"

#include "emulator/settings.h"

#include <cmath>

namespace clepsydra::identification
{

std::vector<Residual> residualsOf(const Findings& findings, const Setting& setting)
{
    const Answer& answer = *findings.answer;
    const Eigen::VectorXd parameters = inSds(*findings.study, setting.parameters);
    std::vector<Present> present;
    for (Eigen::Index e = 0; e < setting.amplitudes.size(); ++e)
    {
        if (setting.amplitudes(e) != 0.0)
        {
            present.push_back({static_cast<std::size_t>(e), setting.amplitudes(e)});
        }
    }
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
