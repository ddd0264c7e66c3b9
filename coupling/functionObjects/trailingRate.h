#pragma once

#include <deque>
#include <utility>

namespace clepsydra
{

/// Rate at which an amount decreases, as the mean over a trailing time window; the derivative itself would be a series
/// of peaks, one per particle.
class TrailingRate
{
public:
    /// \param window  length of the window [s], >= 0; zero: since the last sample
    explicit TrailingRate(double window)
        : window_(window)
    {}

    /// Adds a sample; times must increase.
    /// \return -(change of the amount)/(time passed) since the latest sample that is at least a window old, or since
    /// the first one where none is; 0 for the first sample
    double add(double time, double amount)
    {
        // Sums of time steps miss the start of the window by rounding.
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

    /// Samples that later rates need: the state from which a resumed run continues.
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
