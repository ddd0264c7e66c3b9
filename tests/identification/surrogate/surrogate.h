#pragma once

#include "curves/curve.h"
#include "runner/entries.h"
#include "runner/simulator.h"

namespace clepsydra::identification::tests
{

/// A hopper as an ordinary differential equation, in place of the real solver where hundreds of studies are made: the
/// mass in it against time, with a rate that wanders from run to run as grains' does. Made up, but with the signs and
/// sizes that the real one has (dry and submerged, particle size, orifice, friction of several kinds).
Curve discharge(const Entries& entries);

/// The same without a program: for the statistics.
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
