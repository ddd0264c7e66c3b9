#pragma once

namespace clepsydra::identification::tests
{

/// As long as it lives, every disk says that it has no room left. What is written is written all the same, as by a program
/// whose output has just filled the disk.
class FullDisk
{
public:
    FullDisk();
    ~FullDisk();
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;
};

} // namespace clepsydra::identification::tests
