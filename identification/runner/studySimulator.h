#pragma once

#include "runner/simulator.h"
#include "study/study.h"

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Where in the space of parameters and effects a simulation stands.
struct Setting
{
    Eigen::VectorXd parameters;  // physical values
    Eigen::VectorXd amplitudes;  // of all effects, those of the measuring chain too
    Eigen::VectorXd errors = {}; // z of the study's common errors; empty: all zero
};

/// A simulation that is wanted; its seed follows from seeds (or, where that is empty, purpose), condition and number.
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
    Eigen::VectorXd features; // NaN where the curve does not have it, all of them where the run has failed
    Curve curve;              // as the measuring chain shows it
    Curve plain;              // as simulated, in the observable's scale
    long seed = 0;
    bool failed = false;
};

/// A run that failed, with all that was tried.
struct Failure
{
    std::string purpose;
    std::string condition;
    long seed = 0;
    std::string reason;
    bool repeated = false; // a later attempt with another seed succeeded
};

/// What simulations took.
struct Effort
{
    std::map<std::string, int> runsByPurpose;
    std::map<std::string, std::vector<long>> seedsByPurpose;
    std::vector<Failure> failures;
    int executed = 0; // of the runs; the others were stored
    double seconds = 0.0;
    double secondsOfStored = 0.0; // what they took when they were made
};

/// Turns settings into entries of the case, lets the simulator run them, applies the measuring chain and takes the features.
class StudySimulator
{
public:
    StudySimulator(const Study& study, Simulator& simulator);

    /// A setting without any effect. \param parameters  physical values; empty: the priors' means
    Setting plainSetting(const Eigen::VectorXd& parameters = {}) const;

    /// All orders, in their order. Failed runs are repeated with other seeds as the study's settings say.
    /// \throws std::runtime_error above the budget, or on a failed run where the study says `onFailure: stop`
    std::vector<Simulation> run(const std::vector<SimulationOrder>& orders);

    /// `repeats` runs of one setting in each of the conditions. \param seeds  as in SimulationOrder
    std::vector<Simulation> repeats(const std::vector<std::size_t>& conditions, const Setting& setting,
        const std::string& purpose, int repeats, const std::string& seeds = {});

    /// Entries of a run. \throws std::runtime_error that names the effect whose formula fails
    Entries entriesOf(std::size_t condition, const Setting& setting) const;

    Curve throughChain(Curve curve, std::size_t condition, const Setting& setting) const;
    Eigen::VectorXd featuresOf(const Curve& curve) const;

    /// How many of the orders are not stored yet.
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

    const Study& study_;
    Simulator& simulator_;
    Entries defaults_;
    Effort effort_;
};

} // namespace clepsydra::identification
