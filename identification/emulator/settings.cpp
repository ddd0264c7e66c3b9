#include "emulator/settings.h"

#include "lists.h"

#include <algorithm>

namespace clepsydra::identification
{

Eigen::VectorXd inSds(const Study& study, const Eigen::VectorXd& parameters)
{
    return Eigen::VectorXd::NullaryExpr(parameters.size(),
        [&](Eigen::Index i) { return (parameters(i) - study.parameters[i].mean) / study.parameters[i].sd; });
}

Eigen::VectorXd physical(const Study& study, const Eigen::VectorXd& inSds)
{
    return Eigen::VectorXd::NullaryExpr(inSds.size(), [&](Eigen::Index i) { return study.parameters[i].at(inSds(i)); });
}

Setting settingOf(
    const StudySimulator& studySimulator, const Eigen::VectorXd& inSds, const std::vector<Present>& present)
{
    Setting setting = studySimulator.plainSetting(physical(studySimulator.study(), inSds));
    for (const auto& [effect, amplitude] : present)
    {
        setting.amplitudes(effect) = amplitude;
    }
    return setting;
}

Eigen::MatrixXd featureRows(const std::vector<Simulation>& simulations, std::size_t condition, Eigen::Index features)
{
    const auto own =
        numbersWhere(simulations.size(), [&](std::size_t i) { return simulations[i].condition == condition; });
    Eigen::MatrixXd rows(own.size(), features);
    for (Eigen::Index row = 0; row < rows.rows(); ++row)
    {
        rows.row(row) = simulations[own[row]].features.transpose();
    }
    return rows;
}

std::vector<std::vector<Eigen::Index>> repeatsOf(const std::vector<Setting>& settings)
{
    std::vector<std::vector<Eigen::Index>> groups;
    for (std::size_t i = 0; i < settings.size(); ++i)
    {
        const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& one) {
            const Setting& other = settings[one.front()];
            return other.parameters == settings[i].parameters && other.amplitudes == settings[i].amplitudes;
        });
        if (group == groups.end())
        {
            groups.push_back({static_cast<Eigen::Index>(i)});
        }
        else
        {
            group->push_back(i);
        }
    }
    return groups;
}

} // namespace clepsydra::identification
