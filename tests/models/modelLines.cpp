/// \file
/// Every model that can be chosen is reported by -listModels, and nothing that is reported is unknown to the program.

#include "distribution/smoothingModel.h"
#include "distribution/voidFractionModel.h"
#include "forces/forceModel.h"
#include "modelLines.h"

#include "functionObject.H"

#include <gtest/gtest.h>

#include <set>

namespace
{

using namespace clepsydra;

std::set<std::string> reported(const std::string& entry)
{
    std::set<std::string> names;
    for (const auto& [name, line] : ModelLines::all().at(entry))
    {
        names.insert(name);
    }
    return names;
}

std::set<std::string> selectable(const Foam::wordList& names)
{
    return {names.begin(), names.end()};
}

TEST(ModelLines, TellEachForceAndNoOther)
{
    EXPECT_EQ(reported("forceModels"), selectable(ForceModel::dictionaryConstructorTablePtr_->sortedToc()));
}

TEST(ModelLines, TellEachVoidFractionModelAndNoOther)
{
    EXPECT_EQ(
        reported("voidFractionModel"), selectable(VoidFractionModel::dictionaryConstructorTablePtr_->sortedToc()));
}

TEST(ModelLines, TellEachSmoothingModelAndNoOther)
{
    EXPECT_EQ(reported("smoothingModel"), selectable(SmoothingModel::dictionaryConstructorTablePtr_->sortedToc()));
}

/// The other way round OpenFOAM's own are in the table, too.
TEST(ModelLines, TellFunctionObjectsThatThereAre)
{
    for (const std::string& name : reported("functions { type }"))
    {
        EXPECT_TRUE(Foam::functionObject::dictionaryConstructorTablePtr_->found(name)) << name;
    }
}

TEST(ModelLines, AreOneLineEach)
{
    for (const auto& [entry, lines] : ModelLines::all())
    {
        for (const auto& [name, line] : lines)
        {
            EXPECT_GT(line.size(), 3U) << entry << ' ' << name;
            EXPECT_LT(line.size(), 80U) << entry << ' ' << name;
            EXPECT_EQ(line.find('\n'), std::string::npos) << entry << ' ' << name;
        }
    }
}

} // namespace
