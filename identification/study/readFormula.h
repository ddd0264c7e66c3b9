#pragma once

#include "study/expression.h"
#include "study/yaml.h"

#include <string>
#include <utility>

namespace clepsydra::identification
{

/// \throws StudyError with file and line, like the others
Expression readFormula(const YamlPlace& place);

/// The value of the formula that stands at a place.
double valueOf(const YamlPlace& place, const Expression& formula, const Expression::Variables& variables);

/// An operation of the measuring chain with the formula of its size: { gain: "0.01*a" }.
std::pair<std::string, Expression> readChain(const YamlPlace& place);

} // namespace clepsydra::identification
