#include "procedure/magnitudes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

double largestOf(const Curve& curve)
{
    double largest = 0.0;
    for (const double value : curve.value)
    {
        largest = std::max(largest, std::abs(value));
    }
    return largest;
}

class Comparison
{
public:
    Comparison(const Study& study, std::size_t condition)
        : study_(study),
          condition_(condition)
    {}

    void compare(const std::string& what, double measured, double simulated) const
    {
        const double factor = measured > simulated ? measured / simulated : simulated / measured;
        if (std::isfinite(factor) && factor > study_.magnitudeLimit)
        {
            throw std::runtime_error(
                study_.file.string() + ": condition '" + study_.conditions[condition_].name + "': " + what + " is "
                + textOf(measured) + " measured and " + textOf(simulated)
                + " in the first run of the bare model (SI units). Are unit and column right, in 'measured' and in "
                  "'observable'? Where so large a difference is meant, give the study a magnitudeLimit above "
                + textOf(study_.magnitudeLimit));
        }
    }

private:
    const Study& study_;
    std::size_t condition_;
};

void compare(const Study& study, const MeasuredCondition& measured, const Simulation& simulation)
{
    const Comparison comparison(study, simulation.condition);
    for (const auto& curve : measured.curves)
    {
        comparison.compare("the largest value", largestOf(curve), largestOf(simulation.curve));
    }
    const Eigen::VectorXd features = meanFeatures(measured.features);
    for (std::size_t f = 0; f < study.features.size(); ++f)
    {
        const auto i = static_cast<Eigen::Index>(f);
        if (study.features[f].kind->isLog())
        {
            comparison.compare("feature '" + study.features[f].name + "', its logarithm undone,", std::exp(features(i)),
                std::exp(simulation.features(i)));
        }
    }
}

} // namespace

void checkMagnitudes(Simulator& simulator, const std::vector<MeasuredCondition>& data, bool execute)
{
    const Study& study = simulator.study();
    std::vector<SimulationOrder> orders;
    for (const auto c : study.conditionsOf(Role::training))
    {
        // The same run as the library's first.
        const SimulationOrder order{c, simulator.plainSetting(), "check of units", 0, "base"};
        if (data[c].features.rows() > 0 && (execute || simulator.missing({order}) == 0))
        {
            orders.push_back(order);
        }
    }
    for (const auto& simulation : simulator.run(orders))
    {
        if (!simulation.failed)
        {
            compare(study, data[simulation.condition], simulation);
        }
    }
}

} // namespace clepsydra::identification
