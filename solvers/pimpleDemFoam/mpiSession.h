#pragma once

#include "run/scratchFolder.h"
#include "run/singleProcessMpi.h"

#include <mpi.h>

namespace clepsydra
{

/// Initialises MPI for the engine in a serial run, where OpenFOAM does not. Construct after argList, so that MPI is
/// finalised before OpenFOAM's own clean-up.
class MpiSession
{
public:
    /// \throws std::runtime_error where it cannot start because of TMPDIR
    MpiSession()
    {
        int initialised = 0;
        MPI_Initialized(&initialised);
        if (!initialised)
        {
#if defined(OMPI_MAJOR_VERSION) && OMPI_MAJOR_VERSION >= 5
            // Open MPI 5 stores files in a folder in TMPDIR. Where it cannot create that folder, MPI_Init still reports
            // success, and a later call ends the program by a signal.
            const ScratchFolder canBeMade;
#endif
            initialiseMpi(nullptr, nullptr);
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
