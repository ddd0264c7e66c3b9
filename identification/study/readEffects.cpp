#include "study/readStudy.h"

#include "study/readValues.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <stdexcept>
#include <tuple>

namespace clepsydra::identification
{

namespace
{

std::optional<Expression> formulaIn(const std::string& text)
{
    try
    {
        return Expression(text);
    }
    catch (const std::invalid_argument&)
    {
        return std::nullopt;
    }
}

void refuseAmplitude(const YamlPlace& place)
{
    const std::string text = place.text();
    const auto formula = formulaIn(text);
    place.failIf(
        text != "a" && formula && formula->holds("a"), "'" + text
                                                           + "' is a formula in the amplitude a, which a switch does "
                                                             "not have; allowed is the value of the entry, or a "
                                                             "formula in the case's entries");
}

/// Whether a text computes something from entries, as `hopperDiameter*2`; a number or a word does not.
bool computes(const std::string& text)
{
    return text.find_first_of("+*/(^") != std::string::npos
           && text.find_first_not_of("0123456789.+-eE") != std::string::npos && formulaIn(text);
}

void readEntries(const YamlPlace& place, Effect& effect)
{
    for (const auto& [entry, value] : place.map())
    {
        if (effect.isSwitch)
        {
            refuseAmplitude(value);
        }
        if (effect.isSwitch && !computes(value.text()))
        {
            requireEntryValue(value);
            effect.textEntries[entry] = value.text();
        }
        else
        {
            effect.entries.emplace(entry, readFormula(value));
        }
    }
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
    place.failIf(place.has("set") == place.has("chain"),
        "needs either 'set' (entries of the case) or 'chain' (the measuring chain)");
    readEntries(place.optional("set"), effect);
    if (place.has("chain"))
    {
        std::tie(effect.chainOperation, effect.chainSize) = readChain(place.at("chain"));
    }
    const auto holdsAmplitude = [](const auto& entry) { return entry.second.holds("a"); };
    place.failIf(!effect.isSwitch && !std::any_of(effect.entries.begin(), effect.entries.end(), holdsAmplitude)
                     && !(effect.chainSize && effect.chainSize->holds("a")),
        "no formula of effect '" + effect.name
            + "' contains its amplitude a; allowed is \"entry*(1 + 0.1*a)\", or 'switch: true' with fixed values");
    place.optional("scatter").failIf(effect.raisesScatter && effect.isOfChain(),
        "the measuring chain is applied to each curve and does not scatter; allowed for an effect with 'set'");
    auto& [lower, upper] = effect.bounds;
    if (place.has("amplitude"))
    {
        const YamlPlace amplitude = place.at("amplitude");
        amplitude.failIf(effect.isSwitch, "a switch has no amplitude; it is on or off");
        std::tie(lower, upper) = amplitude.range("[lower, upper]");
        amplitude.failIf(lower > 0.0 || upper <= 0.0, "must hold 0, where the effect is absent, and end above 0");
    }
    if (place.has("measured"))
    {
        const YamlPlace measured = place.at("measured");
        measured.failIf(effect.isSwitch, "a switch has no amplitude that could be measured; it is on or off");
        measured.allow({"mean", "sd"});
        const double mean = measured.at("mean").number();
        effect.measured = Normal{mean, measured.at("sd").positive()};
        measured.at("mean").failIf(mean < lower || mean > upper,
            "is an amplitude and must lie within the effect's range, " + textOf(lower) + " to " + textOf(upper));
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
