#include "study/expression.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace clepsydra::identification
{

struct Expression::Node
{
    std::function<double(const Variables&)> value;
};

namespace
{

using Value = std::function<double(const Expression::Variables&)>;

/// Recursive descent: sum -> product -> power -> sign -> atom.
class Parser
{
public:
    explicit Parser(const std::string& text)
        : text_(text)
    {}

    Value all()
    {
        Value value = sum();
        skipBlanks();
        if (at_ != text_.size())
        {
            fail("nothing more");
        }
        return value;
    }

private:
    [[noreturn]] void fail(const std::string& expected) const
    {
        throw std::invalid_argument(
            "in the formula '" + text_ + "', at character " + std::to_string(at_ + 1) + ": expected " + expected);
    }

    void skipBlanks()
    {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0)
        {
            ++at_;
        }
    }

    bool take(char wanted)
    {
        skipBlanks();
        const bool found = at_ < text_.size() && text_[at_] == wanted;
        at_ += found ? 1 : 0;
        return found;
    }

    Value sum()
    {
        Value left = product();
        while (true)
        {
            if (take('+'))
            {
                left = [left, right = product()](const auto& v) { return left(v) + right(v); };
            }
            else if (take('-'))
            {
                left = [left, right = product()](const auto& v) { return left(v) - right(v); };
            }
            else
            {
                return left;
            }
        }
    }

    Value product()
    {
        Value left = sign();
        while (true)
        {
            if (take('*'))
            {
                left = [left, right = sign()](const auto& v) { return left(v) * right(v); };
            }
            else if (take('/'))
            {
                left = [left, right = sign()](const auto& v) { return left(v) / right(v); };
            }
            else
            {
                return left;
            }
        }
    }

    Value sign()
    {
        if (take('-'))
        {
            return [value = sign()](const auto& v) { return -value(v); };
        }
        return take('+') ? sign() : power();
    }

    Value power()
    {
        Value base = atom();
        if (!take('^'))
        {
            return base;
        }
        return [base, exponent = sign()](const auto& v) { return std::pow(base(v), exponent(v)); };
    }

    Value atom()
    {
        if (take('('))
        {
            Value inner = sum();
            return take(')') ? inner : (fail("')'"), inner);
        }
        skipBlanks();
        if (at_ < text_.size() && (std::isdigit(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '.'))
        {
            return numberAtom();
        }
        const std::string name = word();
        return take('(') ? call(name) : variable(name);
    }

    Value numberAtom()
    {
        std::size_t length = 0;
        try
        {
            const double number = std::stod(text_.substr(at_), &length);
            at_ += length;
            return [number](const auto&) { return number; };
        }
        catch (const std::logic_error&)
        {
            fail("a number");
        }
    }

    std::string word()
    {
        const std::size_t begin = at_;
        while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_'))
        {
            ++at_;
        }
        if (begin == at_)
        {
            fail("a number, a name or '('");
        }
        return text_.substr(begin, at_ - begin);
    }

    Value variable(const std::string& name)
    {
        return [name, text = text_](const Expression::Variables& v) {
            const auto found = v.find(name);
            if (found == v.end())
            {
                std::string known;
                for (const auto& [each, value] : v)
                {
                    known += ' ' + each;
                }
                throw std::invalid_argument(
                    "in the formula '" + text + "': unknown name '" + name + "'; known:" + known);
            }
            return found->second;
        };
    }

    Value call(const std::string& name)
    {
        static const std::map<std::string, double (*)(double)> functions = {
            {"exp", [](double x) { return std::exp(x); }},
            {"round", [](double x) { return std::round(x); }},
            {"log", [](double x) { return std::log(x); }},
            {"sqrt", [](double x) { return std::sqrt(x); }},
            {"abs", [](double x) { return std::abs(x); }},
            {"sin", [](double x) { return std::sin(x); }},
            {"cos", [](double x) { return std::cos(x); }},
        };
        Value first = sum();
        if (name == "min" || name == "max")
        {
            if (!take(','))
            {
                fail("','");
            }
            first = [first, second = sum(), smaller = name == "min"](const auto& v) {
                return smaller ? std::min(first(v), second(v)) : std::max(first(v), second(v));
            };
        }
        else if (const auto found = functions.find(name); found != functions.end())
        {
            first = [first, function = found->second](const auto& v) { return function(first(v)); };
        }
        else
        {
            fail("one of exp log sqrt abs round sin cos min max, found '" + name + "'");
        }
        if (!take(')'))
        {
            fail("')'");
        }
        return first;
    }

    const std::string& text_;
    std::size_t at_ = 0;
};

} // namespace

Expression::Expression(std::string text)
    : text_(std::move(text)),
      root_(std::make_shared<const Node>(Node{Parser(text_).all()}))
{}

double Expression::operator()(const Variables& variables) const
{
    return root_->value(variables);
}

} // namespace clepsydra::identification
