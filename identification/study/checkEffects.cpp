#include "study/readStudy.h"

#include "lists.h"
#include "study/readValues.h"
#include "tokens/didYouMean.h"

#include <algorithm>
#include <map>
#include <set>

namespace clepsydra::identification
{

namespace
{

/// An effect whose tag is misspelt acts in no condition, which would remain unnoticed.
void checkTags(const YamlPlace& conditions, const Study& study)
{
    std::map<std::string, std::set<std::string>> asked;
    for (const auto& effect : study.effects)
    {
        for (const auto& [tag, values] : effect.actsIn)
        {
            asked[tag].insert(values.begin(), values.end());
        }
    }
    for (const auto& [tag, values] : asked)
    {
        const auto without = numbersWhere(study.conditions.size(),
            [&, &tag = tag](std::size_t c) { return study.conditions[c].tags.count(tag) == 0; });
        std::vector<std::string> known;
        for (const auto& condition : study.conditions)
        {
            append(known, namesOf(condition.tags));
        }
        const std::string wrong = "some effects depend on the tag '" + tag + "', which ";
        const std::string near = without.empty() ? "" : didYouMean(tag, known);
        conditions.failIf(!without.empty() && without.size() < study.conditions.size(),
            wrong + "these conditions lack: "
                + listed(mapped(without, [&](std::size_t c) { return study.conditions[c].name; })));
        conditions.failIf(!near.empty(), wrong + "no condition has" + near);
    }
    for (const auto& condition : study.conditions)
    {
        for (const auto& [tag, value] : condition.tags)
        {
            const auto& values = asked[tag];
            const std::string near = values.count(value) == 0 ? didYouMean(value, {values.begin(), values.end()}) : "";
            conditions.failIf(!near.empty(), "condition '" + condition.name
                                                 + "': no effect acts in conditions whose tag '" + tag + "' is '"
                                                 + value + "'" + near);
        }
    }
}

/// A misspelt family would separate its effect from the other variants, which would remain unnoticed.
void checkFamilies(const YamlPlace& root, const Study& study)
{
    std::map<std::string, std::vector<std::string>> members;
    for (const auto& effect : study.effects)
    {
        members[effect.family].push_back(effect.name);
    }
    members.erase("");
    for (const auto& [family, effects] : members)
    {
        auto others = namesOf(members);
        others.erase(std::find(others.begin(), others.end(), family));
        const std::string near = didYouMean(family, others);
        root.failIf(effects.size() == 1 && !near.empty(),
            "effect '" + effects.front() + "' is the only one of the family '" + family + "'" + near);
    }
}

/// A parameter sets its entries after the simulator and the condition, whose values would be lost.
void checkOverridden(const YamlPlace& root, const Study& study)
{
    for (std::size_t p = 0; p < study.parameters.size(); ++p)
    {
        const Parameter& parameter = study.parameters[p];
        for (const auto& [entry, formula] : parameter.entries)
        {
            // If entry and parameter have the same name, the name in the formula means the parameter.
            const bool keeps = entry != parameter.name && formula.holds(entry);
            const YamlPlace place = root.at("parameters").list()[p].at("set").at(entry);
            const auto refuse = [&, &entry = entry](const Entries& set, const std::string& whose) {
                place.failIf(!keeps && set.count(entry) > 0,
                    "the value that " + whose
                        + " sets for the entry would be lost, because the formula does not contain it");
            };
            refuse(study.simulator.entries, "simulator.set");
            for (const auto& condition : study.conditions)
            {
                refuse(condition.entries, "condition '" + condition.name + "'");
            }
        }
    }
}

} // namespace

void checkEffects(const YamlPlace& root, const Study& study)
{
    checkOverridden(root, study);
    checkTags(root.at("conditions"), study);
    checkFamilies(root, study);
}

} // namespace clepsydra::identification
