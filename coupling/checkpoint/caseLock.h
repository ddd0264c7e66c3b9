#pragma once

#include "fileName.H"

namespace clepsydra
{

/// Keeps a second program out of a case directory while the object exists.
///
/// The lock is flock(2) on <case>/.pimpleDemFoam.lock, which contains the name of the holder. The system releases the
/// lock when the process ends in any way, so a remaining file locks nothing. Take the lock before anything is written.
class CaseLock
{
public:
    /// Takes the lock on the master rank. Collective. FatalError on all ranks where another program holds it, which
    /// names the case and the holder's host and process, or where the file cannot be opened. Warns where the file system has no
    /// locks.
    /// \param caseDirectory  directory of the whole case (Time::globalPath(), argList::globalPath()), not that of one
    /// rank
    explicit CaseLock(const Foam::fileName& caseDirectory);
    ~CaseLock();

    CaseLock(const CaseLock&) = delete;
    CaseLock& operator=(const CaseLock&) = delete;

private:
    /// The open file on the master; -1 on other ranks.
    int file_ = -1;
};

} // namespace clepsydra
