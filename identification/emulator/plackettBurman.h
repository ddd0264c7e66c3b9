#pragma once

#include <Eigen/Core>

namespace clepsydra::identification
{

/// Two-level design with orthogonal columns: entries -1 and +1, one row per run, one column per factor.
/// Plackett & Burman, Biometrika 33, 305 (1946); the smallest of 4, 8, 12, 16, 20, 24 and 32 runs that holds the factors
/// (powers of two by Sylvester's doubling); a full column of +1 is left out. More factors: several such designs one after the other, the
/// factors of the others at -1.
Eigen::MatrixXd plackettBurman(Eigen::Index factors);

/// How many rows that has.
Eigen::Index plackettBurmanRuns(Eigen::Index factors);

} // namespace clepsydra::identification
