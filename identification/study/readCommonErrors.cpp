#include "study/readStudy.h"

#include "study/readValues.h"
#include "tokens/didYouMean.h"

#include <tuple>

namespace clepsydra::identification
{

namespace
{

std::vector<std::size_t> chosenConditions(const YamlPlace& place, const Study& study)
{
    if (!place.has("conditions"))
    {
        return numbersWhere(study.conditions.size(), [](std::size_t) { return true; });
    }
    std::vector<std::size_t> chosen;
    for (const auto& each : place.at("conditions").oneOrMore())
    {
        const std::size_t condition = indexOf(each, study.conditions);
        each.failIf(contains(chosen, condition), "lists the condition '" + each.text() + "' twice");
        chosen.push_back(condition);
    }
    place.at("conditions").failIf(chosen.empty(), "needs at least one");
    return chosen;
}

/// Requires that a formula gives the unchanged value at z = 0 and another one at z = 1.
void checkAtZero(const YamlPlace& place, const Expression& formula, Expression::Variables variables, double itself)
{
    const auto at = [&](double z) {
        variables["z"] = z;
        return valueOf(place, formula, variables);
    };
    const double there = at(0.0);
    place.failIf(!isUnchanged(there, itself), "gives " + textOf(there) + " at z = 0 (no error), but must give "
                                                  + textOf(itself) + " there, as in \"particleDiameter*(1 + 0.01*z)\"");
    place.failIf(
        at(1.0) == there, "must contain z, the error in standard deviations, as in \"particleDiameter*(1 + 0.01*z)\"");
}

void readEntries(const YamlPlace& place, const Study& study, CommonError& error)
{
    for (const auto& [entry, value] : place.map())
    {
        const Expression formula = readFormula(value);
        for (const auto condition : error.conditions)
        {
            const auto numbers = numbersOf(plainEntries(study.simulator, study.conditions[condition]));
            const auto itself = numbers.find(entry);
            value.failIf(itself == numbers.end(),
                "the case has no entry '" + entry + "' that is a number" + didYouMean(entry, namesOf(numbers)));
            checkAtZero(value, formula, numbers, itself->second);
        }
        error.entries.emplace(entry, formula);
    }
}

/// An effect whose amplitude was measured to `sd`.
void readGauged(const YamlPlace& place, const Study& study, CommonError& error)
{
    const Effect& effect = study.effects[indexOf(place.at("effect"), study.effects)];
    const std::string reason = effect.isSwitch        ? "is on or off"
                               : effect.raisesScatter ? "changes the scatter, which no error does"
                               : effect.measured      ? "has a measured amplitude ('measured')"
                                                      : "";
    place.at("effect").failIf(
        !reason.empty(), "names an effect that " + reason
                             + "; allowed are effects with a formula in a and without 'scatter' or 'measured'");
    error.name = place.textOr("name", effect.name);
    error.variable = "a";
    error.unit = place.at("sd").positive();
    error.entries = effect.entries;
    error.chainOperation = effect.chainOperation;
    error.chainSize = effect.chainSize;
    if (!place.has("conditions"))
    {
        error.conditions =
            numbersWhere(study.conditions.size(), [&](std::size_t c) { return acts(effect, study.conditions[c]); });
    }
}

CommonError readError(const YamlPlace& place, const Study& study)
{
    place.allow({"name", "meaning", "conditions", "each", "set", "chain", "effect", "sd"});
    CommonError error;
    place.textOr("meaning", ""); // for readers of the file
    error.conditions = chosenConditions(place, study);
    place.failIf(place.has("set") + place.has("chain") + place.has("effect") != 1,
        "needs one of 'set' (entries of the case), 'chain' (the measuring chain) or 'effect' (of the library, measured "
        "with a gauge)");
    if (place.has("effect"))
    {
        readGauged(place, study, error);
        return error;
    }
    place.failIf(place.has("sd"), "has 'sd', which goes with 'effect' only");
    error.name = place.at("name").text();
    readEntries(place.optional("set"), study, error);
    if (place.has("chain"))
    {
        std::tie(error.chainOperation, error.chainSize) = readChain(place.at("chain"));
        checkAtZero(place.at("chain"), *error.chainSize, {}, 0.0);
    }
    place.failIf(
        error.entries.empty() && error.chainOperation.empty(), "changes nothing; 'set' needs at least one key");
    return error;
}

} // namespace

void readCommonErrors(const YamlPlace& list, Study& study)
{
    std::vector<CommonError>& errors = study.commonErrors;
    for (const auto& place : list.list())
    {
        const CommonError error = readError(place, study);
        if (!place.flagOr("each", false))
        {
            errors.push_back(error);
        }
        else
        {
            for (const auto condition : error.conditions)
            {
                errors.push_back(error);
                errors.back().name += " of " + study.conditions[condition].name;
                errors.back().conditions = {condition};
            }
        }
        requireOwnName(place, errors, "common errors");
    }
    for (const auto& place : list.list())
    {
        eraseIf(study.effects, [&](const Effect& effect) { return effect.name == place.textOr("effect", ""); });
    }
}

} // namespace clepsydra::identification
