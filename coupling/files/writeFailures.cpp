#include "files/writeFailures.h"

#include <dlfcn.h>
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

/// The function of this name that the replaced one hides.
template<class Function>
Function* hidden(const char* name)
{
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
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
    static auto* const system = clepsydra::hidden<ssize_t(int, const void*, std::size_t)>("write");
    const ssize_t written = system(file, bytes, count);
    if (written < 0)
    {
        const int cause = errno;
        clepsydra::note(file, cause);
        errno = cause;
    }
    return written;
}

extern "C" ssize_t writev(int file, const iovec* parts, int count)
{
    static auto* const system = clepsydra::hidden<ssize_t(int, const iovec*, int)>("writev");
    const ssize_t written = system(file, parts, count);
    if (written < 0)
    {
        const int cause = errno;
        clepsydra::note(file, cause);
        errno = cause;
    }
    return written;
}
