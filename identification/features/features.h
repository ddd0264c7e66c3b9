#pragma once

#include "curves/curve.h"

#include <map>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// A number taken from a curve. Features are of the order of a logarithm (a change by .01 is 1 %), so that one noise
/// covariance serves all conditions; those that are not say so.
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
    double (*value)(const Curve& curve, const Parameters& parameters); // NaN where the curve does not have it

    /// By its name's beginning.
    bool isLog() const
    {
        return name.rfind("log", 0) == 0;
    }
};

/// All kinds by name.
const std::map<std::string, FeatureKind>& featureKinds();

/// A feature of a study: a kind with its parameters filled in.
struct Feature
{
    std::string name;
    const FeatureKind* kind;
    FeatureKind::Parameters parameters;

    double operator()(const Curve& curve) const
    {
        return kind->value(curve, parameters);
    }
};

} // namespace clepsydra::identification
