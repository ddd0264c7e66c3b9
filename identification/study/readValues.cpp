#include "study/readValues.h"

#include "effects/measuringChain.h"
#include "tokens/didYouMean.h"

#include <cmath>

namespace clepsydra::identification
{

Expression readFormula(const YamlPlace& place)
{
    return checkedAt(place, [&] { return Expression(place.text()); });
}

double valueOf(const YamlPlace& place, const Expression& formula, const Expression::Variables& variables)
{
    const double value = checkedAt(place, [&] { return formula(variables); });
    place.failIf(!std::isfinite(value), "the formula '" + formula.text() + "' gives no finite number");
    return value;
}

std::pair<std::string, Expression> readChain(const YamlPlace& place)
{
    const auto operations = place.map();
    place.failIf(operations.size() != 1 || chainOperations().count(operations.front().first) == 0,
        "needs one operation, " + listed(namesOf(chainOperations()))
            + ", with the formula of its size, as in { gain: \"0.01*a\" }");
    return {operations.front().first, readFormula(operations.front().second)};
}

Entries ownEntries(const SimulatorSpecification& simulator)
{
    return readEntries(simulator.caseFolder / entriesFile);
}

Entries plainEntries(const SimulatorSpecification& simulator, const Condition& condition)
{
    Entries all = condition.entries;
    all.insert(simulator.entries.begin(), simulator.entries.end());
    all.merge(ownEntries(simulator));
    return all;
}

std::vector<std::string> missingEntries(const Effect& effect, const Entries& known)
{
    std::vector<std::string> missing = namesOf(effect.entries);
    append(missing, namesOf(effect.textEntries));
    eraseIf(missing, [&](const std::string& entry) { return known.count(entry) > 0; });
    return missing;
}

void requireEntry(const YamlPlace& place, const std::string& entry, const SimulatorSpecification& simulator)
{
    const Entries known = ownEntries(simulator);
    place.failIf(known.count(entry) == 0, "'" + entry + "': no such entry in "
                                              + (simulator.caseFolder / entriesFile).string()
                                              + didYouMean(entry, namesOf(known)));
}

void requireEntryValue(const YamlPlace& value)
{
    const std::string text = value.text();
    const bool isForbidden =
        text.find_first_of(";{}#`\"'\\|&<>\n\r") != std::string::npos || text.find("$(") != std::string::npos;
    value.failIf(isForbidden,
        "'" + text
            + "' is no value of an entry; allowed are numbers, words, or $name, without ; { } # ` | & < > $( quotes, "
              "backslashes or line breaks");
}

Entries readValues(const YamlPlace& place, const SimulatorSpecification& simulator)
{
    Entries values;
    for (const auto& [entry, value] : place.map())
    {
        requireEntryValue(value);
        requireEntry(value, entry, simulator);
        values[entry] = value.text();
    }
    return values;
}

} // namespace clepsydra::identification
