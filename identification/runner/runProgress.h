#pragma once

#include <chrono>
#include <ostream>
#include <string>

namespace clepsydra::identification
{

/// A line per run that has ended: how many, how long still.
class RunProgress
{
public:
    /// \param secondsPerRun  a first guess
    RunProgress(std::ostream& out, std::size_t runs, int atOnce, double secondsPerRun);

    void ended(const std::string& purpose, const std::string& failure);

private:
    std::ostream& out_;
    std::size_t runs_;
    std::size_t done_ = 0;
    std::chrono::steady_clock::time_point since_;
};

/// 00:03:48
std::string clockTime(double seconds);

} // namespace clepsydra::identification
