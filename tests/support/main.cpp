// GoogleTest's main() for tests that use OpenFOAM. With `-parallel` on the command line, under mpirun, the tests run
// on all ranks; OpenFOAM's errors become exceptions (Foam::error) that a test can expect.
//
// Not argList: its destructor ends the program with status 0, whatever the tests said.

#include "Pstream.H"
#include "error.H"

#include "run/singleProcessMpi.h"

#include <gtest/gtest.h>
#include <mpi.h>

#include <cstring>

int main(int argc, char* argv[])
{
    bool parallel = false;
    for (int i = 1; i < argc; ++i)
    {
        parallel = parallel || std::strcmp(argv[i], "-parallel") == 0;
    }
    if (parallel)
    {
        Foam::UPstream::init(argc, argv, false);
    }
    else
    {
        clepsydra::initialiseMpi(&argc, &argv);
    }
    testing::InitGoogleTest(&argc, argv);
    Foam::FatalError.throwExceptions();
    Foam::FatalIOError.throwExceptions();

    int failed = RUN_ALL_TESTS();
    if (parallel)
    {
        MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
        Foam::UPstream::exit(failed);
    }
    MPI_Finalize();
    return failed;
}
