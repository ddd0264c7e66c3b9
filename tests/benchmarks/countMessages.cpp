/// \file
/// Counts what the ranks of pimpleDemFoam send each other, through MPI's profiling interface, and their memory:
///
///     MESSAGE_COUNTS=FOLDER mpirun -np 4 -x MESSAGE_COUNTS -x LD_PRELOAD=build/lib/libcountMessages.so pimpleDemFoam -parallel
///
/// Each rank writes FOLDER/<rank>.json: by phase of the run (PhaseTimers tells it), for one coupling step in the mean,
/// without the first and what comes before and after: messages and their bytes; the ranks that they went to in all;
/// collective calls and the bytes that they hand to or take from this rank.

#include "countMessages.h"

#include <mpi.h>

#include <cstdarg>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <string>

namespace
{

struct Count
{
    double messages = 0;
    double bytes = 0;
    double collectives = 0;
    double collectiveBytes = 0;
    std::set<int> neighbours;
};

std::map<std::string, Count> counts{{"other", {}}};
Count* current = &counts["other"];
/// At the end of the first coupling step, and of the last so far.
std::map<std::string, Count> first;
std::map<std::string, Count> last;
int ends = 0;

double size(int count, MPI_Datatype type)
{
    int bytes = 0;
    PMPI_Type_size(type, &bytes);
    return static_cast<double>(count) * bytes;
}

int ranksOf(MPI_Comm communicator)
{
    int ranks = 1;
    PMPI_Comm_size(communicator, &ranks);
    return ranks;
}

void message(int count, MPI_Datatype type, int to)
{
    if (to != MPI_PROC_NULL)
    {
        ++current->messages;
        current->bytes += size(count, type);
        current->neighbours.insert(to);
    }
}

void collective(double bytes)
{
    ++current->collectives;
    current->collectiveBytes += bytes;
}

double sum(const int* numbers, MPI_Datatype type, MPI_Comm communicator)
{
    double all = 0;
    for (int rank = 0; rank < ranksOf(communicator); ++rank)
    {
        all += size(numbers[rank], type);
    }
    return all;
}

double peakMemory()
{
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
    {
        double kibibytes = 0;
        if (word == "VmHWM:" && status >> kibibytes)
        {
            return 1024 * kibibytes;
        }
    }
    return 0;
}

void writeCounts()
{
    const char* const folder = std::getenv("MESSAGE_COUNTS");
    if (!folder)
    {
        return;
    }
    int rank = 0;
    PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
    std::ofstream file(folder + ('/' + std::to_string(rank)) + ".json");
    file << R"({"intervals": )" << ends - 1 << R"(, "peakMemory": )" << peakMemory() << R"(, "phases": {)";
    const char* comma = "";
    for (const auto& [phase, atEnd] : last)
    {
        const Count& before = first[phase];
        const auto perInterval = [](double from, double to) { return (to - from) / (ends - 1); };
        file << comma << "\n\"" << phase << R"(": {"messages": )" << perInterval(before.messages, atEnd.messages)
             << R"(, "bytes": )" << perInterval(before.bytes, atEnd.bytes) << R"(, "neighbours": )"
             << atEnd.neighbours.size() << R"(, "collectives": )" << perInterval(before.collectives, atEnd.collectives)
             << R"(, "collectiveBytes": )" << perInterval(before.collectiveBytes, atEnd.collectiveBytes) << '}';
        comma = ",";
    }
    file << "}}\n";
}

} // namespace

