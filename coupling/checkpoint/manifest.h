#pragma once

#include "files/wholeFile.h"

#include <filesystem>
#include <string>
#include <vector>

namespace clepsydra
{

/// What a checkpoint consists of: every file that a resumed run reads, with its size and SHA-256. Written after all of
/// them, so a checkpoint with a manifest was whole once; whether it still is, the manifest tells.
///
/// As text, a line each: `time`, `ranks`, `commit`, then `<sha256> <size> <name>`, and last `end <sha256 of all before>`.
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

    /// \param fileLines  those of its files, which the ranks have made
    std::string text(const std::string& fileLines) const;

    static std::string line(const File& file);

    /// \throws FileError where the file is not there, or is not as text() made it.
    static Manifest read(const std::filesystem::path& file);

    /// What of `file` is not as it was written, as a phrase that names it; empty where all is.
    static std::string mismatch(const std::filesystem::path& caseDirectory, const File& file);
};

} // namespace clepsydra
