#include "study/readStudy.h"

#include "curves/table.h"
#include "study/readValues.h"
#include "study/units.h"
#include "tokens/didYouMean.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace clepsydra::identification
{

namespace
{

Feature readFeature(const YamlPlace& place, std::vector<std::string>& furtherColumns)
{
    const FeatureKind& kind = featureKinds().at(place.at("kind").oneOf(namesOf(featureKinds())));
    std::vector<std::string> allowed = {"name", "kind", "value", "modelError"};
    append(allowed, namesOfItems(kind.parameters));
    place.allow(allowed);
    Feature feature{place.textOr("name", kind.name), &kind, {}};
    for (const auto& parameter : kind.parameters)
    {
        place.failIf(std::isnan(parameter.byDefault) && !place.has(parameter.name),
            "a " + kind.name + " needs '" + parameter.name + "': " + parameter.meaning);
        feature.parameters[parameter.name] = place.numberOr(parameter.name, parameter.byDefault);
    }
    if (place.has("value"))
    {
        const std::string column = place.at("value").text();
        if (!contains(furtherColumns, column))
        {
            furtherColumns.push_back(column);
        }
        feature.column = std::find(furtherColumns.begin(), furtherColumns.end(), column) - furtherColumns.begin();
    }
    return feature;
}

/// A unit and its size in SI units.
std::pair<std::string, double> readUnit(const YamlPlace& place)
{
    return {place.text(), checkedAt(place, [&] { return siUnitsPer(place.text()); })};
}

/// Values are converted to SI units first, then multiplied by `factor`, then shifted by `offset` (SI units).
ColumnSpecification readColumn(const YamlPlace& place)
{
    place.allow({"column", "unit", "factor", "offset", "valid"});
    ColumnSpecification column;
    column.column = place.at("column").text();
    std::tie(column.unit, column.siUnits) = readUnit(place.at("unit"));
    column.factor = column.siUnits * place.numberOr("factor", 1.0);
    column.offset = place.numberOr("offset", 0.0);
    if (place.has("valid"))
    {
        std::tie(column.lowest, column.highest) = place.at("valid").range("[lowest, highest], in SI units");
    }
    return column;
}

/// Requires a unit of what a feature measures. An observable may have any but a time.
void requireUnitOf(const YamlPlace& unit, const FeatureKind& kind)
{
    const std::string quantity = quantityOf(unit.text());
    const bool isRate = quantity == "speed" || quantity.find("rate") != std::string::npos;
    const auto require = [&](bool isRight, const std::string& allowed) {
        unit.failIf(!isRight, "'" + unit.text() + "' is no unit of " + kind.name + "; allowed are units of " + allowed);
    };
    switch (kind.dimension)
    {
        case Dimension::share:
            return require(quantity == "share", "a share, as 1 or %");
        case Dimension::time:
            return require(quantity == "time", "time, as s");
        case Dimension::rate:
            return require(isRate, "a rate, as g/s or m/s");
        case Dimension::value:
            return require(quantity != "time", "the observable, as g or m/s");
    }
}

MeasuredNumber readNumber(const YamlPlace& place, const Study& study)
{
    place.allow({"feature", "values", "unit", "relativeError", "standardError"});
    MeasuredNumber number;
    number.feature = indexOf(place.at("feature"), study.features);
    std::tie(number.unit, number.siUnits) = readUnit(place.at("unit"));
    const bool isLog = study.features[number.feature].kind->isLog();
    requireUnitOf(place.at("unit"), *study.features[number.feature].kind);
    const auto values = place.at("values").oneOrMore();
    place.at("values").failIf(values.empty(), "needs at least one number");
    for (const auto& value : values)
    {
        number.values.push_back(isLog ? std::log(value.positive() * number.siUnits) : value.number() * number.siUnits);
    }
    number.standardError =
        isLog ? place.numberOr("relativeError", 0.0) : place.numberOr("standardError", 0.0) * number.siUnits;
    place.failIf(number.standardError < 0.0, "has an error below 0");
    place.failIf(place.has(isLog ? "standardError" : "relativeError"),
        isLog ? "the feature is a logarithm; its error must be given as relativeError"
              : "the feature is no logarithm; its error must be given as standardError");
    return number;
}

Measurement readMeasurement(const YamlPlace& place, const Study& study, const YamlPlace& root)
{
    place.allow({"files", "time", "value", "numbers"});
    Measurement measured;
    if (place.has("files"))
    {
        for (const auto& file : place.at("files").oneOrMore())
        {
            measured.files.push_back(file.path());
            file.failIf(!std::filesystem::is_regular_file(file.path()), "no such file: " + file.path().string());
        }
        const auto column = [&](const std::string& key) {
            const auto ofAll = root.optional("measured");
            return readColumn(!place.has(key) && ofAll.has(key) ? ofAll.at(key) : place.at(key));
        };
        measured.time = column("time");
        measured.value = column("value");
    }
    std::set<std::size_t> features;
    for (const auto& number : place.optional("numbers").list())
    {
        measured.numbers.push_back(readNumber(number, study));
        number.at("feature").failIf(!features.insert(measured.numbers.back().feature).second,
            "given twice; all values of a feature belong into one item");
    }
    place.failIf(measured.empty(), "needs 'files' or 'numbers'");
    return measured;
}

/// Factor and offset of the condition itself or, without these, of the study. Both are evaluated with the condition's
/// entries as a check.
ObservableScale readScale(
    const YamlPlace& root, const YamlPlace& place, const SimulatorSpecification& simulator, const Condition& condition)
{
    const auto own = place.optional("observable");
    own.allow({"factor", "offset"});
    const auto numbers = numbersOf(plainEntries(simulator, condition));
    const auto read = [&](const std::string& key, Expression& formula) {
        const YamlPlace parent = own.has(key) ? own : root.at("observable");
        if (parent.has(key))
        {
            formula = readFormula(parent.at(key));
            const double value = valueOf(parent.at(key), formula, numbers);
            parent.at(key).failIf(value == 0.0 && key == "factor", "must not be 0");
        }
    };
    ObservableScale scale;
    read("factor", scale.factor);
    read("offset", scale.offset);
    return scale;
}

Condition readCondition(const YamlPlace& place, const Study& study, const YamlPlace& root)
{
    place.allow({"name", "role", "set", "tags", "coordinates", "command", "file", "observable", "measured", "cost"});
    Condition condition;
    condition.name = place.at("name").text();
    // In the sequence of Role.
    condition.role = static_cast<Role>(place.at("role").indexIn({"training", "heldOut", "candidate"}));
    condition.command = place.textOr("command", "");
    condition.file = place.textOr("file", root.at("observable").at("file").text());
    condition.cost = place.positiveOr("cost", 1.0);
    condition.entries = readValues(place.optional("set"), study.simulator);
    place.optional("set").failIf(study.simulator.scatters() && condition.entries.count(study.simulator.seedEntry) > 0,
        "sets '" + study.simulator.seedEntry + "', the seed, which differs from run to run; allowed are other entries");
    condition.observable = readScale(root, place, study.simulator, condition);
    for (const auto& [tag, value] : place.optional("tags").map())
    {
        condition.tags[tag] = value.text();
    }
    for (const auto& [name, value] : place.optional("coordinates").map())
    {
        condition.coordinates[name] = value.number();
    }
    if (place.has("measured"))
    {
        place.at("measured")
            .failIf(condition.role == Role::candidate, "is not allowed, because a candidate has not been measured yet; "
                                                       "allowed with role: training or heldOut");
        condition.measured = readMeasurement(place.at("measured"), study, root);
    }
    return condition;
}

/// Whether two names, or a name and a number, mean one column of a file.
bool isSameColumn(const std::filesystem::path& file, const std::string& one, const std::string& other)
{
    if (one == other)
    {
        return true;
    }
    try
    {
        const Table table = readTable(file);
        return table.index(one) == table.index(other);
    }
    catch (const std::runtime_error&)
    {
        return false; // the measurement itself is read later, with an error that says more
    }
}

/// The same measurement must not count twice, and must not be both training and held-out.
void requireDifferentMeasurements(const YamlPlace& root, const Study& study)
{
    struct Owner
    {
        std::string condition;
        std::string column;
    };
    std::map<std::pair<std::filesystem::path, double>, std::vector<Owner>> ownersOf;
    for (std::size_t c = 0; c < study.conditions.size(); ++c)
    {
        const auto& [name, measured] = std::tie(study.conditions[c].name, study.conditions[c].measured);
        for (const auto& file : measured.files)
        {
            const std::string& column = measured.value.column;
            const YamlPlace place = root.at("conditions").list()[c].at("measured").at("files");
            // Parts of one record are distinguished by the valid times.
            auto& owners = ownersOf[{std::filesystem::canonical(file), measured.time.lowest}];
            for (const auto& owner : owners)
            {
                place.failIf(isSameColumn(file, column, owner.column),
                    "condition '" + name + "' has " + file.string() + " with its column " + column
                        + ", which condition '" + owner.condition + "' has already; a measurement may be given once");
            }
            owners.push_back({name, column});
        }
    }
}

/// The Gaussian process of control 2 needs the same coordinates in all conditions.
void requireEqualCoordinates(const YamlPlace& root, const Study& study)
{
    const auto first = std::find_if(study.conditions.begin(), study.conditions.end(),
        [](const Condition& condition) { return !condition.coordinates.empty(); });
    for (const auto& condition : study.conditions)
    {
        const auto names = namesOf(condition.coordinates);
        const bool mayLack = first == study.conditions.end() || condition.role == Role::candidate;
        if (names.empty() ? !mayLack : names != namesOf(first->coordinates))
        {
            root.at("conditions")
                .fail("condition '" + condition.name + "' has "
                      + (names.empty() ? "no coordinates" : "the coordinates ") + listed(names) + ", condition '"
                      + first->name + "' " + listed(namesOf(first->coordinates))
                      + "; all conditions must have the same coordinates");
        }
    }
}

} // namespace

void readObservable(const YamlPlace& place, Study& study)
{
    place.allow({"file", "time", "value", "factor", "offset", "features", "modelError"});
    study.timeColumn = place.textOr("time", "time");
    study.valueColumn = place.at("value").text();
    study.features = readNamed(place.at("features"), "features",
        [&](const YamlPlace& each) { return readFeature(each, study.furtherColumns); });
    place.at("features").failIf(study.features.empty(), "needs at least one");
    const auto features = place.at("features").list();
    study.modelError = Eigen::VectorXd::NullaryExpr(study.featureCount(),
        [&](Eigen::Index f) { return features[f].numberOr("modelError", place.numberOr("modelError", 0.0)); });
    place.failIf((study.modelError.array() < 0.0).any(), "has a modelError below 0");
}

void readConditions(const YamlPlace& root, Study& study)
{
    root.optional("measured").allow({"time", "value"});
    study.conditions = readNamed(
        root.at("conditions"), "conditions", [&](const YamlPlace& place) { return readCondition(place, study, root); });
    root.at("conditions")
        .failIf(study.conditionsOf(Role::training).empty(), "at least one condition needs 'role: training'");
    requireDifferentMeasurements(root, study);
    requireEqualCoordinates(root, study);
}

} // namespace clepsydra::identification
