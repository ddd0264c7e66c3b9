#pragma once

#include "study/expression.h"
#include "study/yaml.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace clepsydra::identification
{

/// Result of a function. An std::invalid_argument that it throws becomes a StudyError with file and line.
template<class Function>
auto checkedAt(const YamlPlace& place, Function function)
{
    try
    {
        return function();
    }
    catch (const std::invalid_argument& error)
    {
        place.fail(error.what());
    }
}

/// Reads a formula. \throws StudyError naming file and line
Expression readFormula(const YamlPlace& place);

/// Value of a formula. \param place  of the formula, for the message \throws StudyError if the value is not finite
double valueOf(const YamlPlace& place, const Expression& formula, const Expression::Variables& variables);

/// Reads an operation of the measuring chain with the formula of its size: { gain: "0.01*a" }.
/// \throws StudyError naming file, line and the known operations
std::pair<std::string, Expression> readChain(const YamlPlace& place);

} // namespace clepsydra::identification
