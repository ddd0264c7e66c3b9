/// \file
/// What a run writes as JSON.

#include "tokens/jsonText.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <map>
#include <string>

namespace clepsydra::tests
{

/// Numbers with all their digits, integers as integers, what is not finite as null, objects inside, in the order given.
TEST(JsonText, KeepsOrderAndDigits)
{
    const std::string expected = "{\n  \"time\": 0.1,\n  \"particles\": 20000,\n  \"bytes\": 5000000000,\n"
                                 "  \"error\": 3.3333333333333335e-17,\n  \"lost\": null,\n"
                                 "  \"phaseSeconds\": {\n    \"flow\": 3.0,\n    \"forces\": 0.25\n  }\n}";
    EXPECT_EQ(jsonText({{"time", 0.1}, {"particles", 20000}, {"bytes", std::int64_t{5000000000}}, {"error", 1e-16 / 3},
                  {"lost", std::numeric_limits<double>::quiet_NaN()},
                  {"phaseSeconds", std::map<std::string, double>{{"forces", 0.25}, {"flow", 3}}}}),
        expected);
    EXPECT_EQ(jsonText({}), "{}");
}

} // namespace clepsydra::tests
