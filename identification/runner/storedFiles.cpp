#include "runner/storedFiles.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <set>
#include <stdexcept>

namespace clepsydra::identification
{

namespace fs = std::filesystem;

std::string sha256OfPath(const fs::path& path, const std::string& leaveOut)
{
    if (!fs::is_directory(path))
    {
        return contentsOf(path).sha256;
    }
    std::set<std::string> lines;
    for (auto entry = fs::recursive_directory_iterator(path); entry != fs::recursive_directory_iterator(); ++entry)
    {
        const auto name = entry->path().filename().string();
        if (!leaveOut.empty() && name == leaveOut)
        {
            entry.disable_recursion_pending();
            continue;
        }
        const std::string place = fs::relative(entry->path(), path).string();
        if (entry->is_symlink())
        {
            lines.insert(place + " -> " + fs::read_symlink(entry->path()).string());
        }
        else if (entry->is_regular_file())
        {
            lines.insert(place + ' ' + contentsOf(entry->path()).sha256);
        }
    }
    std::string all;
    for (const auto& line : lines)
    {
        all += line + '\n';
    }
    return sha256(all);
}

void renameWhole(const fs::path& folder, const fs::path& name)
{
    flushToDisk(folder);
    std::error_code error;
    fs::remove_all(name, error);
    fs::rename(folder, name, error);
    if (error)
    {
        throw FileError("Cannot rename " + folder.string() + " to " + name.string() + ": " + error.message());
    }
    flushToDisk(name.parent_path());
}

StoreLock::StoreLock(const fs::path& store, std::ostream& progress)
    // Closed on exec, so that the runs do not hold the lock. The processes that watch the runs hold it until these end.
    : file_(open((store / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644))
{
    bool isLocked = file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) == 0;
    if (!isLocked && file_ >= 0 && errno == EWOULDBLOCK)
    {
        progress << "Another process makes runs in " << store.string() << "; waiting for it" << std::endl;
        isLocked = flock(file_, LOCK_EX) == 0;
    }
    if (!isLocked)
    {
        throw std::runtime_error((store / "lock").string() + " cannot be locked: " + std::strerror(errno));
    }
}

StoreLock::~StoreLock()
{
    close(file_);
}

} // namespace clepsydra::identification
