#include "procedure/loop.h"

#include "files/wholeFile.h"
#include "emulator/settings.h"
#include "heldOut/heldOut.h"
#include "nextRuns/nextExperiment.h"
#include "procedure/trace.h"
#include "report/report.h"
#include "report/text.h"
#include "runner/caseSimulator.h"
#include "runner/jobs.h"
#include "study/readStudy.h"
#include "tokens/didYouMean.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

/// Number of repeats that a plan assumes for conditions that have not been measured yet.
constexpr Eigen::Index plannedRepeats = 3;

std::vector<MeasuredCondition> measurementsOf(const Study& study, Role role)
{
    std::vector<MeasuredCondition> data(study.conditions.size());
    for (const auto c : study.conditionsOf(role))
    {
        data[c] = readMeasurements(study, c);
    }
    return data;
}

void requireMeasurements(const Study& study)
{
    for (const auto& condition : study.conditions)
    {
        if (condition.role != Role::candidate && condition.measured.empty())
        {
            throw std::runtime_error(study.file.string() + ": condition '" + condition.name
                                     + "' has no 'measured'; 'traceResidual plan' is for studies without data, "
                                       "'role: candidate' for a condition that is not measured yet");
        }
    }
}

/// Finds missing errors before the library runs; without this check they would be found after it.
void requireNoise(const Study& study, const std::vector<MeasuredCondition>& training)
{
    const auto conditions = study.conditionsOf(Role::training);
    const auto isMeasured = [&](std::size_t c) { return !study.conditions[c].measured.empty(); };
    if (!study.simulator.scatters() && std::all_of(conditions.begin(), conditions.end(), isMeasured))
    {
        ownNoise(study, training, conditions);
        requireHeldOutErrors(study, training, measurementsOf(study, Role::heldOut));
    }
}

double largestOf(const Curve& curve)
{
    return Eigen::Map<const Eigen::ArrayXd>(curve.value.data(), curve.value.size()).abs().maxCoeff();
}

/// Compares measured curves, and features that are logarithms, with the first run of the baseline in each training
/// condition. A factor above study.magnitudeLimit means a wrong unit or column, which would make all other runs
/// useless.
/// \param data  by condition of the study; conditions without repeats are skipped
/// \param execute  make runs that are not stored yet; otherwise their conditions are skipped
/// \throws std::runtime_error naming the condition, both values and the remedy
void checkMagnitudes(StudySimulator& studySimulator, const std::vector<MeasuredCondition>& data, bool execute)
{
    const Study& study = studySimulator.study();
    std::vector<SimulationOrder> orders;
    for (const auto c : study.conditionsOf(Role::training))
    {
        // The seed is that of the library's first run, so that the run is made once.
        const SimulationOrder order{c, studySimulator.plainSetting(), checkOfUnits, 0, "base"};
        if (data[c].features.rows() > 0 && (execute || studySimulator.missing({order}) == 0))
        {
            orders.push_back(order);
        }
    }
    for (const auto& simulation : studySimulator.run(orders))
    {
        const auto& condition = study.conditions[simulation.condition];
        const auto compare = [&](const std::string& what, double measured, double simulated) {
            const double factor = measured > simulated ? measured / simulated : simulated / measured;
            if (std::isfinite(factor) && factor > study.magnitudeLimit)
            {
                throw std::runtime_error(
                    study.file.string() + ": condition '" + condition.name + "': " + what + " is " + textOf(measured)
                    + " measured and " + textOf(simulated)
                    + " in the first run of the baseline (SI units). Are unit and column right, in 'measured' and in "
                      "'observable'? If so large a difference is intended, give the study a magnitudeLimit above "
                    + textOf(study.magnitudeLimit));
            }
        };
        if (simulation.failed)
        {
            continue;
        }
        for (const auto& curve : data[simulation.condition].curves)
        {
            compare("the largest value", largestOf(curve), largestOf(simulation.curve));
        }
        const Eigen::VectorXd features = meanFeatures(data[simulation.condition].features);
        for (std::size_t f = 0; f < study.features.size(); ++f)
        {
            if (study.features[f].kind->isLog())
            {
                compare("the exponential of feature '" + study.features[f].name + "'", std::exp(features(f)),
                    std::exp(simulation.features(f)));
            }
        }
    }
}

