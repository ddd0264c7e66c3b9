#pragma once

#include <map>
#include <memory>
#include <string>

namespace clepsydra::identification
{

/// A formula as users write it in a study file: "particleDiameter*(1 + 0.05*a)". Knows + - * / ^, brackets, numbers,
/// names, and exp, log, sqrt, abs, round, min, max, sin, cos (angles in radians).
class Expression
{
public:
    using Variables = std::map<std::string, double>;

    /// \throws std::invalid_argument that shows where the text cannot be understood
    explicit Expression(std::string text);

    /// \throws std::invalid_argument if a name is not among the variables
    double operator()(const Variables& variables) const;

    /// Whether a name stands in the formula.
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
