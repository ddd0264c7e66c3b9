/// \file
/// EXPECT that two numbers agree to a relative tolerance: forces here span 1e-7 to 1e3.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#define EXPECT_RELATIVE(actual, expected, tolerance)                                                                   \
    EXPECT_NEAR(actual, expected, (tolerance)*std::abs(static_cast<double>(expected)))
