#include "checkpoint/caseLock.h"

#include "Pstream.H"
#include "error.H"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace clepsydra
{

namespace
{

std::string thisProcess()
{
    std::array<char, 256> host{};
    gethostname(host.data(), host.size() - 1);
    return std::string("process ") + std::to_string(getpid()) + " on host " + host.data();
}

std::string contents(int file)
{
    std::array<char, 512> text{};
    const ssize_t length = pread(file, text.data(), text.size(), 0);
    return length > 0 ? std::string(text.data(), static_cast<std::size_t>(length)) : std::string("unknown process");
}

/// Whether flock() has failed because the file system has no locks, as a network file system without a lock server.
bool hasNoLocks(int error)
{
    return error == ENOLCK || error == ENOSYS || error == EOPNOTSUPP;
}

/// \return why the lock could not be taken; empty where it was taken. `file` is open only in that case.
/// \param warning  set where the file system has no locks
std::string takeLock(const std::string& path, int& file, std::string& warning)
{
    // Close on exec, because a program that is started by this one must not keep the lock.
    file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file < 0)
    {
        return "Cannot open the lock file " + path + ": " + std::strerror(errno);
    }
    const bool locked = flock(file, LOCK_EX | LOCK_NB) == 0;
    if (!locked && hasNoLocks(errno))
    {
        warning = "the file system of " + path + " has no locks (" + std::strerror(errno)
                  + "), so this run cannot notice a second program that runs in this case";
    }
    else if (!locked)
    {
        std::string cause = errno == EWOULDBLOCK
                                ? "Another program runs in this case: " + contents(file) + " holds the lock file "
                                      + path + ". Wait for it, or run in a copy of the case."
                                : "Cannot lock " + path + ": " + std::strerror(errno);
        close(file);
        file = -1;
        return cause;
    }

    // The text is only information for others, so a full disk is no reason to stop here.
    const std::string holder = thisProcess();
    if (ftruncate(file, 0) == 0)
    {
        static_cast<void>(!pwrite(file, holder.data(), holder.size(), 0));
    }
    return {};
}

} // namespace

CaseLock::CaseLock(const Foam::fileName& caseDirectory)
{
    using namespace Foam;

    string problem;
    std::string warning;
    if (Pstream::master())
    {
        problem = takeLock(caseDirectory / ".pimpleDemFoam.lock", file_, warning);
    }
    Pstream::scatter(problem);
    if (!problem.empty())
    {
        FatalErrorInFunction << problem.c_str() << exit(FatalError);
    }
    if (!warning.empty())
    {
        Info << "WARNING: " << warning.c_str() << nl << endl;
    }
}

CaseLock::~CaseLock()
{
    // The file remains, because removing it would allow two other processes to lock two files of the same name.
    if (file_ >= 0)
    {
        close(file_);
    }
}

} // namespace clepsydra
