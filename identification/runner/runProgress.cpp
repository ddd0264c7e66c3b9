#include "runner/runProgress.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace clepsydra::identification
{

RunProgress::RunProgress(std::ostream& out, std::size_t runs, int atOnce, double secondsPerRun)
    : out_(out),
      runs_(runs),
      since_(std::chrono::steady_clock::now())
{
    const double rounds = std::ceil(static_cast<double>(runs) / std::max(atOnce, 1));
    out_ << runs << (runs == 1 ? " run" : " runs") << ", " << atOnce << " at a time, about "
         << clockTime(rounds * secondsPerRun) << std::endl;
}

void RunProgress::ended(const std::string& purpose, const std::string& failure)
{
    ++done_;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - since_).count();
    const double left = seconds / static_cast<double>(done_) * static_cast<double>(runs_ - done_);
    // The lines that follow are the end of the run's log, which the report has.
    const std::string reason = failure.substr(0, failure.find('\n'));
    out_ << "  " << done_ << '/' << runs_ << ' ' << purpose << (reason.empty() ? "" : " FAILED: " + reason) << ", "
         << clockTime(left) << " to go" << std::endl;
}

std::string clockTime(double seconds)
{
    const long all = std::lround(std::max(0.0, seconds));
    std::ostringstream text;
    text << std::setfill('0') << std::setw(2) << all / 3600 << ':' << std::setw(2) << all / 60 % 60 << ':'
         << std::setw(2) << all % 60;
    return text.str();
}

} // namespace clepsydra::identification
