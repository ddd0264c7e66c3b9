#include "tokens/nearestWord.h"

#include <gtest/gtest.h>

namespace clepsydra::tests
{

namespace
{

const std::vector<std::string> words{"voidFraction", "fluid", "U", "modelType", "voidFractionModel"};

/// One letter wrong, missing, too many, swapped with its neighbour, or of another size: each alone finds its word. A
/// comparison for equality finds none.
TEST(NearestWord, FindsMisspellings)
{
    EXPECT_EQ(nearestWord("voidfraction", words), "voidFraction");
    EXPECT_EQ(nearestWord("voidFracton", words), "voidFraction");
    EXPECT_EQ(nearestWord("voidFractionn", words), "voidFraction");
    EXPECT_EQ(nearestWord("fludi", words), "fluid");
    EXPECT_EQ(nearestWord("flaid", words), "fluid");
    EXPECT_EQ(nearestWord("modlTyp", words), "modelType");
}

/// What resembles nothing is given no neighbour: "T" is no misspelling of "U". The nearest at any distance would be.
TEST(NearestWord, IsEmptyForOtherWords)
{
    EXPECT_EQ(nearestWord("T", words), "");
    EXPECT_EQ(nearestWord("clockModel", words), "");
    EXPECT_EQ(nearestWord("", words), "");
    EXPECT_EQ(nearestWord("fluid", {}), "");
}

} // namespace

} // namespace clepsydra::tests
