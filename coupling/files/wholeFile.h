#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>

namespace clepsydra
{

/// A file that could not be read or written; the message names it and says why.
class FileError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;

    /// "<action> <file>: <what the system says of errno>".
    static FileError ofSystem(const std::string& action, const std::filesystem::path& file);
};

/// What a file held when it was written.
struct FileContents
{
    std::uintmax_t size = 0;
    std::string sha256; // hexadecimal

    bool operator==(const FileContents& other) const
    {
        return size == other.size && sha256 == other.sha256;
    }
};

/// Reads the whole file. FileError where that fails.
FileContents contentsOf(const std::filesystem::path& file);

std::string sha256(const std::string& text);

/// Waits until a file or folder is on the disk: only then is it known that a disk was not full. FileError.
void flushToDisk(const std::filesystem::path& file);

/// Puts `text` in the place of `file`: under another name first, which takes the file's place when it is on the disk. So
/// the file is the old one or the new one, whatever happens. FileError, and the old one is there still.
void writeWhole(const std::filesystem::path& file, const std::string& text);

/// The same of a file that several processes write, each its own part: first one begins it, then each writes, then, when all
/// have, one finishes it, or discards it where one could not write. Each may throw FileError; the old file is there until it
/// is finished.
void beginInParts(const std::filesystem::path& file);
void writePart(const std::filesystem::path& file, std::uint64_t place, const std::string& text);
void finishInParts(const std::filesystem::path& file);
void discardParts(const std::filesystem::path& file) noexcept;

/// Name under which a file is written before it is whole.
std::filesystem::path unfinishedName(const std::filesystem::path& file);

/// The file beside `file` with its checksum, as `sha256sum --check` reads it.
std::filesystem::path checksumName(const std::filesystem::path& file);
void writeChecksum(const std::filesystem::path& file);

/// FileError where `file` is empty or absent, or is not the one whose checksum stands beside it. Without a checksum, as
/// of another program, it is taken as it is.
void requireUndamaged(const std::filesystem::path& file);

/// A file that a library writes by its name without looking whether that works, as LIGGGHTS does. The library writes
/// into a pipe; what comes out of it is written here, and checked. While this lives there is a link to the pipe beside the
/// file, for a library that makes the names of several files of one.
///
///     FileThroughPipe checkpoint("particles.restart");
///     library.writeTo(FileThroughPipe::entrance("particles.restart"));
///     checkpoint.finish();
class FileThroughPipe
{
public:
    /// FileError where the file or the link cannot be made.
    explicit FileThroughPipe(std::filesystem::path file);

    /// Without finish(): the file stays as it was.
    ~FileThroughPipe();
    FileThroughPipe(const FileThroughPipe&) = delete;
    FileThroughPipe& operator=(const FileThroughPipe&) = delete;

    /// The name to write to, of this file's link. It is to be opened once, and closed before finish().
    static std::filesystem::path entrance(const std::filesystem::path& file);

    /// FileError where not all that was written is on the disk; otherwise it is, and has taken the file's place.
    void finish();

private:
    void openEntrance();
    void receive();
    void closeEntrance();
    void discard() noexcept;

    std::filesystem::path file_;
    int output_ = -1;
    int entrance_ = -1;
    int exit_ = -1;
    /// errno of the first write that failed.
    int failure_ = 0;
    std::thread receiver_;
};

} // namespace clepsydra
