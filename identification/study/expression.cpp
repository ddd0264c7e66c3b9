#include "study/expression.h"

#include "tokens/didYouMean.h"

#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace clepsydra::identification
{

namespace
{

[[noreturn]] void fail(const std::string& formula, const std::string& what)
{
    constexpr std::size_t longest = 80;
    throw std::invalid_argument("in the formula '" + formula.substr(0, longest)
                                + (formula.size() > longest ? "...'" : "'") + what
                                + "; allowed are + - * / ^, brackets, numbers, names, exp, log, sqrt, abs, round, sin, "
                                  "cos, min(a, b) and max(a, b)");
}

} // namespace

/// The parser, and the values of the formula's names, to which the parser has pointers.
struct Expression::Parsed
{
    explicit Parsed(const std::string& formula)
    {
        using Function = double (*)(double);
        // Others belong to muParser's assignments, comparisons, conditions and texts.
        const auto other = formula.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                                     "_.+-*/^(), \t\n\v\f\r");
        if (other != std::string::npos)
        {
            fail(formula, ", at character " + std::to_string(other + 1) + ": not understood");
        }
        parser.ClearConst();
        parser.ClearFun();
        for (const auto& [name, function] : std::map<std::string, Function>{{"exp", std::exp}, {"log", std::log},
                 {"sqrt", std::sqrt}, {"abs", std::abs}, {"round", std::round}, {"sin", std::sin}, {"cos", std::cos}})
        {
            parser.DefineFun(name, function);
        }
        parser.DefineFun(
            "min", +[](double a, double b) { return std::min(a, b); });
        parser.DefineFun(
            "max", +[](double a, double b) { return std::max(a, b); });
        parser.SetVarFactory(&Parsed::variable, this);
        try
        {
            parser.SetExpr(formula);
            int results = 0;
            parser.Eval(results);
            if (results != 1)
            {
                fail(formula, ": more than one value");
            }
        }
        catch (const mu::ParserError& error)
        {
            fail(formula, ", at character " + std::to_string(std::max(error.GetPos(), 0) + 1) + ": " + error.GetMsg());
        }
    }
    Parsed(const Parsed&) = delete;
    Parsed& operator=(const Parsed&) = delete;
    ~Parsed() = default;

    static double* variable(const char* name, void* self)
    {
        if (std::isdigit(static_cast<unsigned char>(*name)) != 0)
        {
            throw mu::ParserError("'" + std::string(name) + "' is neither a number nor a name");
        }
        // A placeholder for the first evaluation.
        return &static_cast<Parsed*>(self)->values.emplace(name, 1.0).first->second;
    }

    mu::Parser parser;
    mutable Variables values; // a map, so that pointers to its values stay valid
};

Expression::Expression(std::string text)
    : text_(std::move(text)),
      parsed_(std::make_shared<const Parsed>(text_))
{}

bool Expression::holds(const std::string& name) const
{
    return parsed_->values.count(name) > 0;
}

double Expression::operator()(const Variables& variables) const
{
    for (auto& [name, value] : parsed_->values)
    {
        const auto given = variables.find(name);
        if (given == variables.end())
        {
            const auto known = namesOf(variables);
            fail(text_, ": unknown name '" + name + "'" + didYouMean(name, known) + "; names are " + listed(known));
        }
        value = given->second;
    }
    return parsed_->parser.Eval();
}

} // namespace clepsydra::identification
