#include "fullDisk.h"

#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <sys/vfs.h>
#include <unistd.h>

namespace
{

bool isFull = false;

} // namespace

/// In place of the C library's function, which std::filesystem::space() calls.
extern "C" int statvfs(const char* path, struct statvfs* result)
{
    struct statfs of = {};
    const long status = syscall(SYS_statfs, path, &of);
    *result = {};
    result->f_bsize = static_cast<unsigned long>(of.f_bsize);
    result->f_frsize = static_cast<unsigned long>(of.f_frsize != 0 ? of.f_frsize : of.f_bsize);
    result->f_blocks = of.f_blocks;
    result->f_bfree = isFull ? 0 : of.f_bfree;
    result->f_bavail = isFull ? 0 : of.f_bavail;
    return static_cast<int>(status);
}

namespace clepsydra::identification::tests
{

FullDisk::FullDisk()
{
    isFull = true;
}

FullDisk::~FullDisk()
{
    isFull = false;
}

} // namespace clepsydra::identification::tests
