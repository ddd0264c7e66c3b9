// A formula: either it is refused with std::invalid_argument, or it has one value, the same again and in brackets.
#include "inputFile.h"

#include "study/expression.h"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <stdexcept>

using clepsydra::identification::Expression;

namespace
{

bool same(double a, double b)
{
    return a == b || (std::isnan(a) && std::isnan(b));
}

void evaluate(const std::string& text)
{
    const Expression::Variables variables = {{"a", 0.5}, {"particleDiameter", 2e-3}, {"friction", 0.15}};
    const Expression formula(text);
    const double value = formula(variables);
    if (!same(formula(variables), value) || !same(Expression("(" + text + ")")(variables), value))
    {
        std::cerr << "'" << text << "' has two values\n";
        std::abort();
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try
    {
        evaluate(clepsydra::inputText(data, size));
    }
    catch (const std::invalid_argument&) // the user's error, reported
    {
        return 0;
    }
    return 0;
}
