#include "runner/storeLock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace clepsydra::identification
{

StoreLock::StoreLock(const std::filesystem::path& store, std::ostream& progress)
    // Closed on exec, so that the runs do not hold the lock. The processes that watch the runs hold it until these end.
    : file_(open((store / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644))
{
    if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) == 0)
    {
        return;
    }
    if (file_ >= 0 && errno == EWOULDBLOCK)
    {
        progress << "Another process makes runs in " << store.string() << "; waiting for it" << std::endl;
        if (flock(file_, LOCK_EX) == 0)
        {
            return;
        }
    }
    const std::string why = std::strerror(errno);
    if (file_ >= 0)
    {
        close(file_);
    }
    throw std::runtime_error((store / "lock").string() + " cannot be locked: " + why);
}

StoreLock::~StoreLock()
{
    close(file_);
}

} // namespace clepsydra::identification
