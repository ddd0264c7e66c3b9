#pragma once

#include "decision/evidence.h"

#include <memory>
#include <random>
#include <vector>

namespace clepsydra::identification
{

/// The whole procedure in worlds that are known: in each the runs are made again, another emulator learns from them, and
/// judges data drawn of that world. What the emulator gets wrong here it gets wrong there, in the same ways; data drawn of the
/// emulator itself would find it right. Where runs do not scatter there is one world, as it looks from the fits: the rounds of
/// runs have gone there, and would go to those of other data; what is not known far from all runs must not pass for chance.
class Replicas
{
public:
    /// \param evidence  of the emulator that is replicated; must live as long as this
    Replicas(const Emulator& emulator, const Layout& layout, const Evidence& evidence, std::mt19937_64& random);

    /// Data of one world after the other, and the judge that goes with it.
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
        Emulator world;
        Emulator learnt;
        std::unique_ptr<Evidence> judge;
    };

    const Emulator& emulator_;
    const Layout& layout_;
    const Evidence& evidence_;
    std::vector<std::unique_ptr<Replica>> all_;
    std::size_t turn_ = 0;
};

} // namespace clepsydra::identification