/// Number of runs for one data set after the library: deciding runs, held-out conditions, candidates.
/// \param rounds, ofPairs  numbers of rounds for single effects and for pairs if runs do not scatter; each round
///     simulates, in each condition, a fit and its neighbours
int runsPerDataSet(const Study& study, int rounds, int ofPairs)
{
    const auto count = [&](Role role) { return static_cast<int>(study.conditionsOf(role).size()); };
    // Null fit, best explanation and one more parameter; slopes of the first two
    const int predictions = 4 + 2 * static_cast<int>(study.parameters.size());
    constexpr int outcomes = 8; // four draws for each of two explanations
    const bool isExact = !study.simulator.scatters();
    const int fit = 2 + static_cast<int>(study.parameters.size());
    const int deciding = study.settings.decidingRuns;
    return count(Role::training) * (isExact && deciding > 0 ? 1 + rounds * fit + ofPairs * (fit + 1) : deciding)
           + count(Role::heldOut) * predictions * (isExact ? 1 : study.settings.repeatsHeldOut)
           + count(Role::candidate) * outcomes;
}

/// What the answer will rest on. \param training  measurements, by condition of the study
void sayContents(const Study& study, const std::vector<MeasuredCondition>& training, std::ostream& out)
{
    Eigen::Index numbers = 0;
    std::size_t notMeasured = 0;
    for (const auto c : study.conditionsOf(Role::training))
    {
        const auto& features = training[c].features;
        notMeasured += features.rows() == 0 ? 1 : 0;
        numbers += features.rows() == 0 ? study.featureCount() : meanFeatures(features).array().isFinite().count();
    }
    const auto counted = [](std::size_t count, const std::string& what) {
        return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
    };
    const std::string names =
        listed(mapped(study.parameters, [](const Parameter& parameter) { return parameter.name; }), ", ");
    out << counted(study.conditionsOf(Role::training).size(), "training condition") << " with "
        << counted(numbers, "number") << (notMeasured > 0 ? ", some not measured yet" : "") << "; "
        << counted(study.parameters.size(), "fitted parameter") << (names.empty() ? "" : " (" + names + ')') << "; "
        << counted(study.effects.size(), "effect") << '\n';
    if (!study.leftOut.empty())
    {
        out << "effects of the library that are left out: "
            << listed(mapped(study.leftOut, std::mem_fn(&LeftOut::text))) << '\n';
    }
    const auto heldOut = study.conditionsOf(Role::heldOut).size();
    out << (heldOut > 0 ? counted(heldOut, "condition") + " held out to test the answer"
                        : "nothing is held out, so the answer will be tested on no prediction")
        << '\n';
    if (numbers <= static_cast<Eigen::Index>(study.parameters.size()) + 1)
    {
        out << "so few numbers cannot tell an effect from the parameters\n";
    }
}

void sayCost(const Study& study, const CaseSimulator& simulator, StudySimulator& studySimulator, std::ostream& out)
{
    const auto orders = libraryOrders(studySimulator);
    const int missing = studySimulator.missing(orders);
    const auto measured = simulator.measuredSecondsPerRun();
    const double seconds = measured.value_or(study.simulator.costPerRun);
    const int usual = runsPerDataSet(study, 2, 0);
    const int most = runsPerDataSet(study, 8, 4);
    const int atOnce = jobsAtOnce(study.executor);
    const auto wall = [&](int runs) { return clockTime(std::ceil(static_cast<double>(runs) / atOnce) * seconds); };
    out << "effect library: " << orders.size() << " runs, " << missing << " of them not made yet, "
        << "about " << wall(missing) << " of wall-clock time with " << atOnce << (atOnce == 1 ? " run" : " runs")
        << " at a time and nothing else running (" << textOf(seconds) << " s per run"
        << (measured ? "" : ", an assumption: 'traceResidual plan --time' measures it") << ")\n"
        << "each data set: about " << usual << " further runs, " << wall(usual) << " of wall-clock time"
        << (most > usual ? ", up to about " + std::to_string(most) + " if no single effect explains the data" : "")
        << '\n'
        << "budget: " << study.settings.budget << " runs" << std::endl;
}

