#include "engine/liggghts/liggghtsProgram.h"

#include "engine/demEngine.h"
#include "engine/liggghts/floatingPointTraps.h"
#include "engine/liggghts/librarySelfTest.h"
#include "engine/liggghts/liggghtsErrors.h"
#include "engine/liggghts/propertyReads.h"
#include "engine/liggghts/quietRegistration.h"

#include <input.h>
#include <lammps.h>

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

namespace clepsydra
{

namespace
{

/// For errors in which LIGGGHTS names a limit, but not the command that lifts it.
std::string remedyFor(const std::string& message)
{
    const auto isAbout = [&](const char* text) { return message.find(text) != std::string::npos; };
    if (isAbout("Too many atom sorting bins"))
    {
        return "; allowed: a smaller box, or 'atom_modify sort 0 0' in the script, because LIGGGHTS sorts the "
               "particles "
               "by bins of half the neighbour distance, which fill the whole box";
    }
    if (isAbout("Too many neighbor bins") || isAbout("Domain too large for neighbor bins"))
    {
        return "; allowed: a smaller box, or 'neigh_modify binsize <length>' in the script with longer bins, which "
               "fill "
               "the whole box";
    }
    return {};
}

} // namespace

LiggghtsProgram::LiggghtsProgram(
    const std::filesystem::path& logFile, MPI_Comm communicator, std::function<void(const std::string&)> onWarning)
    : onWarning_(std::move(onWarning))
{
    replaceLiggghtsErrors();
    recordPropertyReads();
    testLiggghtsLibrary();
    // The screen output must go to a file, because `-screen none` crashes fix mesh/surface of LIGGGHTS 3.8.
    std::vector<std::string> words{"liggghts", "-log", logFile.string(), "-screen", "/dev/null"};
    std::vector<char*> arguments;
    arguments.reserve(words.size());
    for (std::string& word : words)
    {
        arguments.push_back(word.data());
    }
    try
    {
        const QuietRegistration quiet;
        program_ =
            std::make_unique<LAMMPS_NS::LAMMPS>(static_cast<int>(arguments.size()), arguments.data(), communicator);
    }
    catch (const LiggghtsStopped& stopped)
    {
        throw DemEngineError(std::string("LIGGGHTS did not start: ") + stopped.what());
    }
    forgetPropertyReads(*program_); // of an earlier instance at the same address
    if (program_->screen != nullptr)
    {
        screen_ = std::exchange(program_->screen, warnings_.stream());
    }
}

LiggghtsProgram::~LiggghtsProgram()
{
    // After an error LIGGGHTS is in the middle of a command, and its destructors may wait for other ranks.
    if (failed_)
    {
        static_cast<void>(program_.release());
        return;
    }
    if (screen_ != nullptr)
    {
        program_->screen = screen_;
    }
    forgetPropertyReads(*program_);
}

void LiggghtsProgram::execute(const std::string& command, const std::string& where, Warnings warnings)
{
    const FloatingPointTraps none(0);
    trapsOutside_ = none.before();
    try
    {
        program_->input->one(command.c_str());
        if (warnings == Warnings::reported)
        {
            reportWarnings(where);
        }
        else
        {
            static_cast<void>(warnings_.take());
        }
    }
    catch (const DemEngineError&)
    {
        failed_ = true;
        throw;
    }
    catch (const LiggghtsStopped& stopped)
    {
        failed_ = true;
        reportWarnings(where);
        std::string message = where + ": LIGGGHTS stopped at '" + command + "'" + valuesIn(command) + ": "
                              + stopped.what() + remedyFor(stopped.what());
        if (stopped.onOneRankOnly())
        {
            message += " (reported by one rank)";
        }
        throw DemEngineError(message);
    }
}

void LiggghtsProgram::reportWarnings(const std::string& where)
{
    for (const std::string& warning : warnings_.take())
    {
        warn(where + ": LIGGGHTS warns: " + warning);
    }
}

void LiggghtsProgram::warn(const std::string& warning) const
{
    if (onWarning_)
    {
        onWarning_(warning);
    }
}

std::string LiggghtsProgram::withVariables(const std::string& command) const
{
    constexpr int flagOfScripts = 0;
    int size = static_cast<int>(command.size()) + 1;
    int workSize = size;
    auto* text = static_cast<char*>(std::malloc(command.size() + 1));
    auto* work = static_cast<char*>(std::malloc(command.size() + 1));
    std::copy_n(command.c_str(), command.size() + 1, text);
    try
    {
        program_->input->substitute(text, work, size, workSize, flagOfScripts);
    }
    catch (const LiggghtsStopped&)
    {
        // The command has an unknown variable. LIGGGHTS reports it when it executes the command.
    }
    std::string result = text;
    std::free(text);
    std::free(work);
    return result;
}

std::string LiggghtsProgram::valuesIn(const std::string& command) const
{
    const std::string text = withVariables(command);
    return text == command ? std::string() : " (" + text + ')';
}

} // namespace clepsydra
