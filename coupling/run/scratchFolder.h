#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace clepsydra
{

/// A folder in the system's temporary directory, which the destructor removes with its contents.
class ScratchFolder
{
public:
    ScratchFolder()
    {
        std::error_code problem;
        std::string pattern = (std::filesystem::temp_directory_path(problem) / "pimpleDemFoam.XXXXXX").string();
        if (problem || !mkdtemp(pattern.data()))
        {
            const char* const tmpdir = std::getenv("TMPDIR");
            throw std::runtime_error("cannot make a temporary folder; TMPDIR is '" + std::string(tmpdir ? tmpdir : "")
                                     + "', allowed: a folder that can be written to");
        }
        path_ = pattern;
    }

    ~ScratchFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const
    {
        return path_;
    }

private:
    std::filesystem::path path_;
};

} // namespace clepsydra
