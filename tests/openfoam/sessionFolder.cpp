/// \file
/// A program that no mpirun has started shares no folder with others.

#include <gtest/gtest.h>

#include <mpi.h>

#include <cstdlib>
#include <filesystem>

namespace clepsydra::tests
{

namespace
{

/// This program has started MPI, with a temporary directory of its own that holds nothing else: there is no folder of
/// Open MPI 4 in it. The folder would have the same name for all programs of a user, and one that ends takes it away from
/// one that starts. Open MPI 5 makes a folder in it with a number of this program, other than 0.
TEST(SessionFolder, IsOfNoOtherProcess)
{
    const char* const own = std::getenv("OWN_TMPDIR");
    if (own == nullptr)
    {
        GTEST_SKIP() << "in a temporary directory that others use, too";
    }
    EXPECT_EQ(std::filesystem::temp_directory_path(), own);
    const bool numbered = OMPI_MAJOR_VERSION >= 5;
    for (const auto& entry : std::filesystem::directory_iterator(own))
    {
        if (entry.path().filename().string().rfind("ompi", 0) == 0)
        {
            ASSERT_TRUE(numbered) << entry.path();
            int ofPrograms = 0;
            for (const auto& ofProgram : std::filesystem::directory_iterator(entry.path() / "jf.0"))
            {
                EXPECT_NE(ofProgram.path().filename(), "0");
                ++ofPrograms;
            }
            EXPECT_EQ(ofPrograms, 1) << entry.path();
        }
    }
    EXPECT_EQ(std::getenv("OMPI_MCA_orte_create_session_dirs"), nullptr) << "an mpirun would inherit it, and fail";
}

} // namespace

} // namespace clepsydra::tests
