#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>

namespace clepsydra
{

/// A file could not be read or written; the message names the file and the cause.
class FileError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;

    /// Message "<action> <file>: <the system's text for errno>".
    static FileError ofSystem(const std::string& action, const std::filesystem::path& file);
};

/// Size and checksum of a file's contents.
struct FileContents
{
    std::uintmax_t size = 0;
    std::string sha256; // hexadecimal

    bool operator==(const FileContents& other) const
    {
        return size == other.size && sha256 == other.sha256;
    }
};

/// Reads the whole file. \throws FileError where that fails
FileContents contentsOf(const std::filesystem::path& file);

/// \throws FileError where the file cannot be read
std::string textOf(const std::filesystem::path& file);

std::string sha256(const std::string& text);

/// Waits until a file or folder is on the disk; only then is it certain that the disk was not full. \throws FileError
void flushToDisk(const std::filesystem::path& file);

/// Replaces `file` by one that contains `text`. The text is written under another name and takes the file's place once
/// it is on the disk, so `file` is always either the old or the new one. \throws FileError, after which the old file is
/// unchanged
void writeWhole(const std::filesystem::path& file, const std::string& text);

/// Replaces a file of which each of several processes writes its own part. One process calls beginInParts(); then every
/// process calls writePart(); then one process calls finishInParts(), or discardParts() where a part could not be
/// written. The old file is unchanged until finishInParts(). \throws FileError
void beginInParts(const std::filesystem::path& file);
void writePart(const std::filesystem::path& file, std::uint64_t place, const std::string& text);
void finishInParts(const std::filesystem::path& file);
void discardParts(const std::filesystem::path& file) noexcept;

/// Name under which a file is written until it is complete.
std::filesystem::path unfinishedName(const std::filesystem::path& file);

/// Name of the checksum file beside `file`, which `sha256sum --check` can read.
std::filesystem::path checksumName(const std::filesystem::path& file);
void writeChecksum(const std::filesystem::path& file);

/// \throws FileError where `file` is empty, missing, or does not match the checksum beside it. A file without a
/// checksum, such as one of another program, is accepted.
void requireUndamaged(const std::filesystem::path& file);

/// A file that a library writes by name without checking for errors, as LIGGGHTS does. The library writes into a pipe;
/// this class writes the pipe's contents to the file and checks every write. A symbolic link to the pipe lies beside
/// the file while the object lives, because the library may derive the names of several files from one.
///
///     FileThroughPipe checkpoint("particles.restart");
///     library.writeTo(FileThroughPipe::entrance("particles.restart"));
///     checkpoint.finish();
class FileThroughPipe
{
public:
    /// \throws FileError where the file or the link cannot be created
    explicit FileThroughPipe(std::filesystem::path file);

    /// Unless finish() was called, the old file is unchanged.
    ~FileThroughPipe();
    FileThroughPipe(const FileThroughPipe&) = delete;
    FileThroughPipe& operator=(const FileThroughPipe&) = delete;

    /// Name of the link, for the library to write to. It may be opened once and must be closed before finish().
    static std::filesystem::path entrance(const std::filesystem::path& file);

    /// Replaces the file. \throws FileError where not everything that was written is on the disk
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
    /// errno of the first write that failed; 0 where none has.
    int failure_ = 0;
    std::thread receiver_;
};

} // namespace clepsydra
