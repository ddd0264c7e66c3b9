#pragma once

#include "study/expression.h"
#include "study/yaml.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace clepsydra::identification
{

/// What a function gives; what it finds wrong with its argument is reported with file and line.
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

/// \throws StudyError with file and line, like the others
Expression readFormula(const YamlPlace& place);

/// The value of the formula that stands at a place.
double valueOf(const YamlPlace& place, const Expression& formula, const Expression::Variables& variables);

/// An operation of the measuring chain with the formula of its size: { gain: "0.01*a" }.
std::pair<std::string, Expression> readChain(const YamlPlace& place);

} // namespace clepsydra::identification
