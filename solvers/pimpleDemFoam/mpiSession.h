#pragma once

#include <mpi.h>

namespace clepsydra
{

/// Initialises MPI for the engine in a serial run, where OpenFOAM does not. Construct after argList, so that MPI is
/// finalised before OpenFOAM's own clean-up.
class MpiSession
{
public:
    MpiSession()
    {
        int initialised = 0;
        MPI_Initialized(&initialised);
        if (!initialised)
        {
            MPI_Init(nullptr, nullptr);
            startedHere_ = true;
        }
    }

    ~MpiSession()
    {
        if (startedHere_)
        {
            MPI_Finalize();
        }
    }

    MpiSession(const MpiSession&) = delete;
    MpiSession& operator=(const MpiSession&) = delete;

private:
    bool startedHere_ = false;
};

} // namespace clepsydra
