#include "runner/magnitudes.h"

#include <cmath>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

double largestOf(const Curve& curve)
{
    return Eigen::Map<const Eigen::ArrayXd>(curve.value.data(), curve.value.size()).abs().maxCoeff();
}

void compare(const Study& study, const MeasuredCondition& data, const Simulation& simulation)
{
    const auto compareNumbers = [&](const std::string& what, double measured, double simulated) {
        const double factor = measured > simulated ? measured / simulated : simulated / measured;
        if (std::isfinite(factor) && factor > study.magnitudeLimit)
        {
            throw std::runtime_error(
                study.file.string() + ": condition '" + study.conditions[simulation.condition].name + "': " + what
                + " is " + textOf(measured) + " measured and " + textOf(simulated)
                + " in the first run of the baseline (SI units). Are unit and column right, in 'measured' and in "
                  "'observable'? If so large a difference is intended, give the study a magnitudeLimit above "
                + textOf(study.magnitudeLimit));
        }
    };
    for (const auto& curve : data.curves)
    {
        compareNumbers("the largest value", largestOf(curve), largestOf(simulation.curve));
    }
    const Eigen::VectorXd features = meanFeatures(data.features);
    for (std::size_t f = 0; f < study.features.size(); ++f)
    {
        if (study.features[f].kind->isLog())
        {
            compareNumbers("the exponential of feature '" + study.features[f].name + "'", std::exp(features(f)),
                std::exp(simulation.features(f)));
        }
    }
}

} // namespace

void checkMagnitudes(StudySimulator& studySimulator, const std::vector<MeasuredCondition>& data, bool execute)
{
    const Study& study = studySimulator.study();
    std::vector<SimulationOrder> orders;
    for (const auto c : study.conditionsOf(Role::training))
    {
        // The seed is that of the library's first run, so that the run is made once.
        const SimulationOrder order{c, studySimulator.plainSetting(), checkOfUnits, 0, "base"};
        if (data[c].features.rows() > 0 && (execute || studySimulator.missing({order}) == 0))
        {
            orders.push_back(order);
        }
    }
    for (const auto& simulation : studySimulator.run(orders))
    {
        if (!simulation.failed)
        {
            compare(study, data[simulation.condition], simulation);
        }
    }
}

} // namespace clepsydra::identification
