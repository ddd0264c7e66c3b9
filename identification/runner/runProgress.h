#pragma once

#include <chrono>
#include <ostream>
#include <string>

namespace clepsydra::identification
{

/// Writes one line per finished run with the number of runs and the remaining time.
class RunProgress
{
public:
    /// \param secondsPerRun  first estimate of the wall-clock time of a run [s]
    RunProgress(std::ostream& out, std::size_t runs, int atOnce, double secondsPerRun);

    void ended(const std::string& purpose, const std::string& failure);

private:
    std::ostream& out_;
    std::size_t runs_;
    std::size_t done_ = 0;
    std::chrono::steady_clock::time_point since_;
};

/// Seconds as hours, minutes and seconds: "00:03:48".
std::string clockTime(double seconds);

} // namespace clepsydra::identification
