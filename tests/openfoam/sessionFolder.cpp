/// \file
/// A program that no mpirun has started shares no folder with others.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace clepsydra::tests
{

namespace
{

/// This program has started MPI, with a temporary directory of its own that holds nothing else: there is no folder of
/// Open MPI in it. The folder would have the same name for all programs of a user, and one that ends takes it away from
/// one that starts.
TEST(SessionFolder, IsNotMadeForASingleProcess)
{
    const char* const own = std::getenv("OWN_TMPDIR");
    if (own == nullptr)
    {
        GTEST_SKIP() << "in a temporary directory that others use, too";
    }
    EXPECT_EQ(std::filesystem::temp_directory_path(), own);
    for (const auto& entry : std::filesystem::directory_iterator(own))
    {
        EXPECT_NE(entry.path().filename().string().rfind("ompi", 0), 0U) << entry.path();
    }
    EXPECT_EQ(std::getenv("OMPI_MCA_orte_create_session_dirs"), nullptr) << "an mpirun would inherit it, and fail";
}

} // namespace

} // namespace clepsydra::tests
