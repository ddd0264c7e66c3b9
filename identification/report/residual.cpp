#include "report/residual.h"

#include "emulator/settings.h"

#include <cmath>

namespace clepsydra::identification
{

std::vector<Residual> residualsOf(const Findings& findings)
{
    const Answer& answer = *findings.answer;
    const Eigen::VectorXd parameters = inSds(*findings.study, answer.null.setting.parameters);
    std::vector<Residual> all;
    for (const auto& block : answer.layout.blocks)
    {
        const ConditionEmulator& emulator = *(*answer.emulator)[block.condition];
        const Eigen::VectorXd expected = emulator.at(parameters, {})(block.places);
        const Eigen::MatrixXd unknown = emulator.uncertainty(parameters, {})(block.places, block.places);
        const Eigen::VectorXd variance =
            (block.ofOne(emulator, {}).cwiseProduct(block.meanShare) + block.unshown() + unknown).diagonal();
        for (Eigen::Index k = 0; k < block.size(); ++k)
        {
            const std::size_t feature = emulator.features[block.places[k]];
            all.push_back({block.condition, feature,
                {answer.measured.mean(block.first + k) - expected(k), std::sqrt(variance(k))}});
        }
    }
    return all;
}

} // namespace clepsydra::identification
