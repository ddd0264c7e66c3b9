#pragma once

#include <mpi.h>

#include <cstdlib>

namespace clepsydra
{

/// MPI_Init() for a program that no mpirun has started.
///
/// Open MPI 4 gives such a program a folder in the temporary directory, and all of one user the same one
/// (ompi.<host>.<user>/jf.0): of several that start at once, some find it removed by another that ends, and fail. A single
/// process needs no such folder, and gets none. Open MPI 5 ignores the setting; its folder has the number of the process.
/// mpirun, whose ranks do need one, makes one for each of its runs.
inline void initialiseMpi(int* argc, char*** argv)
{
    constexpr const char* makesFolder = "OMPI_MCA_orte_create_session_dirs";
    // Without this setting of scripts/environment the program starts a daemon, which needs the folder.
    const char* const isolated = std::getenv("OMPI_MCA_ess_singleton_isolated");
    const bool needsNone = isolated != nullptr && *isolated == '1' && std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr
                           && std::getenv(makesFolder) == nullptr;
    if (needsNone)
    {
        setenv(makesFolder, "0", 1);
    }
    MPI_Init(argc, argv);
    if (needsNone)
    {
        // An mpirun that this program starts must not inherit it.
        unsetenv(makesFolder);
    }
}

} // namespace clepsydra
