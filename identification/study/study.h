#pragma once

#include "curves/curve.h"
#include "features/features.h"
#include "lists.h"
#include "study/entries.h"
#include "study/expression.h"

#include <Eigen/Core>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Range of an effect's amplitude.
struct Bounds
{
    double lower = 0.0;
    double upper = 1.0;

    /// Largest magnitude in the range.
    double reach() const
    {
        return std::max(upper, -lower);
    }
};

/// File of a case with its entries.
constexpr const char* entriesFile = "parameters";

/// The simulator: a case that can be run.
struct SimulatorSpecification
{
    std::filesystem::path caseFolder;
    std::string command = "./Allrun";
    Entries entries;                              // set in all runs
    std::string seedEntry;                        // entry of the seed; empty: there is none
    std::vector<std::filesystem::path> dependsOn; // files outside the case that its results depend on
    double costPerRun = 60.0;                     // estimated time of a run until one has been measured [s]
    double timeLimit = 0.0;                       // of a run [s]; 0: no limit

    /// Whether repeated runs differ.
    bool scatters() const
    {
        return !seedEntry.empty();
    }
};

/// Where a prior comes from. Only the first is called a measurement.
enum class Origin
{
    measured, // an independent measurement, of these particles or this fluid
    handbook, // a published value for the material
    guess     // none of these, or chosen after a look at the data
};

/// As study files write them, in the sequence of Origin.
inline std::vector<std::string> namesOfOrigins()
{
    return {"measured", "handbook", "guess"};
}

inline std::string nameOf(Origin origin)
{
    return namesOfOrigins()[static_cast<std::size_t>(origin)];
}

/// A normal distribution.
struct Normal
{
    double mean = 0.0;
    double sd = 0.0;
};

/// A fitted parameter, which has one value in all conditions.
struct Parameter
{
    std::string name;
    std::string unit;                          // for the report
    std::map<std::string, Expression> entries; // formulas in the parameter's name
    double mean = 0.0;                         // of the prior
    double sd = 0.0;
    Origin from = Origin::guess; // of the prior
    double lower = 0.0;          // physical limits, which simulations keep
    double upper = 0.0;
    /// Effect that it belongs to, as the height of a layer's edge does; without the effect, the parameter has no
    /// influence.
    std::optional<std::size_t> effect;

    /// The value at a number of standard deviations from the prior's mean, within the limits.
    double at(double sds) const
    {
        return std::clamp(mean + sds * sd, lower, upper);
    }

    /// The physical limits from the prior's mean, over its standard deviation.
    Bounds boundsInSds() const
    {
        return {(lower - mean) / sd, (upper - mean) / sd};
    }
};

/// Largest number of parameters, so that vectors of parameters need no memory allocation.
constexpr int mostParameters = 12;

/// An effect that the model may lack or that the measuring chain may add. It is defined in the study file.
struct Effect
{
    std::string name;
    std::string meaning;
    std::string hint;                               // how to measure it independently
    std::string family;                             // common to variants of one physical effect; may be empty
    std::map<std::string, Expression> entries;      // formulas in the entries and, but for a switch, the amplitude a
    std::map<std::string, std::string> textEntries; // values that a switch sets, as text
    std::string chainOperation;          // operation of the measuring chain; empty: an effect of the simulator
    std::optional<Expression> chainSize; // formula in a
    Bounds bounds;                       // of the amplitude; [0, 1] for a switch
    std::optional<Normal> measured;      // independent measurement of the amplitude, which is then its prior
    bool isSwitch = false;               // on or off
    bool raisesScatter = false;          // whether it raises the scatter of runs
    double prior = 1.0;                  // relative prior weight
    std::map<std::string, std::vector<std::string>> actsIn; // values by tag; empty: it acts in all conditions

    bool isOfChain() const
    {
        return !chainOperation.empty();
    }
};

enum class Role
{
    training,
    heldOut,
    candidate
};

/// A column of a measured file, and its conversion to SI units.
struct ColumnSpecification
{
    std::string column;
    double factor = 1.0; // includes that of the unit
    double offset = 0.0;
    double lowest = 0.0; // valid range; values outside are missing. Equal limits: all values are valid
    double highest = 0.0;
    std::string unit = {}; // as stated, and its size in SI units
    double siUnits = 1.0;
};

/// Measured values of a feature, for measurements that give no curve.
struct MeasuredNumber
{
    std::size_t feature;
    std::vector<double> values; // repeats, as the feature defines them (logarithms taken)
    double standardError = 0.0; // of each value, in addition to the scatter of repeats
    std::string unit;           // as stated, and its size in SI units
    double siUnits = 1.0;
};

