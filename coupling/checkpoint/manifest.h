#pragma once

#include "files/wholeFile.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace clepsydra
{

/// Sums over the cells of a mesh, which are the same on any number of ranks but for rounding.
struct MeshSums
{
    std::int64_t cells = 0;
    double volume = 0;        // [m3]
    double squaredVolume = 0; // [m6]
};

/// The list of a checkpoint's files: every file that a resumed run reads, with its size and SHA-256. It is written
/// after all of them, so a checkpoint with a manifest was complete once, and its checksums show whether it still is.
///
/// The text has one line each for `time`, `ranks` and `commit`; then `run <identifier>` and `mesh <cells> <volume>
/// <squared volume>`; then one line each of these kinds, in any order; and last `end <sha256 of all before>`:
///
///     input <sha256> <size> <name>    from which the run was made: dictionary, DEM script, mesh of a rank
///     output <size> <name>            to which the DEM engine appends
///     <sha256> <size> <name>          which a resumed run reads
struct Manifest
{
    struct File
    {
        std::string name; // relative to the case
        FileContents contents;
    };

    struct Output
    {
        std::string name; // relative to the case
        std::uintmax_t size = 0;
    };

    std::string time;
    int ranks = 1;
    std::string commit;
    /// Empty in checkpoints of earlier versions, which have no inputs and outputs either.
    std::string run;
    MeshSums mesh;
    std::vector<File> inputs;
    std::vector<Output> outputs;
    std::vector<File> files;

    /// \param lines  of inputs, outputs and files, which the ranks have created
    std::string text(const std::string& lines) const;

    static std::string line(const File& file);
    static std::string inputLine(const File& file);
    static std::string outputLine(const Output& file);

    /// \throws FileError where the file is missing or is not as text() wrote it
    static Manifest read(const std::filesystem::path& file);

    /// Difference of `file` from what was written, as a phrase that names the file; empty where there is none.
    static std::string mismatch(const std::filesystem::path& caseDirectory, const File& file);
};

} // namespace clepsydra
