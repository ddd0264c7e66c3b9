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
        const Eigen::MatrixXd single =
            block.noise.size() > 0 ? block.noise : Eigen::MatrixXd(emulator.noise(block.places, block.places));
        const Eigen::MatrixXd unknown = emulator.uncertainty(parameters, {})(block.places, block.places);
        const Eigen::VectorXd variance = (single.cwiseProduct(block.meanShare) + block.unshown() + unknown).diagonal();
        for (Eigen::Index k = 0; k < block.size(); ++k)
        {
            const auto place = static_cast<std::size_t>(block.places[static_cast<std::size_t>(k)]);
            all.push_back({block.condition, static_cast<std::size_t>(emulator.features[place]),
                {answer.measured.mean(block.first + k) - expected(k), std::sqrt(variance(k))}});
        }
    }
    return all;
}

} // namespace clepsydra::identification
