#include "files/wholeFile.h"

#include <openssl/evp.h>

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>

namespace clepsydra
{

namespace
{

constexpr std::size_t bufferSize = 1 << 20;

/// An open file, closed by the destructor.
class OpenFile
{
public:
    OpenFile(const std::filesystem::path& file, int flags)
        : descriptor_(open(file.c_str(), flags | O_CLOEXEC, 0644))
    {
        if (descriptor_ < 0)
        {
            throw FileError::ofSystem("Cannot open", file);
        }
    }

    ~OpenFile()
    {
        close(descriptor_);
    }

    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    int descriptor() const
    {
        return descriptor_;
    }

private:
    const int descriptor_;
};

class Sha256
{
public:
    Sha256()
    {
        EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr);
    }

    void add(const char* bytes, std::size_t count)
    {
        EVP_DigestUpdate(context_.get(), bytes, count);
    }

    std::string hexadecimal()
    {
        std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
        unsigned length = 0;
        EVP_DigestFinal_ex(context_.get(), digest.data(), &length);
        std::string text;
        for (unsigned i = 0; i < length; ++i)
        {
            std::array<char, 3> digits{};
            std::snprintf(digits.data(), digits.size(), "%02x", digest[i]);
            text += digits.data();
        }
        return text;
    }

private:
    std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_{EVP_MD_CTX_new(), &EVP_MD_CTX_free};
};

/// \return 0, or errno of the write that failed
int writeAll(int descriptor, const char* bytes, std::size_t count)
{
    while (count > 0)
    {
        const ssize_t written = write(descriptor, bytes, count);
        if (written < 0 && errno != EINTR)
        {
            return errno;
        }
        if (written > 0)
        {
            bytes += written;
            count -= static_cast<std::size_t>(written);
        }
    }
    return 0;
}

/// Hands a file's bytes to an action, part by part. \throws FileError
template<class Action>
void readAll(const std::filesystem::path& file, const Action& use)
{
    const OpenFile input(file, O_RDONLY);
    std::string buffer(bufferSize, '\0');
    for (ssize_t count; (count = read(input.descriptor(), buffer.data(), buffer.size())) != 0;)
    {
        if (count > 0)
        {
            use(buffer.data(), static_cast<std::size_t>(count));
        }
        else if (errno != EINTR)
        {
            throw FileError::ofSystem("Cannot read", file);
        }
    }
}

std::filesystem::path withEnding(std::filesystem::path file, const char* ending)
{
    file += ending;
    return file;
}

/// Waits until everything written to an unfinished file is on the disk. \throws FileError
void settle(int unfinished, const std::filesystem::path& file)
{
    if (fsync(unfinished) != 0)
    {
        throw FileError::ofSystem("Cannot write", unfinishedName(file));
    }
}

} // namespace

FileError FileError::ofSystem(const std::string& action, const std::filesystem::path& file)
{
    return FileError(action + ' ' + file.string() + ": " + std::strerror(errno));
}

FileContents contentsOf(const std::filesystem::path& file)
{
    FileContents contents;
    Sha256 digest;
    readAll(file, [&](const char* bytes, std::size_t count) {
        digest.add(bytes, count);
        contents.size += static_cast<std::uintmax_t>(count);
    });
    contents.sha256 = digest.hexadecimal();
    return contents;
}

std::string textOf(const std::filesystem::path& file)
{
    std::string text;
    readAll(file, [&](const char* bytes, std::size_t count) { text.append(bytes, count); });
    return text;
}

std::string sha256(const std::string& text)
{
    Sha256 digest;
    digest.add(text.data(), text.size());
    return digest.hexadecimal();
}

void flushToDisk(const std::filesystem::path& file)
{
    const OpenFile open(file, O_RDONLY);
    // Some file systems do not support fsync() for folders.
    if (fsync(open.descriptor()) != 0 && errno != EINVAL)
    {
        throw FileError::ofSystem("Cannot write", file);
    }
}

void writeWhole(const std::filesystem::path& file, const std::string& text)
{
    beginInParts(file);
    try
    {
        writePart(file, 0, text);
    }
    catch (const FileError&)
    {
        discardParts(file);
        throw;
    }
    finishInParts(file);
}

void beginInParts(const std::filesystem::path& file)
{
    const OpenFile emptied(unfinishedName(file), O_WRONLY | O_CREAT | O_TRUNC);
}

