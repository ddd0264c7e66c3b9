#pragma once

#include "study/study.h"

#include <Eigen/Core>

#include <ostream>
#include <vector>

namespace clepsydra::identification
{

/// The measurements of one condition.
struct MeasuredCondition
{
    Eigen::MatrixXd features;      // one repeat per row; NaN: missing
    Eigen::VectorXd declaredError; // standard error of the mean in addition to the scatter of repeats, by feature
    std::vector<Curve> curves;     // as measured, SI units
    bool isPlanned = false;        // not measured yet
};

/// The curve of one measured file. \throws std::runtime_error naming the file, and the column or row
Curve readMeasured(
    const std::filesystem::path& file, const ColumnSpecification& timeColumn, const ColumnSpecification& valueColumn);

/// Checks columns, numbers and order of times of all measured files before the first run. The number of rows, ranges
/// and features of training files are written to `out`; the values of held-out files are neither kept nor reported.
/// \throws std::runtime_error naming the file and the column or row, or a training condition that has none of the
/// features
void checkMeasurements(const Study& study, std::ostream& out);

/// Reads the measurements of one condition.
/// \throws std::runtime_error naming the file, and the column or row
MeasuredCondition readMeasurements(const Study& study, std::size_t condition);

/// Whether each measured feature has a declared error.
bool hasDeclaredErrors(const MeasuredCondition& measured);

/// Mean of each feature over the repeats that have it; NaN if none has it.
Eigen::VectorXd meanFeatures(const Eigen::MatrixXd& repeats);

/// Covariance of the means divided by the covariance of one repeat, element by element: n_ij/(n_i n_j), where n_ij
/// repeats have both features; 1/n if all n repeats are complete.
Eigen::MatrixXd shareOfMean(const Eigen::MatrixXd& repeats);

} // namespace clepsydra::identification
