#include "procedure/loop.h"

#include "files/wholeFile.h"
#include "identifiability/identifiability.h"
#include "nextExperiment/nextExperiment.h"
#include "procedure/assemble.h"
#include "procedure/magnitudes.h"
#include "report/html.h"
#include "report/json.h"
#include "report/planReport.h"
#include "report/words.h"
#include "runner/caseRig.h"
#include "runner/runProgress.h"
#include "study/readStudy.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

/// Repeats that a plan counts on where nothing has been measured yet.
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
    for (const auto c : study.conditionsOf(Role::training))
    {
        if (study.conditions[c].measured.empty())
        {
            throw std::runtime_error(study.file.string() + ": training condition '" + study.conditions[c].name
                                     + "' has no 'measured': 'traceResidual plan' is for studies without data");
        }
    }
}

/// Runs after the library: at the null fit, confirmations, held-out conditions, candidates.
int runsPerDataSet(const Study& study)
{
    const auto count = [&](Role role) { return static_cast<int>(study.conditionsOf(role).size()); };
    const int training = count(Role::training);
    return training * (study.settings.repeatsAtFit + study.settings.confirmations * study.settings.repeatsConfirmation)
           + count(Role::heldOut) * 3 * study.settings.repeatsHeldOut + count(Role::candidate) * 2 * 2;
}

void sayCost(const Study& study, CaseRig& rig, Simulator& simulator, std::ostream& out)
{
    const auto orders = libraryOrders(simulator);
    const int missing = simulator.missing(orders);
    const double seconds = rig.secondsPerRun();
    const int perData = study.rig.seedEntry.empty() ? runsPerDataSet(study) / 3 : runsPerDataSet(study);
    out << "effect library: " << orders.size() << " runs, " << missing << " of them not made yet, "
        << clockTime(missing * seconds) << " of computing time (" << textOf(seconds) << " s a run)\n"
        << "each data set: up to about " << perData << " runs more, " << clockTime(perData * seconds) << '\n'
        << "budget: " << study.settings.budget << " runs" << std::endl;
}

/// Data that are not there yet: as many repeats as planned, exactly at the base.
std::vector<MeasuredCondition> plannedData(const Study& study, const EffectLibrary& library)
{
    std::vector<MeasuredCondition> data(study.conditions.size());
    for (const auto c : study.conditionsOf(Role::training))
    {
        const auto files = static_cast<Eigen::Index>(study.conditions[c].measured.files.size());
        data[c].features = library.conditions[c].base.transpose().replicate(files > 0 ? files : plannedRepeats, 1);
        data[c].declaredError = Eigen::VectorXd::Zero(study.featureCount());
    }
    return data;
}

std::vector<Simulation> plannedSimulations(const Study& study, const EffectLibrary& library)
{
    std::vector<Simulation> simulations;
    for (const auto c : study.conditionsOf(Role::training))
    {
        for (int repeat = 0; repeat < study.settings.repeatsAtFit; ++repeat)
        {
            simulations.push_back({c, library.conditions[c].base, {}, {}, 0, false});
        }
    }
    return simulations;
}

Noise plannedNoise(const Study& study, const EffectLibrary& library, const std::vector<MeasuredCondition>& data)
{
    std::vector<std::size_t> measured;
    for (const auto c : study.conditionsOf(Role::training))
    {
        if (!study.conditions[c].measured.empty())
        {
            measured.push_back(c);
        }
    }
    const auto [repeats, declared] = scatterOf(data, measured);
    return noiseModel(repeats, library.scatter, study.modelError, true, declared);
}

} // namespace

void plan(const std::filesystem::path& studyFile, bool execute, std::ostream& out)
{
    const Study study = readStudy(studyFile);
    checkMeasurements(study, out);
    const auto measured = measurementsOf(study, Role::training);
    CaseRig rig(study, out);
    Simulator simulator(study, rig);
    sayCost(study, rig, simulator, out);
    checkMagnitudes(simulator, measured, execute);
    if (!execute && simulator.missing(libraryOrders(simulator)) > 0)
    {
        out << "what is detectable needs the library: 'traceResidual plan --execute' makes its runs" << std::endl;
        return;
    }
    std::mt19937_64 random(study.settings.seed);
    const EffectLibrary library = makeLibrary(simulator);
    const Noise noise = plannedNoise(study, library, measured);
    const ResidualProblem problem = assemble(study, library, plannedData(study, library),
        plannedSimulations(study, library), simulator.plainSetting().parameters);
    const Significance test = significance(problem, noise, study.bounds(), study.settings.draws, random);
    const Identifiability table = identifiability(problem, noise, study.bounds(), test.bestGainCritical);
    writePlan(study, library, noise, table, out);
}

namespace
{

void run(const Study& study, const std::filesystem::path& folder, std::ostream& out)
{
    requireMeasurements(study);
    checkMeasurements(study, out);
    const auto training = measurementsOf(study, Role::training);
    CaseRig rig(study, out);
    Simulator simulator(study, rig);
    sayCost(study, rig, simulator, out);
    std::filesystem::create_directories(folder);
    checkMagnitudes(simulator, training, true);
    std::mt19937_64 random(study.settings.seed);

    const EffectLibrary library = makeLibrary(simulator);
    const Answer answer = trace(simulator, library, training, random);
    const auto next = nextExperiments(simulator, answer, training);
    Findings findings{&study, &library, &answer, nullptr, &next, &simulator, &training};
    writeWhole(folder / "answer.json", jsonOf(findings).dump(1) + '\n');
    out << "decision: " << nameOf(answer.decision) << ", p = " << textOf(answer.significance.pValue) << "; written to "
        << (folder / "answer.json").string() << ", held-out values are looked at now" << std::endl;

    const auto heldOutData = measurementsOf(study, Role::heldOut);
    const HeldOutResult heldOut = evaluateHeldOut(simulator, library, answer, training, heldOutData, random);
    findings.heldOut = &heldOut;
    const auto report = jsonOf(findings);
    writeWhole(folder / "report.json", report.dump(1) + '\n');
    writeWhole(folder / "report.html", htmlOf(findings, report));
    writeSummary(findings, out);
    out << "reports: " << (folder / "report.json").string() << ", " << (folder / "report.html").string() << std::endl;
}

} // namespace

void runStudy(const std::filesystem::path& studyFile, const std::filesystem::path& folder, std::ostream& out)
{
    run(readStudy(studyFile), folder, out);
}

void reportAgain(const std::filesystem::path& studyFile, const std::filesystem::path& folder)
{
    Study study = readStudy(studyFile);
    study.settings.budget = 0;
    std::ostringstream progress;
    run(study, folder, progress);
}

} // namespace clepsydra::identification
