#include "study/measurements.h"

#include "curves/table.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

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

Curve readFile(const std::filesystem::path& file, const Measurement& measured)
{
    try
    {
        const Table table = readTable(file);
        Curve curve = tidied({converted(table, measured.time), converted(table, measured.value)});
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

} // namespace

MeasuredCondition readMeasurements(const Study& study, std::size_t condition)
{
    const Measurement& measured = study.conditions[condition].measured;
    std::size_t repeats = measured.files.size();
    for (const auto& number : measured.numbers)
    {
        repeats = std::max(repeats, number.values.size());
    }
    MeasuredCondition result;
    result.features = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(repeats), study.featureCount(), missing);
    result.declaredError = Eigen::VectorXd::Zero(study.featureCount());
    for (std::size_t repeat = 0; repeat < measured.files.size(); ++repeat)
    {
        result.curves.push_back(readFile(measured.files[repeat], measured));
        for (std::size_t f = 0; f < study.features.size(); ++f)
        {
            result.features(static_cast<Eigen::Index>(repeat), static_cast<Eigen::Index>(f)) =
                study.features[f](result.curves.back());
        }
    }
    for (const auto& number : measured.numbers)
    {
        const auto f = static_cast<Eigen::Index>(number.feature);
        result.features.col(f).setConstant(missing);
        for (std::size_t repeat = 0; repeat < number.values.size(); ++repeat)
        {
            result.features(static_cast<Eigen::Index>(repeat), f) = number.values[repeat];
        }
        result.declaredError(f) = number.standardError;
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
    Eigen::VectorXd mean(repeats.cols());
    for (Eigen::Index f = 0; f < repeats.cols(); ++f)
    {
        const auto finite = repeats.col(f).array().isFinite();
        mean(f) = finite.any() ? finite.select(repeats.col(f).array(), 0.0).sum() / static_cast<double>(finite.count())
                               : missing;
    }
    return mean;
}

Eigen::MatrixXd shareOfMean(const Eigen::MatrixXd& repeats)
{
    const Eigen::MatrixXd has = repeats.array().isFinite().cast<double>();
    const Eigen::VectorXd count = has.colwise().sum().transpose().cwiseMax(1.0);
    return (has.transpose() * has).cwiseQuotient(count * count.transpose());
}

} // namespace clepsydra::identification
