#include "couplingStep/dictionaryText.h"

#include "error.H"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace clepsydra
{

namespace
{

using namespace Foam;

/// OpenFOAM parses nested brackets by recursive calls, and its stack holds some thousands of them.
constexpr std::size_t deepest = 100;

/// OpenFOAM allocates the memory of the lists `1000(0 0 ...)` and `1000{0}` before it reads any entry.
constexpr double longestList = 1e6;

/// A key in quotes is a regular expression. std::regex tries all ways of matching it, in a time that grows with a power
/// of a word's length, and exponentially where a repeated group contains repetitions.
constexpr std::size_t longestPattern = 200;
constexpr std::ptrdiff_t mostChoices = 4;
const std::string repetitions = "*+?{";

/// A bracket or an #ifeq that has not been closed yet.
struct Opened
{
    std::string what;
    label line;
};

/// Scans the text once, token by token.
class TextCheck
{
public:
    TextCheck(const fileName& file, const std::string& text)
        : file_(file),
          text_(text)
    {}

    void all()
    {
        while (at_ < text_.size())
        {
            if (startsWith("//"))
            {
                skipTo("\n", "");
            }
            else if (startsWith("/*"))
            {
                skipTo("*/", "comment");
            }
            else if (startsWith("#{"))
            {
                skipTo("#}", "'#{'");
            }
            else if (text_[at_] == '"')
            {
                skipString();
            }
            else if (text_[at_] == '#')
            {
                directive();
            }
            else
            {
                character();
            }
        }
        if (!open_.empty())
        {
            refuse("'" + open_.back().what + "' is not closed", open_.back().line);
        }
    }

private:
    [[noreturn]] void refuse(const std::string& what, label line) const
    {
        FatalIOError(FUNCTION_NAME, __FILE__, __LINE__, file_, line) << what << exit(FatalIOError);
        std::abort(); // not reached, but exit() is not declared [[noreturn]]
    }

    bool startsWith(const std::string& part) const
    {
        return text_.compare(at_, part.size(), part) == 0;
    }

    void step(std::size_t end)
    {
        line_ += static_cast<label>(std::count(
            text_.begin() + static_cast<std::ptrdiff_t>(at_), text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
        at_ = end;
    }

    /// \param what  name for the error where the text ends first; empty where it may end
    void skipTo(const std::string& end, const std::string& what)
    {
        const auto found = text_.find(end, at_ + 2);
        if (found == std::string::npos && !what.empty())
        {
            refuse("A " + what + " is not closed; allowed: text in which each has its end", line_);
        }
        step(found == std::string::npos ? text_.size() : found + end.size());
    }

    void skipString()
    {
        std::size_t end = at_ + 1;
        while (end < text_.size() && text_[end] != '"')
        {
            end += text_[end] == '\\' ? 2 : 1;
        }
        if (end >= text_.size())
        {
            refuse("A '\"' is not closed", line_);
        }
        if (keyComes_ || isDirectiveLine_)
        {
            refuseEndlessPattern(text_.substr(at_ + 1, end - at_ - 1));
        }
        keyComes_ = isDirectiveLine_;
        step(end + 1);
    }

    void refuseEndlessPattern(const std::string& pattern) const
    {
        const auto choices = std::count_if(pattern.begin(), pattern.end(),
            [](char c) { return c == '|' || repetitions.find(c) != std::string::npos; });
        bool repeatsGroup = false;
        for (auto at = pattern.find(')'); at < pattern.size(); at = pattern.find(')', at + 1))
        {
            repeatsGroup =
                repeatsGroup || (at + 1 < pattern.size() && repetitions.find(pattern[at + 1]) != std::string::npos);
        }
        if (repeatsGroup || choices > mostChoices || pattern.size() > longestPattern)
        {
            refuse("The pattern \"" + pattern.substr(0, longestPattern)
                       + "\" may take unbounded time to match; allowed: up to " + std::to_string(longestPattern)
                       + " characters, no '*', '+', '?' or '{' after a ')', and up to " + std::to_string(mostChoices)
                       + " of these and '|' in total",
                line_);
        }
    }

    void directive()
    {
        std::size_t end = at_ + 1;
        while (end < text_.size() && std::isalpha(static_cast<unsigned char>(text_[end])) != 0)
        {
            ++end;
        }
        const std::string word = text_.substr(at_, end - at_);
        isDirectiveLine_ = isDirectiveLine_ || keyComes_;
        if (word == "#if" || word == "#ifeq")
        {
            open(word);
        }
        else if (word.find("include") != std::string::npos)
        {
            refuseSelfInclusion(end);
        }
        else if (word == "#else" || word == "#elif" || word == "#endif")
        {
            if (open_.empty() || open_.back().what.front() != '#')
            {
                refuse("'" + word + "' without an #if or #ifeq between the same brackets", line_);
            }
            if (word == "#endif")
            {
                open_.pop_back();
            }
        }
        step(end);
    }

    /// \param end  position after the word #include
    void refuseSelfInclusion(std::size_t end) const
    {
        const std::string blanks = " \t\r\n";
        auto begin = std::min(text_.find_first_not_of(blanks, end), text_.size());
        const bool quoted = begin < text_.size() && text_[begin] == '"';
        begin += quoted ? 1 : 0;
        string name = text_.substr(begin, text_.find_first_of(quoted ? "\"" : blanks + ';', begin) - begin);
        // Expands the name as OpenFOAM does, except for entries of the file itself, whose values are not known here.
        name.expand(true);
        std::error_code notThere;
        if (std::filesystem::equivalent(
                std::filesystem::path(file_.path().c_str()) / name.c_str(), file_.c_str(), notThere))
        {
            refuse("The file includes itself", line_);
        }
    }

    /// Refuses a number directly before an opening bracket that states too long a list.
    void refuseLongList() const
    {
        const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
        auto end = at_;
        while (end > 0 && std::isspace(static_cast<unsigned char>(text_[end - 1])) != 0)
        {
            --end;
        }
        auto begin = end;
        while (begin > 0 && isDigit(text_[begin - 1]))
        {
            --begin;
        }
        if (begin < end && std::strtod(text_.substr(begin, end - begin).c_str(), nullptr) > longestList)
        {
            refuse("A list states " + text_.substr(begin, end - begin) + " entries; allowed: up to a million", line_);
        }
    }

    void character()
    {
        const char c = text_[at_];
        const auto code = static_cast<unsigned char>(c);
        if (code > '~' || (code < ' ' && std::isspace(code) == 0))
        {
            refuse("The character with the code " + std::to_string(code)
                       + " is not plain text; allowed outside comments and strings: printable ASCII",
                line_);
        }
        if (c == '(' || c == '{' || c == '[')
        {
            refuseLongList();
            open({c});
        }
        else if (c == ')' || c == '}' || c == ']')
        {
            const std::string opening = c == ')' ? "(" : c == '}' ? "{" : "[";
            if (open_.empty() || open_.back().what != opening)
            {
                refuse("'" + std::string{c} + "' has no opening bracket"
                           + (open_.empty() ? "" : "; '" + open_.back().what + "' is open"),
                    line_);
            }
            open_.pop_back();
        }
        followKeys(c);
        step(at_ + 1);
    }

    void followKeys(char c)
    {
        if (c == '\n' && isDirectiveLine_)
        {
            keyComes_ = true;
            isDirectiveLine_ = false;
        }
        else if (std::isspace(static_cast<unsigned char>(c)) == 0)
        {
            keyComes_ = c == ';' || c == '{' || c == '}';
        }
    }

    void open(const std::string& what)
    {
        open_.push_back({what, line_});
        if (open_.size() > deepest)
        {
            refuse("'" + what + "' is nested more than " + std::to_string(deepest) + " deep", line_);
        }
    }

    const fileName& file_;
    const std::string& text_;
    std::size_t at_ = 0;
    label line_ = 1;
    std::vector<Opened> open_;
    bool keyComes_ = true;
    bool isDirectiveLine_ = false; // an #include or #ifeq in place of a key, which a key may follow
};

} // namespace

void checkDictionaryText(const fileName& file)
{
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    TextCheck(file, text).all();
}

} // namespace clepsydra
