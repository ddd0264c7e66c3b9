#pragma once

/// Eigen 5 has `all` in Eigen::placeholders alone; Eigen 3.4 has it in Eigen and calls the other place deprecated. CMake puts this
/// header before each file where Eigen is 5 or later.

#include <Eigen/Core>

namespace Eigen
{
using placeholders::all;
}
