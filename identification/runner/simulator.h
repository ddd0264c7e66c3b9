#pragma once

#include "curves/curve.h"
#include "study/entries.h"

#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Order for one run.
struct RunOrder
{
    std::string command;
    std::string file; // the observable's file, relative to the case
    Entries entries;  // entries that differ from those of the case
    long seed = 0;
    std::string purpose; // for progress messages and records
};

struct RunResult
{
    Curve curve;
    std::string failure; // message; empty if the run succeeded
    double seconds = 0.0;
    bool cached = false; // taken from the store or from an equal order
};

/// Simulator of the experiment: from entries and a seed it computes the curve of the observable. It is a case directory
/// with its solver, or a formula in a test.
class Simulator
{
public:
    Simulator() = default;
    virtual ~Simulator() = default;
    Simulator(const Simulator&) = delete;
    Simulator& operator=(const Simulator&) = delete;

    /// Entries of the case's parameter file.
    virtual Entries defaults() const = 0;

    /// Executes all orders and returns their results in the same sequence. A failed run is a result, not an exception.
    virtual std::vector<RunResult> run(const std::vector<RunOrder>& orders) = 0;

    /// Number of the orders whose results are not stored yet.
    virtual int missing(const std::vector<RunOrder>& orders) = 0;
};

} // namespace clepsydra::identification