struct Measurement
{
    std::vector<std::filesystem::path> files; // one repeat per file
    ColumnSpecification time;
    ColumnSpecification value;
    std::vector<MeasuredNumber> numbers;

    bool empty() const
    {
        return files.empty() && numbers.empty();
    }
};

/// Scale of the observable: the output of the simulation is multiplied by the factor, and the offset is added (SI
/// units). Both are formulas in the entries of the run: "-particleDiameter/2" gives the gap below a particle.
struct ObservableScale
{
    Expression factor{"1"};
    Expression offset{"0"};
};

struct Condition
{
    std::string name;
    Role role = Role::training;
    Entries entries;
    std::map<std::string, std::string> tags;
    std::map<std::string, double> coordinates; // for the Gaussian process of control 2
    std::string command;                       // empty: that of the simulator
    std::string file;                          // the observable's file, relative to the case
    ObservableScale observable;
    Measurement measured;
    double cost = 1.0; // relative cost of a measurement, for the choice of the next experiment
};

/// Whether an effect acts in a condition, according to the condition's tags.
inline bool acts(const Effect& effect, const Condition& condition)
{
    return std::all_of(effect.actsIn.begin(), effect.actsIn.end(), [&](const auto& rule) {
        const auto tag = condition.tags.find(rule.first);
        return tag != condition.tags.end() && contains(rule.second, tag->second);
    });
}

/// A common (systematic) error (docs/reference/study.md), of entries or of the measuring chain. It is not fitted, cannot
/// be named as a cause, and enters the covariance only: to first order, with g = d(feature)/dz stacked over features and
/// conditions, it adds g g^T to the covariance of the measured means, including the blocks between conditions. Its z is
/// independent of parameters, effects, noise, model errors and all other common errors.
struct CommonError
{
    std::string name;
    std::vector<std::size_t> conditions;
    /// Variable of the formulas, and its value at z = 1: for an effect that was measured with a gauge, its amplitude a
    /// and the standard error of the measurement.
    std::string variable = "z";
    double unit = 1.0;
    std::map<std::string, Expression> entries; // z = 0 gives the entries themselves
    std::string chainOperation;                // applied after those of effects; empty if the error is not of the chain
    std::optional<Expression> chainSize;       // 0 at z = 0
};

struct ExecutorSpecification
{
    std::string kind = "pool";        // or slurm
    int processes = 0;                // number of jobs at a time; 0: one per core
    std::vector<std::string> options; // further options of sbatch
};

struct Settings
{
    int budget = 1000; // largest number of runs
    unsigned seed = 1;
    int repeatsBase = 6;  // runs at the base setting of a condition
    int repeatsAlone = 5; // runs with an effect alone, in each condition
    int decidingRuns = 9; // mean number per training condition for one data set; 0: the library alone decides
    int repeatsHeldOut = 3;
    int attempts = 3;                            // at a run that fails, each with another seed
    double level = 0.05;                         // significance level of the test for a residual
    int draws = 1000;                            // from the null distribution of the test
    double coverage = 0.9;                       // probability that the set contains the true effect
    double wrongNames = 0.05;                    // allowed share of wrong names among detected unlisted causes
    std::string oneMoreParameter = "timeFactor"; // control 1: operation of the measuring chain
    std::string onFailure = "exclude";           // or stop
};

/// An effect that is left out, and why.
struct LeftOut
{
    std::string name;
    std::string reason;

    std::string text() const
    {
        return name + " (" + reason + ')';
    }
};

struct Study
{
    std::string name;
    std::filesystem::path file;
    std::filesystem::path work; // cache and runs
    SimulatorSpecification simulator;
    std::string timeColumn;
    std::string valueColumn;
    std::vector<std::string> furtherColumns; // that features are taken from, in the observable's file
    double magnitudeLimit =
        30.0; // largest factor between measured and simulated values; a larger one means wrong units
    std::vector<Feature> features;
    Eigen::VectorXd modelError; // by feature
    std::vector<Condition> conditions;
    std::vector<Parameter> parameters;
    std::vector<Effect> effects;
    std::vector<CommonError> commonErrors;
    ExecutorSpecification executor;
    Settings settings;
    std::vector<std::string> assumptions; // sentences of the user, which the report repeats
    std::vector<LeftOut> leftOut;         // effects that are left out

    /// Indices of the conditions with a role.
    std::vector<std::size_t> conditionsOf(Role role) const
    {
        return numbersWhere(conditions.size(), [&](std::size_t c) { return conditions[c].role == role; });
    }
    Eigen::Index featureCount() const
    {
        return static_cast<Eigen::Index>(features.size());
    }
};

} // namespace clepsydra::identification
