/// \file
/// What a run writes as JSON is what the JSON library would write.

#include "tokens/jsonText.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>

namespace clepsydra::tests
{

/// Numbers of all magnitudes, with few and with many digits, in each form that JSON has for them: character by character as
/// the library writes them, and the very same number when read. With the digits of a stream, numbers come back changed.
TEST(JsonText, WritesNumbersAsTheLibraryDoes)
{
    for (const double digits : {1., 1.5, 1.25e-1, 9.999999999999999, 1. / 3, M_PI, 123456789012345., 7.})
    {
        for (int exponent = -30; exponent <= 30; ++exponent)
        {
            for (const double sign : {1., -1.})
            {
                const double number = sign * digits * std::pow(10., exponent);
                EXPECT_EQ(jsonText(number), nlohmann::json(number).dump());
                EXPECT_EQ(nlohmann::json::parse(jsonText(number)).get<double>(), number);
            }
        }
    }
    for (const double number :
        {0., -0., std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(),
            std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min()})
    {
        EXPECT_EQ(jsonText(number), nlohmann::json(number).dump());
    }
}

/// Objects of numbers, of objects, and empty ones: as the library writes them with two blanks for each level.
TEST(JsonText, WritesObjectsAsTheLibraryDoes)
{
    const std::map<std::string, double> seconds{{"forces", 0.25}, {"flow", 3}};
    JsonObject object;
    EXPECT_EQ(object.text(), nlohmann::ordered_json::object().dump(2));
    object.add("time", 0.1);
    object.add("particles", 20000);
    object.add("phaseSeconds", seconds);
    object.add("none", std::map<std::string, double>());
    const nlohmann::ordered_json expected = {
        {"time", 0.1}, {"particles", 20000}, {"phaseSeconds", seconds}, {"none", nlohmann::ordered_json::object()}};
    EXPECT_EQ(object.text(), expected.dump(2));
}

} // namespace clepsydra::tests
