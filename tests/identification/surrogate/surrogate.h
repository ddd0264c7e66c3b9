#pragma once

#include "curves/curve.h"
#include "study/entries.h"
#include "runner/simulator.h"

namespace clepsydra::identification::tests
{

/// Surrogate of the hopper for statistics over hundreds of studies: an ordinary differential equation for the mass in
/// the hopper, with a rate that fluctuates from run to run. The equation is synthetic, but its effects have the signs
/// and sizes of the real ones (dry and submerged, particle size, orifice, friction of several kinds).
/// \return the mass [kg] as a function of time [s]
Curve discharge(const Entries& entries);

/// The surrogate as a simulator that needs no case and no processes.
class SurrogateSimulator final : public Simulator
{
public:
    explicit SurrogateSimulator(Entries defaults);

    Entries defaults() const override;
    std::vector<RunResult> run(const std::vector<RunOrder>& orders) override;
    int missing(const std::vector<RunOrder>& orders) override;

private:
    Entries defaults_;
};

} // namespace clepsydra::identification::tests
