#pragma once

#include <deque>
#include <utility>

namespace clepsydra
{

/// How fast an amount falls, as the mean over a trailing window: single particles make its derivative a row of spikes.
class TrailingRate
{
public:
    /// \param window  [s], >= 0; zero: since the last sample.
    explicit TrailingRate(double window)
        : window_(window)
    {}

    /// Adds a sample; times must rise.
    /// \return -(change of the amount)/(time passed) since the latest sample that is at least a window old, or since
    ///         the first where none is; 0 for the first sample.
    double add(double time, double amount)
    {
        // Sums of time steps miss the end of the window by rounding.
        const double start = time - window_ * (1 - 1e-9);
        while (samples_.size() > 1 && samples_[1].time <= start)
        {
            samples_.pop_front();
        }
        samples_.push_back({time, amount});
        const Sample& first = samples_.front();
        return samples_.size() > 1 ? (first.amount - amount) / (time - first.time) : 0.0;
    }

    struct Sample
    {
        double time;
        double amount;
    };

    /// Those that later rates need: the state that a resumed run goes on with.
    const std::deque<Sample>& samples() const
    {
        return samples_;
    }

    void resume(std::deque<Sample> samples)
    {
        samples_ = std::move(samples);
    }

private:
    double window_;
    std::deque<Sample> samples_;
};

} // namespace clepsydra
