#pragma once

#include <map>
#include <memory>
#include <string>

namespace clepsydra::identification
{

/// A formula of a study file, as "particleDiameter*(1 + 0.05*a)". It may contain + - * / ^, brackets, numbers, names,
/// and the functions exp, log, sqrt, abs, round, min, max, sin, cos (angles in radians).
class Expression
{
public:
    using Variables = std::map<std::string, double>;

    /// \throws std::invalid_argument naming the position at which the text cannot be parsed
    explicit Expression(std::string text);

    /// Value of the formula. \throws std::invalid_argument if a name is not among the variables
    double operator()(const Variables& variables) const;

    /// Whether the formula contains a name.
    bool holds(const std::string& name) const;

    const std::string& text() const
    {
        return text_;
    }

private:
    struct Parsed;

    std::string text_;
    std::shared_ptr<const Parsed> parsed_;
};

} // namespace clepsydra::identification
