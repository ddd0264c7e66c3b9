#pragma once

#include <Eigen/Core>

namespace clepsydra::identification
{

/// Two-level design with orthogonal columns: entries -1 and +1, one row per run, one column per factor. Plackett &
/// Burman, Biometrika 33, 305 (1946); powers of two by Sylvester's doubling. The smallest of 4, 8, 12, 16, 20, 24 and
/// 32 runs that has enough columns is taken. More than 31 factors are split over several designs, in each of which the
/// factors of the others are at -1.
Eigen::MatrixXd plackettBurman(Eigen::Index factors);

} // namespace clepsydra::identification
