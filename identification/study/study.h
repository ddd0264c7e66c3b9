#pragma once

#include "curves/curve.h"
#include "features/features.h"
#include "runner/entries.h"
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

    /// The largest size, to either side.
    double reach() const
    {
        return std::max(upper, -lower);
    }
};

/// A case that can be run.
struct SimulatorSpecification
{
    std::filesystem::path caseFolder;
    std::string command = "./Allrun";
    std::string entriesFile = "parameters";
    Entries entries;                              // set in every run
    std::string seedEntry;                        // empty: runs do not scatter
    std::vector<std::filesystem::path> dependsOn; // files beside the case whose content enters the key of a run
    std::string version;                          // text that enters it as well
    double costPerRun = 60.0;                     // [s], until runs have been timed
    double timeLimit = 0.0;                       // [s]; 0: none
};

/// A parameter that all conditions share and that is fitted.
struct Parameter
{
    std::string name;
    std::string unit;                          // for people
    std::map<std::string, Expression> entries; // formulas in the parameter's name
    double mean = 0.0;                         // of its prior, an independent measurement
    double sd = 0.0;
    double lower = 0.0; // limits of what is physical; simulations stay within
    double upper = 0.0;
    std::optional<std::size_t>
        effect; // of which it is a part, as the height of a layer's edge: without it, it does nothing
};

/// Vectors of them need no memory of their own.
constexpr int mostParameters = 12;

/// What the model may lack, or the measuring chain may add. Data, not code.
struct Effect
{
    std::string name;
    std::string meaning;
    std::string hint;                                       // how to measure it by itself
    std::string family;                                     // shared by variants of one physical effect; empty: none
    std::map<std::string, Expression> entries;              // formulas in the entries and the amplitude a
    std::map<std::string, std::string> words;               // of a switch: entries as text
    std::string chainOperation;                             // empty: an effect of the simulator
    std::optional<Expression> chainSize;                    // formula in a
    Bounds bounds;                                          // of the amplitude; a switch keeps 0 and 1
    bool isSwitch = false;                                  // on or off
    bool raisesScatter = false;                             // between runs, beside or instead of moving their mean
    double prior = 1.0;                                     // relative weight
    std::map<std::string, std::vector<std::string>> actsIn; // tag -> values; empty: everywhere

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

/// A column of a measured file, and how it becomes SI.
struct ColumnSpecification
{
    std::string column;
    double factor = 1.0;
    double offset = 0.0;
    double lowest = 0.0; // rows outside are missing; equal limits: none
    double highest = 0.0;
};

/// Repeats of one feature that was measured as a number, not as a curve.
struct MeasuredNumber
{
    std::size_t feature;
    std::vector<double> values; // on the feature's own scale (logs already taken)
    double standardError = 0.0; // of each value, beyond the scatter of repeats
};

struct Measurement
{
    std::vector<std::filesystem::path> files; // a repeat each
    ColumnSpecification time;
    ColumnSpecification value;
    std::vector<MeasuredNumber> numbers;

    bool empty() const
    {
        return files.empty() && numbers.empty();
    }
};

/// The observable of a run: what the simulation writes, times the factor, plus the offset (SI units). Formulas in the
/// entries of that run, with its parameters and effects: "-particleDiameter/2" for the gap below a particle.
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
    std::string command;                       // empty: the simulator's
    std::string file;                          // of the observable
    ObservableScale observable;
    Measurement measured;
    double cost = 1.0; // of a measurement, for the next experiment
};

bool acts(const Effect& effect, const Condition& condition);

/// One unknown number behind all numbers of one or several conditions, which repeats do not show: a particle whose diameter was
/// measured once, a scale that was calibrated once, what a law leaves open. No explanation of a residual and no parameter:
/// it has no name to be given and is not reported, and is known before any data.
///
/// The number, z, is standard normal a priori, independent of parameters, effects, noise, model errors and every other z.
/// It is one and the same in all its conditions (held-out ones and candidates as well as training ones), and in all
/// features and repeats of each: more repeats do not average it out. Given z, what was measured is
///     entries        what a run shows whose entries are these formulas of z and of the entries that the run has with its
///                    parameters and effects (z = 0: those entries themselves)
///     chain          what the curve shows after the operation, of a size that is a formula of z (0 at z = 0), behind the
///                    operations of effects
///     featureErrors  each feature of the run plus its error times z: standard deviations in the feature's own unit, so
///                    relative ones for a logarithm
/// One of the three is there. To first order, with g = d(feature)/dz stacked over features and conditions, the covariance
/// of the measured means is that of noise and declared errors plus g g^T for each common error, blocks between conditions
/// included.
struct CommonError
{
    std::string name;
    std::string meaning;
    std::vector<std::size_t> conditions;
    std::map<std::string, Expression> entries;
    std::string chainOperation; // empty: none
    std::optional<Expression> chainSize;
    Eigen::VectorXd featureErrors; // by feature; 0: none
};

struct ExecutorSpecification
{
    std::string kind = "pool";        // or slurm
    int processes = 0;                // 0: one per core
    std::vector<std::string> options; // words for sbatch
};

struct Settings
{
    int budget = 1000; // runs
    unsigned seed = 1;
    int repeatsBase = 6;  // runs at the base setting of a condition
    int repeatsAlone = 5; // and of an effect that runs alone
    int decidingRuns = 9; // in each training condition on average, for one data set; 0: the library alone decides
    int repeatsHeldOut = 3;
    int attempts = 3; // of a run that fails, each with another seed
    double level = 0.05;
    int draws = 1000;                            // of the test's null distribution
    double coverage = 0.9;                       // of sets, for each effect
    double wrongNames = 0.05;                    // of what is detected and not in the library
    std::string oneMoreParameter = "timeFactor"; // control 1: this operation on the curve
    std::string onFailure = "exclude";           // or stop
};

struct Study
{
    std::string name;
    std::filesystem::path file;
    std::filesystem::path work; // cache and runs
    SimulatorSpecification simulator;
    std::string timeColumn;
    std::string valueColumn;
    double magnitudeLimit = 30.0; // by which factor measured and simulated may differ before units are doubted
    std::vector<Feature> features;
    Eigen::VectorXd modelError; // by feature
    std::vector<Condition> conditions;
    std::vector<Parameter> parameters;
    std::vector<Effect> effects;
    std::vector<CommonError> commonErrors;
    ExecutorSpecification executor;
    Settings settings;
    std::vector<std::string> assumptions; // the user's own words, repeated in the report
    std::vector<std::string> leftOut; // effects that the case has no entries for, or that act in no training condition

    std::vector<std::size_t> conditionsOf(Role role) const;
    Eigen::Index featureCount() const
    {
        return static_cast<Eigen::Index>(features.size());
    }
};

} // namespace clepsydra::identification
