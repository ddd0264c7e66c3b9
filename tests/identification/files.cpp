#include "runner/storedFiles.h"
#include "temporaryFolder.h"

#include <gtest/gtest.h>

namespace clepsydra::identification::tests
{

namespace
{

/// A folder replaces another one completely.
TEST(StoredFiles, FoldersReplaceEachOther)
{
    const TemporaryFolder folder;
    folder.write("new/a", "1");
    folder.write("stored/b", "2");
    renameWhole(folder.path() / "new", folder.path() / "stored");
    EXPECT_EQ(textOf(folder.path() / "stored/a"), "1");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "stored/b"));
    EXPECT_THROW(renameWhole(folder.path() / "new", folder.path() / "stored"), FileError);
    EXPECT_THROW(textOf(folder.path() / "stored/b"), FileError);
    EXPECT_THROW(textOf(folder.path()), FileError);
    folder.write("empty", "");
    EXPECT_EQ(textOf(folder.path() / "empty"), "");
}

/// The examples of FIPS 180-4. The hash of a folder depends on names and contents.
TEST(StoredFiles, Digests)
{
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    const TemporaryFolder folder;
    folder.write("a", "1");
    const auto before = sha256OfPath(folder.path());
    EXPECT_EQ(before, sha256("a " + sha256("1") + '\n'));
    folder.write("b", "");
    EXPECT_NE(sha256OfPath(folder.path()), before);
}

} // namespace

} // namespace clepsydra::identification::tests