void writePart(const std::filesystem::path& file, std::uint64_t place, const std::string& text)
{
    // O_CREAT makes a client of a network file system ask the server, where it may still have cached that the file does
    // not exist.
    const OpenFile output(unfinishedName(file), O_WRONLY | O_CREAT);
    if (lseek(output.descriptor(), static_cast<off_t>(place), SEEK_SET) < 0)
    {
        throw FileError::ofSystem("Cannot write", unfinishedName(file));
    }
    if (const int failure = writeAll(output.descriptor(), text.data(), text.size()))
    {
        errno = failure;
        throw FileError::ofSystem("Cannot write", unfinishedName(file));
    }
    settle(output.descriptor(), file);
}

void finishInParts(const std::filesystem::path& file)
{
    std::error_code error;
    std::filesystem::rename(unfinishedName(file), file, error);
    if (error)
    {
        throw FileError(
            "Cannot rename " + unfinishedName(file).string() + " to " + file.string() + ": " + error.message());
    }
    flushToDisk(file.has_parent_path() ? file.parent_path() : ".");
}

void discardParts(const std::filesystem::path& file) noexcept
{
    std::error_code ignored;
    std::filesystem::remove(unfinishedName(file), ignored);
}

std::filesystem::path checksumName(const std::filesystem::path& file)
{
    return withEnding(file, ".sha256");
}

void writeChecksum(const std::filesystem::path& file)
{
    writeWhole(checksumName(file), contentsOf(file).sha256 + "  " + file.filename().string() + '\n');
}

void requireUndamaged(const std::filesystem::path& file)
{
    const FileContents contents = contentsOf(file);
    if (contents.size == 0)
    {
        throw FileError(file.string() + " is empty");
    }
    std::string expected;
    if (std::filesystem::exists(checksumName(file))
        && (!(std::ifstream(checksumName(file)) >> expected) || expected != contents.sha256))
    {
        throw FileError(file.string() + " is not the file whose checksum stands in " + checksumName(file).string()
                        + ": damaged, exchanged or edited");
    }
}

std::filesystem::path unfinishedName(const std::filesystem::path& file)
{
    return withEnding(file, ".unfinished");
}

FileThroughPipe::FileThroughPipe(std::filesystem::path file)
    : file_(std::move(file))
{
    output_ = open(unfinishedName(file_).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (output_ < 0)
    {
        throw FileError::ofSystem("Cannot open", unfinishedName(file_));
    }
    try
    {
        openEntrance();
    }
    catch (const FileError&)
    {
        discard();
        throw;
    }
    receiver_ = std::thread(&FileThroughPipe::receive, this);
}

FileThroughPipe::~FileThroughPipe()
{
    closeEntrance();
    discard();
}

std::filesystem::path FileThroughPipe::entrance(const std::filesystem::path& file)
{
    return withEnding(file, ".entrance");
}

void FileThroughPipe::openEntrance()
{
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
    {
        throw FileError::ofSystem("Cannot open a pipe for", file_);
    }
    const std::filesystem::path link = entrance(file_);
    // A killed program may have left its link.
    unlink(link.c_str());
    if (symlink(("/proc/self/fd/" + std::to_string(ends[1])).c_str(), link.c_str()) != 0)
    {
        const FileError error = FileError::ofSystem("Cannot make the link", link);
        close(ends[0]);
        close(ends[1]);
        throw error;
    }
    exit_ = ends[0];
    entrance_ = ends[1];
}

void FileThroughPipe::receive()
{
    std::string buffer(bufferSize, '\0');
    for (ssize_t count; (count = read(exit_, buffer.data(), buffer.size())) != 0;)
    {
        if (count < 0)
        {
            if (errno == EINTR)
            {
                continue;
            }
            failure_ = errno;
            break;
        }
        // After a failure the pipe is still emptied, because a process that writes to a pipe without a reader is
        // killed.
        if (failure_ == 0)
        {
            failure_ = writeAll(output_, buffer.data(), static_cast<std::size_t>(count));
        }
    }
    close(exit_);
}

void FileThroughPipe::closeEntrance()
{
    if (receiver_.joinable())
    {
        unlink(entrance(file_).c_str());
        close(entrance_);
        receiver_.join();
    }
}

void FileThroughPipe::discard() noexcept
{
    if (output_ >= 0)
    {
        close(output_);
        discardParts(file_);
    }
}

void FileThroughPipe::finish()
{
    closeEntrance();
    if (failure_ != 0)
    {
        errno = failure_;
        throw FileError::ofSystem("Cannot write", unfinishedName(file_));
    }
    settle(output_, file_);
    finishInParts(file_);
    close(output_);
    output_ = -1;
}

} // namespace clepsydra
