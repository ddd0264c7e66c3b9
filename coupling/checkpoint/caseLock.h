#pragma once

#include "fileName.H"

namespace clepsydra
{

/// Keeps a second program out of a case directory, for as long as this lives.
///
/// The lock is flock(2) on <case>/.pimpleDemFoam.lock, which says who holds it. The system drops the lock when the
/// process ends, however it ends, so a file left behind locks nothing. Take it before anything is written.
class CaseLock
{
public:
    /// Collective; the master takes the lock.
    /// FatalError on all ranks naming the case and the holder's host and process where another program holds it, or
    /// the cause where the file cannot be opened.
    /// \param caseDirectory  the case as a whole (Time::globalPath(), argList::globalPath()), not one rank's part.
    explicit CaseLock(const Foam::fileName& caseDirectory);
    ~CaseLock();

    CaseLock(const CaseLock&) = delete;
    CaseLock& operator=(const CaseLock&) = delete;

private:
    /// Open file on the master, -1 elsewhere.
    int file_ = -1;
};

} // namespace clepsydra
