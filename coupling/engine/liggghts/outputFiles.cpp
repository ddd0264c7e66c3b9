#include "engine/liggghts/outputFiles.h"

#include "files/hiddenFunction.h"
#include "files/wholeFile.h"

#include <dlfcn.h>

#include <library.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace clepsydra
{

namespace
{

OutputFiles* currentFiles = nullptr;

std::FILE* systemOpen(const char* file, const char* mode)
{
    static auto* const open = hiddenFunction<std::FILE*(const char*, const char*)>("fopen");
    return open(file, mode);
}

int systemClose(std::FILE* file)
{
    static auto* const close = hiddenFunction<int(std::FILE*)>("fclose");
    return close(file);
}

/// Start of the loaded library or program that contains an address.
const void* baseOf(const void* address)
{
    Dl_info info{};
    return dladdr(address, &info) == 0 ? nullptr : info.dli_fbase;
}

bool isInLiggghts(const void* address)
{
    static const void* const liggghts = baseOf(reinterpret_cast<const void*>(&lammps_open));
    return baseOf(address) == liggghts;
}

} // namespace

OutputFiles* OutputFiles::current()
{
    return currentFiles;
}

OutputFiles::OutputFiles(std::string log, std::vector<EngineOutput> continued, bool resumes)
    : log_(std::move(log)),
      resumes_(resumes),
      continued_(std::move(continued))
{
    currentFiles = this;
}

OutputFiles::~OutputFiles()
{
    currentFiles = nullptr;
}

bool OutputFiles::isContinued(const std::string& file) const
{
    return std::any_of(
        continued_.begin(), continued_.end(), [&](const EngineOutput& each) { return each.file == file; });
}

void OutputFiles::beginAgain(const std::string& file)
{
    continued_.erase(std::remove_if(continued_.begin(), continued_.end(),
                         [&](const EngineOutput& each) { return each.file == file; }),
        continued_.end());
}

void OutputFiles::noteFailure(const std::string& file, int cause)
{
    if (failure_.empty() && file != log_)
    {
        failure_ = "LIGGGHTS cannot write " + file + ": "
                   + (cause != 0 ? std::strerror(cause) : "a write has failed; is the disk full?");
    }
}

std::FILE* OutputFiles::open(const char* file, const char* mode)
{
    const bool again = mode[0] == 'w' && (isContinued(file) || (resumes_ && file == log_));
    std::FILE* const opened = systemOpen(file, again ? std::string(mode).replace(0, 1, "a").c_str() : mode);
    if (opened != nullptr && mode[0] != 'r')
    {
        open_[opened] = file;
    }
    return opened;
}

int OutputFiles::close(std::FILE* file)
{
    const auto found = open_.find(file);
    if (found == open_.end())
    {
        return systemClose(file);
    }
    const std::string name = found->second;
    open_.erase(found);
    const bool failedBefore = std::ferror(file) != 0;
    errno = 0;
    const int status = systemClose(file);
    if (status != 0 || failedBefore)
    {
        noteFailure(name, status != 0 ? errno : 0);
    }
    return status;
}

void OutputFiles::cutToCheckpoint()
{
    requireWritten();
    for (const auto& [stream, name] : open_)
    {
        const auto before = std::find_if(continued_.begin(), continued_.end(),
            [&name = name](const EngineOutput& each) { return each.file == name; });
        if (before != continued_.end() && std::filesystem::file_size(name) > before->size)
        {
            // The stream appends, so it goes on at the new end.
            std::error_code problem;
            std::filesystem::resize_file(name, before->size, problem);
            if (problem)
            {
                throw FileError(
                    "Cannot remove from " + name + " what was written after the checkpoint: " + problem.message());
            }
        }
    }
    continued_.clear();
}

void OutputFiles::requireWritten()
{
    for (const auto& [stream, name] : open_)
    {
        errno = 0;
        if (std::fflush(stream) != 0 || std::ferror(stream) != 0)
        {
            noteFailure(name, errno);
        }
    }
    if (!failure_.empty())
    {
        throw FileError(failure_ + "\nWith `startFrom latestTime` the same command resumes from the last checkpoint");
    }
}

std::vector<EngineOutput> OutputFiles::outputs()
{
    requireWritten();
    std::vector<EngineOutput> outputs;
    for (const auto& [stream, name] : open_)
    {
        if (name != log_ && std::filesystem::is_regular_file(name))
        {
            outputs.push_back({name, std::filesystem::file_size(name)});
        }
    }
    std::sort(outputs.begin(), outputs.end(),
        [](const EngineOutput& one, const EngineOutput& other) { return one.file < other.file; });
    return outputs;
}

} // namespace clepsydra

// The C library's own declarations have reserved names of parameters.
// NOLINTBEGIN(readability-inconsistent-declaration-parameter-name)
extern "C" std::FILE* fopen(const char* file, const char* mode)
{
    using namespace clepsydra;
    OutputFiles* const files = OutputFiles::current();
    return files != nullptr && isInLiggghts(__builtin_return_address(0)) ? files->open(file, mode)
                                                                         : systemOpen(file, mode);
}

extern "C" int fclose(std::FILE* file)
{
    // From wherever it is closed: a stream that LIGGGHTS has opened may be closed by others.
    using namespace clepsydra;
    OutputFiles* const files = OutputFiles::current();
    return files != nullptr ? files->close(file) : systemClose(file);
}
// NOLINTEND(readability-inconsistent-declaration-parameter-name)
