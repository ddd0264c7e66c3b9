/// \file
/// The estimate of a run's wall time. No test here measures time.

#include <gmock/gmock.h>

#include "run/costModel.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace clepsydra::tests
{

namespace
{

class CostModelFile : public testing::Test
{
protected:
    void write(const std::string& text) const
    {
        std::ofstream(file) << text;
    }

    void TearDown() override
    {
        std::filesystem::remove(file);
    }

    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("costModel" + std::to_string(getpid()) + ".json");
};

/// Worked out by hand: 10 beads, 5 steps, 27 cells (27^(4/3) = 81), 2 intervals:
/// 1*10*5 + (2*10 + 3*27 + 4*81)*2 = 50 + 850 = 900; on 4 ranks with a tenth serial 900*(.1 + .9/4) = 292.5.
/// Leaving out any term or the ranks gives another number.
TEST_F(CostModelFile, SumsBeadStepsAndIntervals)
{
    write(
        R"({"perBeadStep": 1, "perBead": 2, "perCell": 3, "perCell43": 4, "serialFraction": 0.1, "machine": "here"})");
    const std::optional<CostModel> model = CostModel::read(file);
    ASSERT_TRUE(model.has_value());
    EXPECT_NEAR(model->seconds({10, 27, 5, 2}, 1), 900, 1e-9);
    EXPECT_NEAR(model->seconds({10, 27, 5, 2}, 4), 292.5, 1e-9);
    EXPECT_EQ(model->machine, "here");
}

/// No file, no estimate; a damaged one is an error that names the file and what is missing.
TEST_F(CostModelFile, MissingFileIsNoModelMissingEntryAnError)
{
    EXPECT_FALSE(CostModel::read(file).has_value());
    write(R"({"perBeadStep": 1})");
    try
    {
        CostModel::read(file);
        FAIL() << "accepted a file without entries";
    }
    catch (const std::runtime_error& error)
    {
        EXPECT_THAT(error.what(), testing::HasSubstr(file.string()));
        EXPECT_THAT(error.what(), testing::HasSubstr("perBead"));
    }
}

} // namespace

} // namespace clepsydra::tests
