#include "study/entriesOfRuns.h"

#include "words/didYouMean.h"

#include <algorithm>

namespace clepsydra::identification
{

Entries ownEntries(const RigSpecification& rig)
{
    return readEntries(rig.caseFolder / rig.entriesFile);
}

Entries plainEntries(const RigSpecification& rig, const Condition& condition)
{
    Entries all = condition.entries;
    all.insert(rig.entries.begin(), rig.entries.end());
    all.merge(ownEntries(rig));
    return all;
}

std::vector<std::string> missingEntries(const Effect& effect, const Entries& known)
{
    std::vector<std::string> missing = namesOf(effect.entries);
    const auto words = namesOf(effect.words);
    missing.insert(missing.end(), words.begin(), words.end());
    missing.erase(std::remove_if(
                      missing.begin(), missing.end(), [&](const std::string& entry) { return known.count(entry) > 0; }),
        missing.end());
    return missing;
}

void requireEntry(const YamlPlace& place, const std::string& entry, const RigSpecification& rig)
{
    const Entries known = ownEntries(rig);
    if (known.count(entry) == 0)
    {
        place.fail("'" + entry + "' is no such entry of " + (rig.caseFolder / rig.entriesFile).string()
                   + didYouMean(entry, namesOf(known)));
    }
}

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

Entries readValues(const YamlPlace& place, const RigSpecification& rig)
{
    Entries values;
    for (const auto& [entry, value] : place.map())
    {
        requireEntryValue(value);
        requireEntry(value, entry, rig);
        values[entry] = value.text();
    }
    return values;
}

} // namespace clepsydra::identification