/// Data for a plan: their mean is that of the runs at the base setting, and their scatter and number of repeats are
/// those of the measurements, if there are any.
std::vector<MeasuredCondition> plannedData(
    const Study& study, const Library& library, const std::vector<MeasuredCondition>& measured)
{
    std::vector<MeasuredCondition> data(study.conditions.size());
    std::vector<Simulation> plain;
    std::copy_if(library.runs.begin(), library.runs.end(), std::back_inserter(plain),
        [](const Simulation& run) { return !run.failed && run.setting.amplitudes.isZero(); });
    for (const auto c : study.conditionsOf(Role::training))
    {
        const Eigen::RowVectorXd base = meanFeatures(featureRows(plain, c, study.featureCount())).transpose();
        const Eigen::MatrixXd& repeats = measured[c].features;
        data[c].isPlanned = repeats.rows() == 0;
        data[c].features = base.replicate(data[c].isPlanned ? plannedRepeats : repeats.rows(), 1);
        data[c].declaredError = Eigen::VectorXd::Zero(study.featureCount());
        if (!data[c].isPlanned)
        {
            data[c].features += repeats.rowwise() - meanFeatures(repeats).transpose();
            data[c].declaredError = measured[c].declaredError;
        }
    }
    return data;
}

} // namespace

void plan(const std::filesystem::path& studyFile, bool execute, bool time, std::ostream& out)
{
    const Study study = readStudy(studyFile);
    checkMeasurements(study, out);
    const auto measured = measurementsOf(study, Role::training);
    requireNoise(study, measured);
    sayContents(study, measured, out);
    CaseSimulator simulator(study, out);
    StudySimulator studySimulator(study, simulator);
    if (time && !simulator.measuredSecondsPerRun())
    {
        // The run is one of the library's.
        studySimulator.run({libraryOrders(studySimulator).front()});
    }
    sayCost(study, simulator, studySimulator, out);
    checkMagnitudes(studySimulator, measured, execute);
    if (!execute && studySimulator.missing(libraryOrders(studySimulator)) > 0)
    {
        out << "The detectable effects follow from the library; 'traceResidual plan --execute' makes its runs."
            << std::endl;
        return;
    }
    std::mt19937_64 random(study.settings.seed);
    const Library library = makeLibrary(studySimulator);
    const auto planned = plannedData(study, library, measured);
    const Emulator emulator(study, studySimulator, library.runs, measuredFeatures(study, planned));
    const auto [layout, numbers] = arrange(study, emulator, planned, library.errorSlopes);
    const Evidence evidence(study, emulator, layout, Eigen::VectorXd::Zero(study.parameters.size()));
    Replicas replicas(emulator, layout, evidence, random);
    const Calibration calibration = calibrate(study, evidence, replicas, numbers, random);
    writePlan(study, emulator, layout, numbers, evidence, calibration,
        visibility(study, evidence, replicas, calibration, random), out);
}

void runStudy(const std::filesystem::path& studyFile, const std::filesystem::path& folder, std::ostream& progress,
    bool onlyStored)
{
    Study study = readStudy(studyFile);
    study.settings.budget = onlyStored ? 0 : study.settings.budget;
    requireMeasurements(study);
    checkMeasurements(study, progress);
    const auto training = measurementsOf(study, Role::training);
    requireNoise(study, training);
    sayContents(study, training, progress);
    CaseSimulator simulator(study, progress);
    StudySimulator studySimulator(study, simulator);
    sayCost(study, simulator, studySimulator, progress);
    std::filesystem::create_directories(folder);
    checkMagnitudes(studySimulator, training, true);
    std::mt19937_64 random(study.settings.seed);

    const Library library = makeLibrary(studySimulator);
    const Answer answer = trace(studySimulator, library, training, random, true);
    const auto next = nextExperiments(studySimulator, answer, random);
    Findings findings{&study, &answer, nullptr, &next, &studySimulator, &training, nullptr};
    writeWhole(folder / "answer.json", jsonOf(findings).dump(1) + '\n');
    progress << "decision: " << nameOf(answer.decision) << ", " << pValueText(answer.pValue) << "; written to "
             << (folder / "answer.json").string() << "; the held-out measurements are read now" << std::endl;

    const auto heldOutData = measurementsOf(study, Role::heldOut);
    const HeldOutResult heldOut = evaluateHeldOut(studySimulator, library, answer, training, heldOutData, random);
    findings.heldOut = &heldOut;
    findings.heldOutData = &heldOutData;
    const auto report = jsonOf(findings);
    writeWhole(folder / "report.json", report.dump(1) + '\n');
    writeWhole(folder / "report.html", htmlOf(report, curvePlotsOf(findings)));
}

} // namespace clepsydra::identification
