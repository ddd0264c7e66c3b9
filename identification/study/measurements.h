#pragma once

#include "study/study.h"

#include <Eigen/Core>

#include <ostream>
#include <vector>

namespace clepsydra::identification
{

/// The measured repeats of one condition.
struct MeasuredCondition
{
    Eigen::MatrixXd features;      // one repeat per row; NaN: missing
    Eigen::VectorXd declaredError; // standard error of the mean beyond the scatter of repeats, by feature
    std::vector<Curve> curves;     // as measured, SI
    bool isPlanned = false;        // not measured yet
};

/// The curve of one measured file. \throws std::runtime_error that names file, and column or row
Curve readMeasured(
    const std::filesystem::path& file, const ColumnSpecification& timeColumn, const ColumnSpecification& valueColumn);

/// Looks at every measured file before anything is run: its columns, numbers, and that time does not go back. Of training
/// files rows, range and features are reported. Of held-out ones the form alone is looked at: no value is kept or reported.
/// \throws std::runtime_error that names file, and column or row; or a training condition that has none of the features
void checkMeasurements(const Study& study, std::ostream& out);

/// Reads the measurements of one condition.
/// \throws std::runtime_error that names file, and column or row
MeasuredCondition readMeasurements(const Study& study, std::size_t condition);

/// Whether every number that was measured has a declared error.
bool hasDeclaredErrors(const MeasuredCondition& measured);

/// Mean over repeats, feature by feature; NaN where no repeat has it.
Eigen::VectorXd meanFeatures(const Eigen::MatrixXd& repeats);

/// Covariance of the means of the repeats over the covariance of one repeat, element by element: n_ij/(n_i n_j) with
/// n_ij repeats that have both features; 1/n for complete ones.
Eigen::MatrixXd shareOfMean(const Eigen::MatrixXd& repeats);

} // namespace clepsydra::identification
