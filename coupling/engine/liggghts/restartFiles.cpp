#include "engine/liggghts/restartFiles.h"

#include "engine/demEngine.h"
#include "engine/liggghts/liggghtsProgram.h"
#include "engine/liggghts/subdomains.h"
#include "files/wholeFile.h"

#include <comm.h>
#include <fix_insert_pack.h>
#include <lammps.h>
#include <modify.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <list>
#include <sstream>

namespace clepsydra
{

namespace
{

namespace lmp = LAMMPS_NS;

/// Whether a file is something else than a restart file, which begins with two numbers of four bytes and the text
/// "Version LIGGGHTS-...". False for a file that cannot be read, which LIGGGHTS reports itself.
bool isOtherThanRestart(const std::string& file)
{
    const std::string begin = "Version LIGGGHTS";
    constexpr std::size_t numbers = 8;
    std::ifstream stream(file, std::ios::binary);
    std::string found(numbers + begin.size(), ' ');
    return stream
           && (!stream.read(found.data(), static_cast<std::streamsize>(found.size()))
               || found.substr(numbers) != begin);
}

/// Name of a restart file with a text in place of its `%`.
std::filesystem::path restartFile(std::string name, const std::string& part)
{
    return name.replace(name.find('%'), 1, part);
}

bool isInParts(const std::filesystem::path& restart)
{
    return restart.string().find('%') != std::string::npos;
}

/// Files that LIGGGHTS' write_restart writes on one rank.
std::vector<std::filesystem::path> filesWritten(const std::filesystem::path& restart, int rank)
{
    std::vector<std::filesystem::path> files;
    if (rank == 0)
    {
        files.push_back(isInParts(restart) ? restartFile(restart, "base") : restart);
    }
    if (isInParts(restart))
    {
        files.push_back(restartFile(restart, std::to_string(rank)));
    }
    return files;
}

/// Files that LIGGGHTS' read_restart reads on one of the ranks. The base is read first, for all ranks.
std::vector<std::filesystem::path> filesRead(const std::filesystem::path& restart, int rank, int ranks)
{
    std::vector<std::filesystem::path> files{isInParts(restart) ? restartFile(restart, "base") : restart};
    const auto part = [&] { return restartFile(restart, std::to_string(rank)); };
    for (; isInParts(restart) && std::filesystem::exists(part()); rank += ranks)
    {
        files.push_back(part());
    }
    return files;
}

/// Measures the region of an insertion by the random numbers that also place the particles, as LIGGGHTS does once in
/// each process.
struct InsertionRegion : lmp::FixInsertPack
{
    static void measure(lmp::FixInsertPack& fix)
    {
        (fix.*&InsertionRegion::calc_region_volume_local)();
    }
};

/// A fix that has inserted all its particles has no next insertion, which LIGGGHTS writes as step 0. On reading, 0
/// would mean "not known": the fix would insert at once and then prevent every `run`.
void keepFinishedInsertionsFinished(const lmp::Modify& modify)
{
    constexpr lmp::bigint never = lmp::bigint(1) << 52;
    std::for_each(modify.fix, modify.fix + modify.nfix, [](lmp::Fix* fix) {
        if (std::string(fix->style).rfind("insert/", 0) == 0 && fix->next_reneighbor == 0)
        {
            fix->next_reneighbor = never;
        }
    });
}

/// Restores a fix from the bytes that the first rank writes to LIGGGHTS' restart files: their number and the state.
void restartFix(lmp::Fix& fix, MPI_Comm communicator)
{
    char* text = nullptr;
    std::size_t size = 0;
    FILE* const stream = open_memstream(&text, &size);
    fix.write_restart(stream);
    std::fclose(stream);
    std::vector<char> state(text, text + size);
    std::free(text);
    auto count = static_cast<int>(size);
    MPI_Bcast(&count, 1, MPI_INT, 0, communicator);
    state.resize(static_cast<std::size_t>(count));
    MPI_Bcast(state.data(), count, MPI_CHAR, 0, communicator);
    if (state.size() > sizeof(int))
    {
        fix.restart(state.data() + sizeof(int));
    }
}

/// LIGGGHTS writes less than the whole state of insertion fixes and their regions, so a resumed process would get other
/// random numbers than one that continues. The fixes of the continuing process therefore read their written state, too.
void restartInsertions(const lmp::LAMMPS& program)
{
    const lmp::Modify& modify = *program.modify;
    std::for_each(modify.fix, modify.fix + modify.nfix, [&](lmp::Fix* fix) {
        const std::string style = fix->style;
        const bool inserts = style.rfind("insert/", 0) == 0 || style.rfind("particle", 0) == 0;
        if (inserts && fix->restart_global)
        {
            restartFix(*fix, program.world);
        }
        if (auto* const inRegion = dynamic_cast<lmp::FixInsertPack*>(fix))
        {
            InsertionRegion::measure(*inRegion);
        }
    });
}

} // namespace

void requireUndamagedInput(const LiggghtsProgram& program, const ScriptCommand& command)
{
    if (!isCommand(command.text, "read_restart"))
    {
        return;
    }
    std::istringstream tokens(program.withVariables(command.text));
    std::string name;
    std::string file;
    if (!(tokens >> name >> file) || name != "read_restart" || file.find('*') != std::string::npos)
    {
        return;
    }
    const std::vector<std::filesystem::path> files = filesRead(file, program->comm->me, program->comm->nprocs);
    try
    {
        std::for_each(files.begin(), files.end(), requireUndamaged);
    }
    catch (const FileError& error)
    {
        throw DemEngineError(command.where + ": " + error.what());
    }
    if (isOtherThanRestart(files.front()))
    {
        throw DemEngineError(command.where + ": '" + command.text + "': " + files.front().string()
                             + " is no restart file; allowed: a file that LIGGGHTS' write_restart has written");
    }
}

std::vector<std::filesystem::path> writeRestart(LiggghtsProgram& program, const std::filesystem::path& name)
{
    keepFinishedInsertionsFinished(*program->modify);
    std::vector<std::filesystem::path> files = filesWritten(name, program->comm->me);
    std::list<FileThroughPipe> pipes;
    std::exception_ptr failure;
    const auto attempt = [&](const auto& step) {
        try
        {
            step();
        }
        catch (const FileError&)
        {
            failure = std::current_exception();
        }
    };
    attempt([&] {
        for (const std::filesystem::path& file : files)
        {
            pipes.emplace_back(file);
        }
    });
    // All ranks write or none does, because the others would wait for a rank that has no file.
    int ready = failure ? 0 : 1;
    MPI_Allreduce(MPI_IN_PLACE, &ready, 1, MPI_INT, MPI_MIN, program->world);
    if (ready != 0)
    {
        program.execute("write_restart " + FileThroughPipe::entrance(name).string(), "checkpoint");
        attempt([&] {
            std::for_each(pipes.begin(), pipes.end(), [](FileThroughPipe& pipe) { pipe.finish(); });
            if (program->comm->me == 0)
            {
                const std::vector<std::filesystem::path> boxes = writeSubdomains(program, name);
                files.insert(files.end(), boxes.begin(), boxes.end());
            }
        });
        restartInsertions(*program);
    }
    MPI_Barrier(program->world);
    if (failure)
    {
        std::rethrow_exception(failure);
    }
    return files;
}

} // namespace clepsydra
