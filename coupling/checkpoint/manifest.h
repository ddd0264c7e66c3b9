#pragma once

#include "files/wholeFile.h"

#include <filesystem>
#include <string>
#include <vector>

namespace clepsydra
{

/// The list of a checkpoint's files: every file that a resumed run reads, with its size and SHA-256. It is written
/// after all of them, so a checkpoint with a manifest was complete once, and its checksums show whether it still is.
///
/// The text has one line each for `time`, `ranks` and `commit`, then one line `<sha256> <size> <name>` per file, and
/// last `end <sha256 of all before>`.
struct Manifest
{
    struct File
    {
        std::string name; // relative to the case
        FileContents contents;
    };

    std::string time;
    int ranks = 1;
    std::string commit;
    std::vector<File> files;

    /// \param fileLines  the lines of its files, which the ranks have created
    std::string text(const std::string& fileLines) const;

    static std::string line(const File& file);

    /// \throws FileError where the file is missing or is not as text() wrote it
    static Manifest read(const std::filesystem::path& file);

    /// Difference of `file` from what was written, as a phrase that names the file; empty where there is none.
    static std::string mismatch(const std::filesystem::path& caseDirectory, const File& file);
};

} // namespace clepsydra
