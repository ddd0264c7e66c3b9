#include "study/measurements.h"

#include "curves/table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace clepsydra::identification
{

namespace
{

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

std::vector<double> converted(const Table& table, const ColumnSpecification& column)
{
    std::vector<double> values = table.columns[table.index(column.column)];
    for (double& value : values)
    {
        value = value * column.factor + column.offset;
        if (column.lowest < column.highest && (value < column.lowest || value > column.highest))
        {
            value = missing;
        }
    }
    return values;
}

void requireOrder(const Table& table, const std::vector<double>& time)
{
    double before = -std::numeric_limits<double>::infinity();
    for (std::size_t row = 0; row < time.size(); ++row)
    {
        if (time[row] < before)
        {
            throw std::runtime_error("in line " + std::to_string(table.lines[row])
                                     + " the time goes back; allowed are rows in order of time");
        }
        before = std::isfinite(time[row]) ? time[row] : before;
    }
}

/// Writes number of rows, ranges and features of a measured curve, by which users can check columns and units.
/// \return whether the curve has any of the features
bool sayContents(const Study& study, const Curve& curve, std::ostream& out)
{
    const auto [lowest, highest] = std::minmax_element(curve.value.begin(), curve.value.end());
    out << curve.time.size() << " rows, time " << textOf(curve.time.front()) << " to " << textOf(curve.time.back())
        << " s, value " << textOf(*lowest) << " to " << textOf(*highest) << " (SI units)";
    bool any = false;
    for (const auto& feature : study.features)
    {
        const double value = feature(curve);
        out << ", " << feature.name << ' ' << (std::isfinite(value) ? textOf(value) : "none");
        any = any || std::isfinite(value);
    }
    out << std::endl;
    return any;
}

} // namespace

Curve readMeasured(
    const std::filesystem::path& file, const ColumnSpecification& timeColumn, const ColumnSpecification& valueColumn)
{
    try
    {
        const Table table = readTable(file);
        std::vector<double> time = converted(table, timeColumn);
        requireOrder(table, time);
        Curve curve = tidied({std::move(time), converted(table, valueColumn)});
        if (curve.time.size() < 3)
        {
            throw std::runtime_error("fewer than three rows with a time and a value");
        }
        return curve;
    }
    catch (const std::exception& error)
    {
        const std::string text = error.what();
        throw std::runtime_error(text.rfind(file.string(), 0) == 0 ? text : file.string() + ": " + text);
    }
}

void checkMeasurements(const Study& study, std::ostream& out)
{
    for (const auto& condition : study.conditions)
    {
        bool any = condition.measured.files.empty() || !condition.measured.numbers.empty();
        for (const auto& file : condition.measured.files)
        {
            const Curve curve = readMeasured(file, condition.measured.time, condition.measured.value);
            out << condition.name << ", " << file.filename().string() << ": ";
            if (condition.role == Role::heldOut)
            {
                out << "can be read (held out: its values are not evaluated yet)" << std::endl;
                any = true;
                continue;
            }
            any = sayContents(study, curve, out) || any;
        }
        if (!any)
        {
            throw std::runtime_error(study.file.string() + ": the files of condition '" + condition.name
                                     + "' have none of the features. Are their columns and units right ('measured'), "
                                       "and the features within their ranges ('observable.features')?");
        }
    }
}

MeasuredCondition readMeasurements(const Study& study, std::size_t condition)
{
    const Measurement& measured = study.conditions[condition].measured;
    std::size_t repeats = measured.files.size();
    for (const auto& number : measured.numbers)
    {
        repeats = std::max(repeats, number.values.size());
    }
    MeasuredCondition result;
    result.features = Eigen::MatrixXd::Constant(repeats, study.featureCount(), missing);
    result.declaredError = Eigen::VectorXd::Zero(study.featureCount());
    for (std::size_t repeat = 0; repeat < measured.files.size(); ++repeat)
    {
        result.curves.push_back(readMeasured(measured.files[repeat], measured.time, measured.value));
        result.features.row(repeat) = Eigen::RowVectorXd::NullaryExpr(
            study.featureCount(), [&](Eigen::Index f) { return study.features[f](result.curves.back()); });
    }
    for (const auto& number : measured.numbers)
    {
        result.features.col(number.feature).setConstant(missing);
        result.features.col(number.feature).head(number.values.size()) =
            Eigen::Map<const Eigen::VectorXd>(number.values.data(), number.values.size());
        result.declaredError(number.feature) = number.standardError;
    }
    return result;
}

bool hasDeclaredErrors(const MeasuredCondition& measured)
{
    const auto known = measured.declaredError.array() > 0.0;
    return (known.transpose().replicate(measured.features.rows(), 1) || !measured.features.array().isFinite()).all();
}

Eigen::VectorXd meanFeatures(const Eigen::MatrixXd& repeats)
{
    const auto has = repeats.array().isFinite();
    const Eigen::ArrayXd count = has.cast<double>().colwise().sum();
    const Eigen::ArrayXd sum = has.select(repeats.array(), 0.0).colwise().sum();
    return (count > 0.0).select(sum / count, missing).matrix();
}

Eigen::MatrixXd shareOfMean(const Eigen::MatrixXd& repeats)
{
    const Eigen::MatrixXd has = repeats.array().isFinite().cast<double>();
    const Eigen::VectorXd count = has.colwise().sum().transpose().cwiseMax(1.0);
    return (has.transpose() * has).cwiseQuotient(count * count.transpose());
}

} // namespace clepsydra::identification
