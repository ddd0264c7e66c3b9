#include "run/progress.h"

#include "Pstream.H"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace clepsydra
{

namespace
{

constexpr std::chrono::milliseconds barInterval{200};
constexpr std::size_t barLength = 24;

/// Width of the terminal. A longer line would wrap and could not be rewritten in place.
std::size_t terminalWidth()
{
    winsize size{};
    return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string bar(double share)
{
    const auto full = static_cast<std::size_t>(std::lround(std::clamp(share, 0.0, 1.0) * barLength));
    return '[' + std::string(full, '=') + std::string(barLength - full, ' ') + "] ";
}

std::string clockTime(double seconds)
{
    const long all = std::lround(seconds);
    std::ostringstream text;
    text << std::setfill('0') << std::setw(2) << all / 3600 << ':' << std::setw(2) << all / 60 % 60 << ':'
         << std::setw(2) << all % 60;
    return text.str();
}

double shareDone(const ProgressState& state)
{
    const double all = state.endTime - state.startTime;
    return all > 0 ? (state.time - state.startTime) / all : 1.0;
}

/// Whether standard output is a terminal. mpirun gives its ranks a pseudo-terminal even where its own output goes to a
/// file, so mpirun's output is examined in that case.
bool outputIsTerminal()
{
    if (isatty(STDOUT_FILENO) != 1)
    {
        return false;
    }
    if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr)
    {
        return true;
    }
    std::error_code unknown;
    const std::string output =
        std::filesystem::read_symlink("/proc/" + std::to_string(getppid()) + "/fd/1", unknown).string();
    return output.rfind("/dev/pts/", 0) == 0 || output.rfind("/dev/tty", 0) == 0;
}

} // namespace

std::string describe(const ProgressState& state)
{
    std::ostringstream text;
    text << "t = " << std::setprecision(4) << state.time << '/' << state.endTime << " s";
    if (state.particles >= 0)
    {
        text << ", " << state.particles << " particles in the hopper";
    }
    const double simulated = state.time - state.startTime;
    if (simulated > 0 && state.wallTime > 0)
    {
        const double wallPerSimulated = state.wallTime / simulated;
        text << ", " << std::setprecision(3) << wallPerSimulated << " s per simulated s";
    }
    if (state.wallLeft >= 0)
    {
        text << ", " << clockTime(state.wallLeft) << " to go";
    }
    return text.str();
}

Progress::Progress()
    : Progress(std::cout, outputIsTerminal())
{}

Progress::Progress(std::ostream& out, bool isTerminal)
    : out_(out),
      isTerminal_(isTerminal)
{}

Progress::~Progress()
{
    clear();
}

void Progress::update(double time, double endTime, long particlesInHopper, double wallLeft, bool atWriteTime)
{
    if (!Foam::Pstream::master())
    {
        return;
    }
    const Clock::time_point now = Clock::now();
    if (!started_)
    {
        started_ = true;
        startTime_ = time;
        wallStart_ = now;
    }
    const ProgressState state{time, startTime_, endTime, std::chrono::duration<double>(now - wallStart_).count(),
        particlesInHopper, wallLeft};

    if (atWriteTime)
    {
        clear();
        out_ << describe(state) << std::endl;
    }
    if (isTerminal_ && (lastBar_ == Clock::time_point{} || now - lastBar_ >= barInterval))
    {
        // The cursor stays at the start of the line, so that the next output replaces the bar.
        out_ << '\r' << (bar(shareDone(state)) + describe(state)).substr(0, terminalWidth() - 1) << "\x1b[K\r"
             << std::flush;
        barShown_ = true;
        lastBar_ = now;
    }
}

void Progress::clear()
{
    if (barShown_)
    {
        out_ << "\r\x1b[K" << std::flush;
        barShown_ = false;
    }
}

} // namespace clepsydra
