#pragma once

#include "engine/liggghts/screenWarnings.h"

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace LAMMPS_NS
{
class LAMMPS;
}

namespace clepsydra
{

/// LIGGGHTS in this process, which executes commands. Its own classes are accessible by `->`.
class LiggghtsProgram
{
public:
    /// \param onWarning  called on the first rank with each warning that LIGGGHTS prints; may be empty
    /// \throws DemEngineError where LIGGGHTS does not start
    LiggghtsProgram(
        const std::filesystem::path& logFile, MPI_Comm communicator, std::function<void(const std::string&)> onWarning);
    ~LiggghtsProgram();

    LiggghtsProgram(const LiggghtsProgram&) = delete;
    LiggghtsProgram& operator=(const LiggghtsProgram&) = delete;

    /// What happens to LIGGGHTS' warnings about a command.
    enum class Warnings
    {
        reported,
        dropped
    };

    /// Executes one command.
    /// \param where  place of the command, for the error message
    /// \throws DemEngineError with LIGGGHTS' own message; after that the program can only end
    void execute(const std::string& command, const std::string& where, Warnings warnings = Warnings::reported);

    /// Passes on a warning. \pre on the first rank
    void warn(const std::string& warning) const;

    /// The command with the values of its variables, as LIGGGHTS reads it.
    std::string withVariables(const std::string& command) const;

    /// " (command with values)" for error messages; empty where a command has no variables.
    std::string valuesIn(const std::string& command) const;

    /// Floating-point exceptions that ended the program when the last command was called, see FloatingPointTraps.
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
    void reportWarnings(const std::string& where);

    ScreenWarnings warnings_;
    std::function<void(const std::string&)> onWarning_;
    std::unique_ptr<LAMMPS_NS::LAMMPS> program_;
    /// LIGGGHTS' own stream, in whose place it prints to `warnings_`.
    FILE* screen_ = nullptr;
    int trapsOutside_ = 0;
    bool failed_ = false;
};

} // namespace clepsydra
