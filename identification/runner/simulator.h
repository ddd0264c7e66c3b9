#pragma once

#include "curves/curve.h"
#include "runner/entries.h"

#include <string>
#include <vector>

namespace clepsydra::identification
{

/// One run that is wanted.
struct RunOrder
{
    std::string command;
    std::string file; // of the observable, relative to the case
    Entries entries;  // all that differ from the case's own
    long seed = 0;
    std::string purpose; // for people
};

struct RunResult
{
    Curve curve;
    std::string failure; // empty: none
    double seconds = 0.0;
    bool cached = false; // from the store, or the run of an equal order
};

/// Something that makes a curve of entries and a seed: a case directory with a program, or a formula in a test.
class Simulator
{
public:
    Simulator() = default;
    virtual ~Simulator() = default;
    Simulator(const Simulator&) = delete;
    Simulator& operator=(const Simulator&) = delete;

    /// What the case's file of parameters holds.
    virtual Entries defaults() const = 0;

    /// Executes all orders, in any order; a failure is a result, not an exception.
    virtual std::vector<RunResult> run(const std::vector<RunOrder>& orders) = 0;

    /// How many of the orders would have to be executed, not being stored yet.
    virtual int missing(const std::vector<RunOrder>& orders) = 0;
};

} // namespace clepsydra::identification
