#pragma once

#include <cstdio>
#include <set>
#include <string>
#include <vector>

namespace clepsydra
{

/// A stream for LIGGGHTS' screen output that keeps the warnings in it and drops the rest.
class ScreenWarnings
{
public:
    ScreenWarnings();
    ~ScreenWarnings();

    ScreenWarnings(const ScreenWarnings&) = delete;
    ScreenWarnings& operator=(const ScreenWarnings&) = delete;

    FILE* stream() const
    {
        return stream_;
    }

    /// The warnings since the last call, without the place in LIGGGHTS' source. A warning that differs from an earlier
    /// one in its numbers only is left out, because LIGGGHTS may repeat it in every step.
    std::vector<std::string> take();

private:
    void add(const std::string& output);

    FILE* stream_;
    std::string unfinishedLine_;
    std::vector<std::string> warnings_;
    std::set<std::string> known_;
};

} // namespace clepsydra
