#include "effects/measuringChain.h"
#include "study/readStudy.h"

#include <algorithm>
#include <cctype>

namespace clepsydra::identification
{

namespace
{

Expression formula(const YamlPlace& place)
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

/// Whether the amplitude a stands in the text by itself, as it does in a formula.
bool namesTheAmplitude(const std::string& text)
{
    const auto isOfName = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
    };
    for (auto at = text.find('a'); at != std::string::npos; at = text.find('a', at + 1))
    {
        if ((at == 0 || !isOfName(text[at - 1])) && (at + 1 == text.size() || !isOfName(text[at + 1])))
        {
            return true;
        }
    }
    return false;
}

/// A word of a switch that is meant as a formula would reach the case as it stands, and every run with it would fail.
void refuseFormula(const YamlPlace& place)
{
    const std::string word = place.text();
    if (namesTheAmplitude(word) && word.find_first_of("+-*^") != std::string::npos)
    {
        place.fail("'" + word
                   + "' is a formula in the amplitude a, which a switch does not have; allowed: the value "
                     "that the entry is to have");
    }
}

void readEntries(const YamlPlace& place, Effect& effect)
{
    for (const auto& [entry, value] : place.map())
    {
        if (effect.isSwitch)
        {
            refuseFormula(value);
            requireEntryValue(value);
            effect.words[entry] = value.text();
        }
        else
        {
            effect.entries.emplace(entry, formula(value));
        }
    }
}

void readChain(const YamlPlace& place, Effect& effect)
{
    const auto operations = place.map();
    std::vector<std::string> known;
    for (const auto& [name, operation] : chainOperations())
    {
        known.push_back(name);
    }
    if (operations.size() != 1 || std::find(known.begin(), known.end(), operations.front().first) == known.end())
    {
        place.fail("needs one operation, " + listed(known) + ", with a formula in a: { gain: \"0.01*a\" }");
    }
    effect.chainOperation = operations.front().first;
    effect.chainSize = formula(operations.front().second);
}

Bounds readBounds(const YamlPlace& place)
{
    const auto ends = place.list();
    if (ends.size() != 2)
    {
        place.fail("must be [lower, upper]");
    }
    const Bounds bounds{ends[0].number(), ends[1].number()};
    if (!(bounds.lower <= 0.0 && bounds.upper > 0.0))
    {
        place.fail("must hold 0, where the effect is absent, and something above it");
    }
    return bounds;
}

Effect readEffect(const YamlPlace& place)
{
    place.allow({"name", "meaning", "hint", "set", "chain", "amplitude", "switch", "scatter", "family", "prior", "actsIn"});
    Effect effect;
    effect.name = place.at("name").text();
    effect.meaning = place.textOr("meaning", "");
    effect.hint = place.textOr("hint", "");
    effect.isSwitch = place.flagOr("switch", false);
    effect.raisesScatter = place.flagOr("scatter", false);
    effect.family = place.textOr("family", "");
    effect.prior = place.has("prior") ? place.at("prior").positive() : 1.0;
    if (place.has("set") == place.has("chain"))
    {
        place.fail("needs either 'set' (entries of the case) or 'chain' (the measuring chain)");
    }
    if (place.has("set"))
    {
        readEntries(place.at("set"), effect);
    }
    else
    {
        readChain(place.at("chain"), effect);
    }
    if (place.has("amplitude"))
    {
        if (effect.isSwitch)
        {
            place.at("amplitude").fail("a switch has none: it is on or off");
        }
        effect.bounds = readBounds(place.at("amplitude"));
    }
    if (place.has("actsIn"))
    {
        for (const auto& [tag, values] : place.at("actsIn").map())
        {
            for (const auto& value : values.oneOrMore())
            {
                effect.actsIn[tag].push_back(value.text());
            }
        }
    }
    return effect;
}

} // namespace

void requireEntryValue(const YamlPlace& value)
{
    const std::string text = value.text();
    const std::string forbidden = ";{}#`\"'\\|&<>\n\r";
    if (text.find_first_of(forbidden) != std::string::npos || text.find("$(") != std::string::npos)
    {
        value.fail("'" + text
                   + "' is no value of an entry; allowed is a number, words, or $name, without ; { } # ` | & < > "
                     "$( quotes, backslashes or line breaks");
    }
}

std::vector<Effect> readEffects(const YamlPlace& list)
{
    std::vector<Effect> effects;
    for (const auto& place : list.list())
    {
        effects.push_back(readEffect(place));
        const auto& name = effects.back().name;
        if (std::count_if(effects.begin(), effects.end(), [&](const Effect& e) { return e.name == name; }) > 1)
        {
            place.at("name").fail("there are two effects named '" + name + "'");
        }
    }
    return effects;
}

} // namespace clepsydra::identification
