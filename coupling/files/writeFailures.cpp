#include "files/writeFailures.h"

#include "files/hiddenFunction.h"

#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace clepsydra
{

namespace
{

// The replaced functions may be called in a signal handler, so the note is kept without any allocation or lock.
enum State : int
{
    none,
    beingNoted,
    noted
};
std::atomic<int> state{none};
int causeOfFirst = 0;
std::array<char, 4096> fileOfFirst{};

bool isRegularFile(int file)
{
    struct stat status = {};
    return fstat(file, &status) == 0 && S_ISREG(status.st_mode);
}

void note(int file, int cause)
{
    int expected = none;
    const bool isFault = cause != EINTR && cause != EAGAIN && cause != EBADF && cause != EFAULT;
    if (!isFault || file <= STDERR_FILENO || !isRegularFile(file)
        || !state.compare_exchange_strong(expected, beingNoted))
    {
        return;
    }
    std::array<char, 64> link{};
    std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", file);
    const ssize_t length = readlink(link.data(), fileOfFirst.data(), fileOfFirst.size() - 1);
    if (length <= 0)
    {
        std::snprintf(fileOfFirst.data(), fileOfFirst.size(), "the file with descriptor %d", file);
    }
    causeOfFirst = cause;
    state = noted;
}

/// Notes a failure of the system. \return what it has written, errno as it has left it
ssize_t noting(int file, ssize_t written)
{
    if (written < 0)
    {
        const int cause = errno;
        note(file, cause);
        errno = cause;
    }
    return written;
}

} // namespace

std::string firstWriteFailure()
{
    return state == noted ? std::string("Cannot write ") + fileOfFirst.data() + ": " + std::strerror(causeOfFirst)
                          : std::string();
}

} // namespace clepsydra

extern "C" ssize_t write(int file, const void* bytes, std::size_t count)
{
    static auto* const system = clepsydra::hiddenFunction<ssize_t(int, const void*, std::size_t)>("write");
    return clepsydra::noting(file, system(file, bytes, count));
}

extern "C" ssize_t writev(int file, const iovec* parts, int count)
{
    static auto* const system = clepsydra::hiddenFunction<ssize_t(int, const iovec*, int)>("writev");
    return clepsydra::noting(file, system(file, parts, count));
}
