#pragma once

#include "decision/evidence.h"

#include <deque>
#include <random>
#include <vector>

namespace clepsydra::identification
{

/// Synthetic data for the calibration. Forty draws from the posterior serve as known truths: for each, library and
/// emulator are regenerated, and this emulator judges data that follow the draw. The judging emulator has errors like
/// those of the real one, whereas data that follow the real emulator itself would hide these errors.
///
/// If runs do not scatter, the data follow the emulator with its uncertainty near the fits, where the runs have been
/// made; the large uncertainty far from all runs must not be taken for chance.
class Replicas
{
public:
    /// \param evidence  of the same emulator; emulator, layout and evidence must outlive this object
    Replicas(const Emulator& emulator, const Layout& layout, const Evidence& evidence, std::mt19937_64& random);

    /// Synthetic data, and the evidence of the emulator that judges them. The posterior draws are used in turn.
    struct Trial
    {
        Measured data;
        const Evidence& judge;
    };
    Trial draw(const std::vector<Present>& present, const Eigen::VectorXd& parameters, std::mt19937_64& random);
    Trial drawOther(double size, const Eigen::VectorXd& parameters, std::mt19937_64& random);

private:
    struct Replica
    {
        Emulator truth;
        Emulator learnt;
        Evidence judge;

        Replica(const Emulator& emulator, const Evidence& evidence, std::mt19937_64& random);
    };

    const Emulator& emulator_;
    const Layout& layout_;
    const Evidence& evidence_;
    std::deque<Replica> all_; // each refers to itself, and must not move
    std::size_t turn_ = 0;
};

} // namespace clepsydra::identification
