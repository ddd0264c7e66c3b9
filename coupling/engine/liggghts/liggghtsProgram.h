#pragma once

#include <mpi.h>

#include <filesystem>
#include <memory>
#include <string>

namespace LAMMPS_NS
{
class LAMMPS;
}

namespace clepsydra
{

/// LIGGGHTS in this process, to which commands are given. Its own classes are behind `->`.
class LiggghtsProgram
{
public:
    /// \throws DemEngineError where it does not start
    LiggghtsProgram(const std::filesystem::path& logFile, MPI_Comm communicator);
    ~LiggghtsProgram();

    LiggghtsProgram(const LiggghtsProgram&) = delete;
    LiggghtsProgram& operator=(const LiggghtsProgram&) = delete;

    /// One command; \param where  named in the error.
    /// \throws DemEngineError with what LIGGGHTS said. After that only ending the program is safe.
    void execute(const std::string& command, const std::string& where);

    /// A command as LIGGGHTS reads it, the values of its variables put in.
    std::string withVariables(const std::string& command) const;

    /// " (the same)", for errors; nothing where a command has no variables.
    std::string valuesIn(const std::string& command) const;

    /// The floating-point exceptions that ended the program where the last command was given, see FloatingPointTraps.
    int trapsOutside() const
    {
        return trapsOutside_;
    }

    LAMMPS_NS::LAMMPS& operator*() const
    {
        return *program_;
    }

    LAMMPS_NS::LAMMPS* operator->() const
    {
        return program_.get();
    }

private:
    std::unique_ptr<LAMMPS_NS::LAMMPS> program_;
    int trapsOutside_ = 0;
    bool failed_ = false;
};

} // namespace clepsydra
