#pragma once

#include "curves/curve.h"

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// What a feature measures of its curve, from which its unit follows.
enum class Dimension
{
    share, // a number without a unit
    value,
    time,
    rate // value per time
};

/// A kind of number that is taken from a curve. Most kinds are logarithms (a change by 0.01 is 1 %), so that the same
/// noise covariance holds in all conditions.
struct FeatureKind
{
    struct Parameter
    {
        std::string name;
        double byDefault; // NaN: must be given
        std::string meaning;
    };

    using Parameters = std::map<std::string, double>;

    std::string name;
    std::string meaning;
    std::vector<Parameter> parameters;
    double (*value)(const Curve& curve, const Parameters& parameters); // NaN if the curve does not have the feature
    Dimension dimension; // of the quantity itself, where the feature is a logarithm

    /// Whether the feature is a logarithm, which its name begins with.
    bool isLog() const
    {
        return name.rfind("log", 0) == 0;
    }
};

/// All kinds by name.
const std::map<std::string, FeatureKind>& featureKinds();

/// A feature of a study: a kind with values of its parameters.
struct Feature
{
    std::string name;
    const FeatureKind* kind;
    FeatureKind::Parameters parameters;
    std::optional<std::size_t> column = {}; // index of the curve's `others`; empty: the curve itself

    /// NaN if the curve does not have the feature, or not its column
    double operator()(const Curve& curve) const
    {
        if (!column)
        {
            return kind->value(curve, parameters);
        }
        return *column < curve.others.size() && curve.others[*column].time.size() > 1
                   ? kind->value(curve.others[*column], parameters)
                   : std::numeric_limits<double>::quiet_NaN();
    }
};

} // namespace clepsydra::identification
