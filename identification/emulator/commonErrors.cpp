#include "emulator/library.h"

#include "lists.h"
#include "emulator/settings.h"
#include "study/measurements.h"

#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

Setting moved(const StudySimulator& studySimulator, std::size_t error, double z)
{
    Setting setting = studySimulator.plainSetting();
    setting.errors = Eigen::VectorXd::Zero(studySimulator.study().commonErrors.size());
    setting.errors(error) = z;
    return setting;
}

/// Runs with an error of z standard deviations in the entries. The seeds do not depend on z.
std::vector<SimulationOrder> ordersOf(
    const StudySimulator& studySimulator, std::size_t condition, std::size_t error, double z)
{
    const Study& study = studySimulator.study();
    const int repeats = study.simulator.scatters() ? study.settings.repeatsAlone : 1;
    std::vector<SimulationOrder> orders;
    orders.reserve(static_cast<std::size_t>(repeats));
    for (int number = 0; number < repeats; ++number)
    {
        orders.push_back(
            {condition, moved(studySimulator, error, z), "common error: " + study.commonErrors[error].name, number});
    }
    return orders;
}

} // namespace

double differenceStep(const Study& study)
{
    return study.simulator.scatters() ? 2.0 : 1.0;
}

std::vector<SimulationOrder> commonErrorOrders(const StudySimulator& studySimulator, std::size_t condition)
{
    const Study& study = studySimulator.study();
    std::vector<SimulationOrder> all;
    for (std::size_t i = 0; i < study.commonErrors.size(); ++i)
    {
        if (contains(study.commonErrors[i].conditions, condition) && !study.commonErrors[i].entries.empty())
        {
            append(all, ordersOf(studySimulator, condition, i, -differenceStep(study)));
            append(all, ordersOf(studySimulator, condition, i, differenceStep(study)));
        }
    }
    return all;
}

Eigen::MatrixXd sharedErrorSlopes(
    StudySimulator& studySimulator, std::size_t condition, const std::vector<Simulation>& plain)
{
    const Study& study = studySimulator.study();
    const double step = differenceStep(study);
    const auto meanAt = [&](std::size_t error, double z) {
        const bool isOfChain = study.commonErrors[error].entries.empty();
        auto simulations = isOfChain ? plain : studySimulator.run(ordersOf(studySimulator, condition, error, z));
        for (auto& simulation : simulations)
        {
            if (isOfChain && simulation.condition == condition && !simulation.failed)
            {
                simulation.features = studySimulator.featuresOf(
                    studySimulator.throughChain(simulation.plain, condition, moved(studySimulator, error, z)));
            }
        }
        return meanFeatures(featureRows(simulations, condition, study.featureCount()));
    };
    const Eigen::ArrayXd here = meanFeatures(featureRows(plain, condition, study.featureCount()));
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(study.featureCount(), study.commonErrors.size());
    for (std::size_t i = 0; i < study.commonErrors.size(); ++i)
    {
        const CommonError& error = study.commonErrors[i];
        if (!contains(error.conditions, condition))
        {
            continue;
        }
        auto slope = slopes.col(i);
        const Eigen::ArrayXd above = meanAt(i, step);
        const Eigen::ArrayXd below = meanAt(i, -step);
        const Eigen::ArrayXd both = (above - below) / (2.0 * step);
        const Eigen::ArrayXd one = (above.isFinite().select(above - here, here - below)) / step;
        slope = both.isFinite().select(both, one);
        if (here.isFinite().any() && !(here.isFinite() && slope.array().isFinite()).any())
        {
            throw std::runtime_error("condition '" + study.conditions[condition].name
                                     + "': all runs with the common error '" + error.name + "' have failed"
                                     + studySimulator.effort().lastFailure());
        }
        slope = slope.array().isFinite().select(slope, 0.0);
    }
    if ((study.modelError.array() > 0.0).any())
    {
        slopes.conservativeResize(Eigen::NoChange, slopes.cols() + study.featureCount());
        slopes.rightCols(study.featureCount()) = study.modelError.asDiagonal();
    }
    return slopes;
}

} // namespace clepsydra::identification
