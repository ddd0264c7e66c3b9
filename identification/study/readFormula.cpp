#include "study/readFormula.h"

#include "effects/measuringChain.h"
#include "words/didYouMean.h"

#include <cmath>
#include <stdexcept>

namespace clepsydra::identification
{

Expression readFormula(const YamlPlace& place)
{
    try
    {
        return Expression(place.text());
    }
    catch (const std::invalid_argument& error)
    {
        place.fail(error.what());
    }
}

double valueOf(const YamlPlace& place, const Expression& formula, const Expression::Variables& variables)
{
    try
    {
        const double value = formula(variables);
        if (!std::isfinite(value))
        {
            place.fail("the formula '" + formula.text() + "' gives no finite number");
        }
        return value;
    }
    catch (const std::invalid_argument& error)
    {
        place.fail(error.what());
    }
}

std::pair<std::string, Expression> readChain(const YamlPlace& place)
{
    const auto operations = place.map();
    if (operations.size() != 1 || chainOperations().count(operations.front().first) == 0)
    {
        place.fail("needs one operation, " + listed(namesOf(chainOperations()))
                   + ", with the formula of its size: { gain: \"0.01*a\" }");
    }
    return {operations.front().first, readFormula(operations.front().second)};
}

} // namespace clepsydra::identification