extern "C"
{

    /// The program enters a phase. "output" comes once, at the end of each coupling step.
    int MPI_Pcontrol(const int level, ...)
    {
        std::va_list arguments;
        va_start(arguments, level);
        const std::string phase = va_arg(arguments, const char*);
        va_end(arguments);
        if (phase == "output")
        {
            last = counts;
            if (++ends == 1)
            {
                first = counts;
            }
        }
        current = &counts[phase];
        return MPI_SUCCESS;
    }

    double bytesSentSoFar()
    {
        double all = 0;
        for (const auto& [phase, count] : counts)
        {
            all += count.bytes + count.collectiveBytes;
        }
        return all;
    }

    double collectiveCallsSoFar()
    {
        double all = 0;
        for (const auto& [phase, count] : counts)
        {
            all += count.collectives;
        }
        return all;
    }

    int MPI_Finalize()
    {
        writeCounts();
        return PMPI_Finalize();
    }

    int MPI_Send(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm communicator)
    {
        message(count, type, to);
        return PMPI_Send(data, count, type, to, tag, communicator);
    }

    int MPI_Bsend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm communicator)
    {
        message(count, type, to);
        return PMPI_Bsend(data, count, type, to, tag, communicator);
    }

    int MPI_Ssend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm communicator)
    {
        message(count, type, to);
        return PMPI_Ssend(data, count, type, to, tag, communicator);
    }

    int MPI_Rsend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm communicator)
    {
        message(count, type, to);
        return PMPI_Rsend(data, count, type, to, tag, communicator);
    }

    int MPI_Isend(
        const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm communicator, MPI_Request* request)
    {
        message(count, type, to);
        return PMPI_Isend(data, count, type, to, tag, communicator, request);
    }

    int MPI_Ibsend(
        const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm communicator, MPI_Request* request)
    {
        message(count, type, to);
        return PMPI_Ibsend(data, count, type, to, tag, communicator, request);
    }

    int MPI_Issend(
        const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm communicator, MPI_Request* request)
    {
        message(count, type, to);
        return PMPI_Issend(data, count, type, to, tag, communicator, request);
    }

    int MPI_Irsend(
        const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm communicator, MPI_Request* request)
    {
        message(count, type, to);
        return PMPI_Irsend(data, count, type, to, tag, communicator, request);
    }

    int MPI_Sendrecv(const void* data, int count, MPI_Datatype type, int to, int tag, void* received, int receivedCount,
        MPI_Datatype receivedType, int from, int receivedTag, MPI_Comm communicator, MPI_Status* status)
    {
        message(count, type, to);
        return PMPI_Sendrecv(
            data, count, type, to, tag, received, receivedCount, receivedType, from, receivedTag, communicator, status);
    }

    int MPI_Barrier(MPI_Comm communicator)
    {
        collective(0);
        return PMPI_Barrier(communicator);
    }

    int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm communicator)
    {
        collective(size(count, type));
        return PMPI_Bcast(data, count, type, root, communicator);
    }

    int MPI_Reduce(
        const void* data, void* result, int count, MPI_Datatype type, MPI_Op operation, int root, MPI_Comm communicator)
    {
        collective(size(count, type));
        return PMPI_Reduce(data, result, count, type, operation, root, communicator);
    }

    int MPI_Allreduce(
        const void* data, void* result, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm communicator)
    {
        collective(size(count, type));
        return PMPI_Allreduce(data, result, count, type, operation, communicator);
    }

    int MPI_Iallreduce(const void* data, void* result, int count, MPI_Datatype type, MPI_Op operation,
        MPI_Comm communicator, MPI_Request* request)
    {
        collective(size(count, type));
        return PMPI_Iallreduce(data, result, count, type, operation, communicator, request);
    }

    int MPI_Scan(const void* data, void* result, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm communicator)
    {
        collective(size(count, type));
        return PMPI_Scan(data, result, count, type, operation, communicator);
    }

    int MPI_Allgather(const void* data, int count, MPI_Datatype type, void* result, int resultCount,
        MPI_Datatype resultType, MPI_Comm communicator)
    {
        collective(size(resultCount, resultType) * ranksOf(communicator));
        return PMPI_Allgather(data, count, type, result, resultCount, resultType, communicator);
    }

    int MPI_Alltoall(const void* data, int count, MPI_Datatype type, void* result, int resultCount,
        MPI_Datatype resultType, MPI_Comm communicator)
    {
        collective(size(resultCount, resultType) * ranksOf(communicator));
        return PMPI_Alltoall(data, count, type, result, resultCount, resultType, communicator);
    }

    int MPI_Gather(const void* data, int count, MPI_Datatype type, void* result, int resultCount,
        MPI_Datatype resultType, int root, MPI_Comm communicator)
    {
        collective(size(count, type));
        return PMPI_Gather(data, count, type, result, resultCount, resultType, root, communicator);
    }

    int MPI_Scatter(const void* data, int count, MPI_Datatype type, void* result, int resultCount,
        MPI_Datatype resultType, int root, MPI_Comm communicator)
    {
        collective(size(resultCount, resultType));
        return PMPI_Scatter(data, count, type, result, resultCount, resultType, root, communicator);
    }

    int MPI_Allgatherv(const void* data, int count, MPI_Datatype type, void* result, const int* resultCounts,
        const int* places, MPI_Datatype resultType, MPI_Comm communicator)
    {
        collective(sum(resultCounts, resultType, communicator));
        return PMPI_Allgatherv(data, count, type, result, resultCounts, places, resultType, communicator);
    }

    int MPI_Gatherv(const void* data, int count, MPI_Datatype type, void* result, const int* resultCounts,
        const int* places, MPI_Datatype resultType, int root, MPI_Comm communicator)
    {
        collective(size(count, type));
        return PMPI_Gatherv(data, count, type, result, resultCounts, places, resultType, root, communicator);
    }

    int MPI_Scatterv(const void* data, const int* counts, const int* places, MPI_Datatype type, void* result,
        int resultCount, MPI_Datatype resultType, int root, MPI_Comm communicator)
    {
        collective(size(resultCount, resultType));
        return PMPI_Scatterv(data, counts, places, type, result, resultCount, resultType, root, communicator);
    }

    int MPI_Alltoallv(const void* data, const int* counts, const int* places, MPI_Datatype type, void* result,
        const int* resultCounts, const int* resultPlaces, MPI_Datatype resultType, MPI_Comm communicator)
    {
        collective(sum(resultCounts, resultType, communicator));
        return PMPI_Alltoallv(data, counts, places, type, result, resultCounts, resultPlaces, resultType, communicator);
    }

} // extern "C"
