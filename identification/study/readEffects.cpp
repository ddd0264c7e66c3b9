#include "study/readParts.h"

#include "study/readValues.h"

#include <functional>
#include <stdexcept>
#include <tuple>

namespace clepsydra::identification
{

namespace
{

/// A formula in a switch would be written into the case as text, and all runs with it would fail.
void refuseFormula(const YamlPlace& place)
{
    const std::string text = place.text();
    bool isFormula = false;
    try
    {
        isFormula = text != "a" && Expression(text).holds("a");
    }
    catch (const std::invalid_argument&)
    {
        // The text is no formula.
    }
    if (isFormula)
    {
        place.fail(
            "'" + text
            + "' is a formula in the amplitude a, which a switch does not have; allowed is the value of the entry");
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
            effect.textEntries[entry] = value.text();
        }
        else
        {
            effect.entries.emplace(entry, readFormula(value));
        }
    }
}

Bounds readBounds(const YamlPlace& place)
{
    const auto [lower, upper] = place.range("[lower, upper]");
    if (lower > 0.0 || upper <= 0.0)
    {
        place.fail("must hold 0, where the effect is absent, and end above 0");
    }
    return {lower, upper};
}

Effect readEffect(const YamlPlace& place)
{
    place.allow({"name", "meaning", "hint", "family", "set", "chain", "amplitude", "measured", "switch", "scatter",
        "prior", "actsIn"});
    Effect effect;
    effect.name = place.at("name").text();
    effect.meaning = place.textOr("meaning", "");
    effect.hint = place.textOr("hint", "");
    effect.family = place.textOr("family", "");
    effect.isSwitch = place.flagOr("switch", false);
    effect.raisesScatter = place.flagOr("scatter", false);
    effect.prior = place.positiveOr("prior", 1.0);
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
        std::tie(effect.chainOperation, effect.chainSize) = readChain(place.at("chain"));
    }
    if (effect.raisesScatter && effect.isOfChain())
    {
        place.at("scatter").fail("the measuring chain is applied to each curve and does not scatter; allowed for an "
                                 "effect with 'set'");
    }
    if (place.has("amplitude"))
    {
        if (effect.isSwitch)
        {
            place.at("amplitude").fail("a switch has no amplitude; it is on or off");
        }
        effect.bounds = readBounds(place.at("amplitude"));
    }
    if (place.has("measured"))
    {
        const YamlPlace measured = place.at("measured");
        if (effect.isSwitch)
        {
            measured.fail("a switch has no amplitude that could be measured; it is on or off");
        }
        measured.allow({"mean", "sd"});
        effect.measured = Normal{measured.at("mean").number(), measured.at("sd").positive()};
        if (effect.measured->mean < effect.bounds.lower || effect.measured->mean > effect.bounds.upper)
        {
            measured.at("mean").fail("is an amplitude and must lie within the effect's range, "
                                     + textOf(effect.bounds.lower) + " to " + textOf(effect.bounds.upper));
        }
    }
    for (const auto& [tag, values] : place.optional("actsIn").map())
    {
        effect.actsIn[tag] = mapped(values.oneOrMore(), std::mem_fn(&YamlPlace::text));
    }
    return effect;
}

} // namespace

std::vector<Effect> readEffects(const YamlPlace& list)
{
    return readNamed(list, "effects", readEffect);
}

} // namespace clepsydra::identification
