#include "knownEntries.h"

#include "FlatOutput.H"
#include "HashSet.H"
#include "IStringStream.H"
#include "OSspecific.H"
#include "Pstream.H"
#include "tokens/didYouMean.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// File that a dictionary, or the dictionary that contains it, was read from; empty where there is none.
fileName fileOf(const dictionary& dict)
{
    std::string name = dict.name();
    while (!name.empty() && !isFile(fileName(name)))
    {
        const std::size_t end = name.find_last_of("./:");
        name.erase(end == std::string::npos ? 0 : end);
    }
    return name;
}

std::string textOf(const fileName& file)
{
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// Written by hand because std::regex overflows the stack on lines of some 100 kB.

bool isOfWord(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Names that a text refers to as `$name`, `${name}` or `$scope.name`.
std::set<std::string> macrosIn(const std::string& text)
{
    std::set<std::string> words;
    for (auto at = std::find(text.begin(), text.end(), '$'); at != text.end(); at = std::find(at, text.end(), '$'))
    {
        ++at;
        while (at != text.end() && (isOfWord(*at) || *at == '{' || *at == ':' || *at == '.'))
        {
            const auto end = std::find_if_not(at, text.end(), isOfWord);
            if (end != at)
            {
                words.emplace(at, end);
            }
            at = end == at ? at + 1 : end;
        }
    }
    return words;
}

/// Whether a line is a directive such as #include or #ifeq, and not an entry.
bool isDirective(const std::string& line)
{
    const auto at = line.find_first_not_of(" \t");
    const std::vector<std::string> directives = {
        "#include", "#sinclude", "#if", "#else", "#endif", "#remove", "#inputMode"};
    return at != std::string::npos
           && std::any_of(directives.begin(), directives.end(),
               [&](const std::string& directive) { return line.compare(at, directive.size(), directive) == 0; });
}

/// Keywords in the file itself, without those of files that it includes.
wordHashSet keywordsIn(const std::string& text)
{
    std::istringstream lines(text);
    std::string entries;
    for (std::string line; std::getline(lines, line);)
    {
        entries += isDirective(line) ? "\n" : line + '\n';
    }
    const int before = entry::disableFunctionEntries;
    entry::disableFunctionEntries = 1;
    IStringStream stream(entries);
    const dictionary raw(stream);
    entry::disableFunctionEntries = before;
    return wordHashSet(raw.toc());
}

/// Whether a name is among the known ones; also true where the name is a pattern, such as ".*DragProps", that matches
/// one.
bool isAmong(const keyType& name, const wordList& names)
{
    return std::any_of(names.begin(), names.end(), [&](const word& known) { return name.match(known); });
}

} // namespace

std::string didYouMean(const std::string& word, const wordList& known)
{
    return didYouMean(word, std::vector<std::string>(known.begin(), known.end()));
}

wordList functionObjectEntries(const wordList& own)
{
    wordList all(own);
    all.append(wordList({"type", "libs", "functionObjectLibs", "enabled", "log", "region", "timeStart", "timeEnd",
        "nStepsToStartTimeChange", "controlMode", "triggerStart", "triggerEnd", "executeControl", "executeInterval",
        "writeControl", "writeInterval", "outputControl", "outputInterval", "writePrecision", "writeToFile",
        "useUserTime"}));
    return all;
}

void requireKnownEntries(const dictionary& dict, const wordList& values, const wordList& dictionaries)
{
    if (!Pstream::master())
    {
        return;
    }
    const fileName file = fileOf(dict);
    const std::string text = textOf(file);
    const std::set<std::string> macros = macrosIn(text);
    const bool mayInclude = !file.empty() && file == dict.name();
    const wordHashSet own = mayInclude ? keywordsIn(text) : wordHashSet();
    wordList known(values);
    known.append(dictionaries);
    string faults;
    for (const entry& item : dict)
    {
        const keyType& name = item.keyword();
        if (!isAmong(name, known))
        {
            const bool helps = macros.count(name) > 0 || (mayInclude && !own.found(name));
            faults += helps ? "" : "Entry '" + name + "' is unknown" + didYouMean(name, known) + '\n';
        }
        else if (!isAmong(name, item.isDict() ? dictionaries : values))
        {
            faults += "Entry '" + name + "' is a " + (item.isDict() ? "dictionary" : "value") + "; allowed: a "
                      + (item.isDict() ? "value" : "dictionary") + '\n';
        }
    }
    if (!faults.empty())
    {
        FatalIOErrorInFunction(dict) << faults.c_str() << "allowed: " << flatOutput(known) << exit(FatalIOError);
    }
}

} // namespace clepsydra
