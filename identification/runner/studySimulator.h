#pragma once

#include "runner/simulator.h"
#include "study/study.h"

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Values of all parameters and effects of a simulation.
struct Setting
{
    Eigen::VectorXd parameters;  // physical values
    Eigen::VectorXd amplitudes;  // of all effects, including those of the measuring chain
    Eigen::VectorXd errors = {}; // of the study's common errors, in standard deviations; empty: all zero
};

/// Seed of a run, a hash of the arguments: a prime from 11003 on; LIGGGHTS requires one above 10000.
long seedOf(unsigned studySeed, const std::string& purpose, const std::string& condition, int number);

/// Purpose of the runs that check the units of the measurements. They are the library's first runs and are counted there.
inline constexpr const char* checkOfUnits = "check of units";

/// Order for one simulation. Its seed is a hash of `seeds` (of `purpose`, if that is empty), condition and number.
struct SimulationOrder
{
    std::size_t condition = 0;
    Setting setting;
    std::string purpose;
    int number = 0;
    std::string seeds = {};
};

struct Simulation
{
    std::size_t condition = 0;
    Setting setting;
    Eigen::VectorXd features; // NaN where the curve lacks a feature; all NaN if the run has failed
    Curve curve;              // behind the measuring chain
    Curve plain;              // before the measuring chain
    bool failed = false;
};

/// A failed run.
struct Failure
{
    std::string purpose;
    std::string condition;
    long seed = 0;
    std::string reason;
    bool repeated = false; // a later attempt with another seed succeeded
};

/// Number, seeds, failures and wall-clock time (summed over runs) of the simulations made so far.
struct Effort
{
    std::map<std::string, int> runsByPurpose;
    std::map<std::string, std::vector<long>> seedsByPurpose;
    std::vector<Failure> failures;
    int executed = 0;             // runs that were made; the others were taken from the store
    double seconds = 0.0;         // of the executed runs
    double secondsOfStored = 0.0; // of the stored runs, when they were made

    /// ": " and why the last of the failed runs failed; empty if none did
    std::string lastFailure() const
    {
        return failures.empty() ? "" : ": " + failures.back().reason;
    }
};

/// The simulator as the study describes it: translates settings into entries of the case, runs the simulator, applies
/// the measuring chain to the curves and evaluates the features.
class StudySimulator
{
public:
    StudySimulator(const Study& study, Simulator& simulator);

    /// A setting without effects. \param parameters  physical values; empty: the priors' means
    Setting plainSetting(const Eigen::VectorXd& parameters = {}) const;

    /// Results of all orders, in the same sequence. Failed runs are repeated with other seeds, as often as the study
    /// allows.
    /// \throws std::runtime_error if the budget is exceeded, or if a run fails and the study says `failures.then: stop`
    std::vector<Simulation> run(const std::vector<SimulationOrder>& orders);

    /// Makes `repeats` runs of one setting in each of the conditions. \param seeds  as in SimulationOrder
    std::vector<Simulation> repeats(const std::vector<std::size_t>& conditions, const Setting& setting,
        const std::string& purpose, int repeats, const std::string& seeds = {});

    /// Entries of a run. \throws std::runtime_error naming the effect whose formula gives no number
    Entries entriesOf(std::size_t condition, const Setting& setting) const;

    Curve throughChain(Curve curve, std::size_t condition, const Setting& setting) const;
    Eigen::VectorXd featuresOf(const Curve& curve) const;

    /// Number of the orders whose results are not stored yet.
    int missing(const std::vector<SimulationOrder>& orders);

    Simulator& simulator() const
    {
        return simulator_;
    }
    const Study& study() const
    {
        return study_;
    }
    const Effort& effort() const
    {
        return effort_;
    }

private:
    Curve observed(Curve curve, std::size_t condition, const Entries& entries) const;
    RunOrder runOrder(const SimulationOrder& order, int attempt) const;
    void requireBudget(int more, const std::string& purpose) const;

    const Study& study_;
    Simulator& simulator_;
    Entries defaults_;
    Effort effort_;
};

} // namespace clepsydra::identification
