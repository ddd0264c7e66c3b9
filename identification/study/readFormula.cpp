#include "study/readFormula.h"

#include "effects/measuringChain.h"
#include "tokens/didYouMean.h"

#include <cmath>

namespace clepsydra::identification
{

Expression readFormula(const YamlPlace& place)
{
    return checkedAt(place, [&] { return Expression(place.text()); });
}

double valueOf(const YamlPlace& place, const Expression& formula, const Expression::Variables& variables)
{
    const double value = checkedAt(place, [&] { return formula(variables); });
    if (!std::isfinite(value))
    {
        place.fail("the formula '" + formula.text() + "' gives no finite number");
    }
    return value;
}

std::pair<std::string, Expression> readChain(const YamlPlace& place)
{
    const auto operations = place.map();
    if (operations.size() != 1 || chainOperations().count(operations.front().first) == 0)
    {
        place.fail("needs one operation, " + listed(namesOf(chainOperations()))
                   + ", with the formula of its size, as in { gain: \"0.01*a\" }");
    }
    return {operations.front().first, readFormula(operations.front().second)};
}

} // namespace clepsydra::identification
