#include "heldOut/heldOut.h"

#include "lists.h"
#include "emulator/settings.h"

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

constexpr int draws = 1000;
constexpr double largestChange = 0.2;     // of control 1's operation on a curve
constexpr double emulatorStep = 0.05;     // of finite differences of the emulator, in prior standard deviations
constexpr const char* seeds = "held out"; // of all predictions, which are compared on the same packings

/// Prior of an amplitude: its independent measurement or, without one, uniform in its range.
Normal priorOf(const Effect& effect)
{
    const auto [lower, upper] = effect.bounds;
    return effect.measured.value_or(Normal{0.5 * (lower + upper), (upper - lower) / std::sqrt(12.0)});
}

/// An explanation with all that its prediction needs. Control 1 is an effect of a study of its own. What is fitted, in
/// prior standard deviations: the parameters, then the amplitudes of the effects except for switches.
struct Compared
{
    Compared(const Study& ofStudy, const Emulator& ofStudysRuns, const Layout& ofData, const Measured& data,
        const std::vector<std::size_t>& present, const Setting& fit)
        : study(ofStudy),
          emulator(ofStudysRuns),
          layout(ofData),
          measured(data.mean),
          effects(present)
    {
        const Eigen::Index errors = layout.blocks.front().shared.cols();
        const Eigen::Index parameterCount = fit.parameters.size();
        at = Eigen::VectorXd::Zero(parameterCount + effects.size() + errors);
        at.head(parameterCount) = inSds(study, fit.parameters);
        for (Eigen::Index p = 0; p < parameterCount; ++p)
        {
            const Parameter& parameter = study.parameters[p];
            // The parameter of an effect has an influence only together with that effect.
            const bool acts = !parameter.effect || contains(effects, *parameter.effect);
            ranges.push_back(acts ? parameter.boundsInSds() : Bounds{at(p), at(p)});
        }
        for (const auto e : effects)
        {
            const auto [mean, sd] = priorOf(study.effects[e]);
            const auto [lower, upper] = study.effects[e].bounds;
            if (!study.effects[e].isSwitch)
            {
                at(ranges.size()) = (fit.amplitudes(e) - mean) / sd;
                ranges.push_back({(lower - mean) / sd, (upper - mean) / sd});
            }
        }
        at.conservativeResize(count() + errors);
        learn(errors);
    }

    /// Number of fitted quantities.
    Eigen::Index count() const
    {
        return ranges.size();
    }

    Eigen::VectorXd parameters(const Eigen::VectorXd& values) const
    {
        return values.head(study.parameters.size());
    }

    std::vector<Present> present(const Eigen::VectorXd& values) const
    {
        auto quantity = static_cast<Eigen::Index>(study.parameters.size());
        return mapped(effects, [&](std::size_t e) -> Present {
            const auto [mean, sd] = priorOf(study.effects[e]);
            return {e, study.effects[e].isSwitch ? 1.0 : mean + sd * values(quantity++)};
        });
    }

    Setting setting(const StudySimulator& studySimulator, const Eigen::VectorXd& values) const
    {
        return settingOf(studySimulator, parameters(values), present(values));
    }

    /// The shared quantities with one of them moved up, or down where its range ends.
    Eigen::VectorXd moved(Eigen::Index quantity, double step) const
    {
        Eigen::VectorXd values = at;
        double& value = values(quantity);
        value = value + step <= ranges[quantity].upper ? value + step : std::max(ranges[quantity].lower, value - step);
        return values;
    }

    const Study& study;
    const Emulator& emulator;
    const Layout& layout;
    const Eigen::VectorXd& measured; // training data
    std::vector<std::size_t> effects;
    Eigen::VectorXd at; // the shared quantities: those fitted, then common and model errors, which are 0
    std::vector<Bounds> ranges;
    LinearModel training;
    std::vector<Prediction> predicted; // by held-out condition

private:
    void learn(Eigen::Index errors)
    {
        const auto mean = [&](const Eigen::VectorXd& values) {
            return meanAt(emulator, layout, present(values), parameters(values));
        };
        training.mean = mean(at);
        training.slopes = Eigen::MatrixXd::Zero(layout.rows, at.size());
        for (Eigen::Index i = 0; i < count(); ++i)
        {
            const Eigen::VectorXd step = emulatorStep * Eigen::VectorXd::Unit(at.size(), i);
            training.slopes.col(i) = (mean(at + step) - mean(at - step)) / (2.0 * emulatorStep);
        }
        training.rest = Eigen::MatrixXd::Zero(layout.rows, layout.rows);
        const auto fitted = present(at);
        for (const auto& block : layout.blocks)
        {
            const ConditionEmulator& here = *emulator[block.condition];
            training.slopes.block(block.first, count(), block.size(), errors) = block.shared;
            auto rest = training.rest.block(block.first, block.first, block.size(), block.size());
            rest = block.ofOne(here, fitted).cwiseProduct(block.meanShare)
                   + here.uncertainty(parameters(at), fitted)(block.places, block.places) + block.declared;
            // The covariance of exact numbers would be singular.
            rest.diagonal().array() += 1e-18;
        }
    }
};

/// Control 1: one operation of the measuring chain, whose size is fitted together with the parameters as if it were an
/// effect.
struct OneMore
{
    OneMore(const StudySimulator& studySimulator, const Library& library, const Answer& answer,
        const std::vector<MeasuredCondition>& training)
        : study(withOperation(studySimulator.study())),
          simulator(study, studySimulator.simulator()),
          emulator(study, simulator, runsOf(library, answer), measuredFeatures(study, training))
    {
        std::tie(layout, measured) = arrange(study, emulator, training, library.errorSlopes);
        const Evidence evidence(study, emulator, layout, inSds(study, answer.null.setting.parameters));
        const Fit fit = evidence.fit(study.effects.size() - 1, measured);
        setting = simulator.plainSetting(physical(study, fit.parameters));
        setting.amplitudes.tail<1>()(0) = fit.amplitude;
    }

    const Study study;
    const StudySimulator simulator;
    const Emulator emulator;
    Layout layout;
    Measured measured;
    Setting setting;

private:
    static Study withOperation(Study study)
    {
        Effect operation;
        operation.name = "one more parameter";
        operation.chainOperation = study.settings.oneMoreParameter;
        operation.chainSize = Expression(std::to_string(largestChange) + "*a");
        operation.bounds = {-1.0, 1.0};
        study.effects.push_back(operation);
        return study;
    }

    std::vector<Simulation> runsOf(const Library& library, const Answer& answer) const
    {
        std::vector<Simulation> runs = library.runs;
        append(runs, answer.null.runs);
        for (auto& run : runs)
        {
            run.setting.amplitudes.conservativeResize(study.effects.size());
            run.setting.amplitudes.tail<1>().setZero();
        }
        return runs;
    }
};

/// Feature of a condition, one row of a model.
struct Row
{
    std::size_t condition; // of the study
    Eigen::Index feature;
    std::size_t place = 0; // of a held-out condition in the result
};

double correlation(const Eigen::MatrixXd& covariance, Eigen::Index f, Eigen::Index g)
{
    const double scale = std::sqrt(covariance(f, f) * covariance(g, g));
    return scale > 0.0 ? covariance(f, g) / scale : f == g ? 1.0 : 0.0;
}

/// Scores all predictions on the held-out conditions with the same draws of the measurement noise.
class Comparison
{
public:
    Comparison(StudySimulator& studySimulator, const Answer& answer, const std::vector<MeasuredCondition>& heldOut,
        std::mt19937_64& random)
        : studySimulator_(studySimulator),
          study_(studySimulator.study()),
          answer_(answer),
          random_(random)
    {
        for (const auto c : study_.conditionsOf(Role::heldOut))
        {
            if (const auto& [features, declaredError, curves, isPlanned] = heldOut[c]; features.rows() > 0)
            {
                result_.conditions.push_back(c);
                result_.data.push_back({meanFeatures(features), shareOfMean(features), declaredError.cwiseAbs2(), {}});
            }
        }
    }

    HeldOutResult run(const Library& library, const std::vector<MeasuredCondition>& training)
    {
        if (result_.conditions.empty())
        {
            return std::move(result_);
        }
        simulateBy(answer_.null, "before");
        for (std::size_t i = 0; i < result_.data.size(); ++i)
        {
            result_.data[i].errorSlopes =
                sharedErrorSlopes(studySimulator_, result_.conditions[i], result_.simulations.back());
        }
        if (const Explanation* candidate = bestOf(answer_))
        {
            simulateBy(*candidate, nameOf(study_, candidate->effects));
        }
        result_.predictedBefore = compared_.front().predicted;
        result_.predictedAfter = compared_.size() > 1 ? compared_[1].predicted : std::vector<Prediction>{};
        const OneMore more(studySimulator_, library, answer_, training);
        simulateOneMore(more);
        findScored();
        score();
        judge();
        return std::move(result_);
    }

private:
    std::vector<Simulation> simulated(const Setting& setting, const std::string& purpose)
    {
        return studySimulator_.repeats(result_.conditions, setting, purpose, study_.settings.repeatsHeldOut, seeds);
    }

    /// Factors on the standard deviations in a held-out condition. Effects that raise the scatter do so as on average
    /// over the training conditions in which the same effects act.
    Eigen::VectorXd scatterIn(const Compared& one, std::size_t condition) const
    {
        const auto present = one.present(one.at);
        Eigen::ArrayXd logs = Eigen::ArrayXd::Zero(study_.featureCount());
        Eigen::ArrayXd counts = logs;
        for (const auto& block : one.layout.blocks)
        {
            const bool isAlike = std::all_of(one.effects.begin(), one.effects.end(), [&](std::size_t e) {
                const Effect& effect = one.study.effects[e];
                return acts(effect, study_.conditions[condition]) == acts(effect, study_.conditions[block.condition]);
            });
            const ConditionEmulator& here = *one.emulator[block.condition];
            const Eigen::ArrayXd raised =
                0.5 * (here.noiseOf(present).diagonal().array() / here.noise.diagonal().array()).log();
            for (std::size_t k = 0; isAlike && k < here.features.size(); ++k)
            {
                logs(here.features[k]) += raised(k);
                counts(here.features[k]) += 1.0;
            }
        }
        return (logs / counts.max(1.0)).exp();
    }

    void predictBy(Compared& one, const std::vector<Simulation>& simulations) const
    {
        for (const auto c : result_.conditions)
        {
            const Eigen::MatrixXd rows = featureRows(simulations, c, study_.featureCount());
            const double runs = std::max(1.0, static_cast<double>(rows.array().isFinite().rowwise().any().count()));
            const Eigen::VectorXd scatter = scatterIn(one, c);
            one.predicted.push_back(
                {meanFeatures(rows), scatter.cwiseAbs2().cwiseProduct(one.emulator.noise().diagonal()) / runs,
                    scatter.asDiagonal() * one.layout.noise * scatter.asDiagonal(),
                    Eigen::MatrixXd::Zero(study_.featureCount(), one.count())});
        }
    }

    /// \param moved  simulations at `values`, where this quantity alone is moved
    void setSlope(
        Compared& one, Eigen::Index quantity, const Eigen::VectorXd& values, const std::vector<Simulation>& moved) const
    {
        for (std::size_t i = 0; i < one.predicted.size(); ++i)
        {
            const Eigen::VectorXd there =
                meanFeatures(featureRows(moved, result_.conditions[i], study_.featureCount()));
            const Eigen::VectorXd slope = (there - one.predicted[i].mean) / (values(quantity) - one.at(quantity));
            // Where a run lacks the feature, it says nothing of the slope.
            one.predicted[i].slopes.col(quantity) = slope.array().isFinite().select(slope, 0.0);
        }
    }

    /// Runs at the fitted setting, and with each fitted quantity moved.
    void simulateBy(const Explanation& explanation, const std::string& purpose)
    {
        compared_.emplace_back(
            study_, *answer_.emulator, answer_.layout, answer_.measured, explanation.effects, explanation.setting);
        Compared& one = compared_.back();
        const auto simulations = simulated(explanation.setting, "held out, " + purpose);
        predictBy(one, simulations);
        const Eigen::VectorXd variances = sharedAfter(one.training, one.measured, one.at).covariance.diagonal();
        for (Eigen::Index i = 0; i < one.count(); ++i)
        {
            const Eigen::VectorXd values =
                one.moved(i, differenceStep(study_) * std::sqrt(std::max(0.0, variances(i))));
            if (values(i) != one.at(i))
            {
                setSlope(
                    one, i, values, simulated(one.setting(studySimulator_, values), "held out, slopes, " + purpose));
            }
        }
        result_.simulations.push_back(simulations);
    }

    void simulateOneMore(const OneMore& more)
    {
        result_.oneMoreAmplitude = largestChange * more.setting.amplitudes.tail<1>()(0);
        Compared one(
            more.study, more.emulator, more.layout, more.measured, {more.study.effects.size() - 1}, more.setting);
        const auto runs =
            simulated(studySimulator_.plainSetting(more.setting.parameters), "held out, one more parameter");
        const auto recorded = [&](const Setting& setting) {
            auto simulations = runs;
            for (auto& simulation : simulations)
            {
                if (!simulation.failed)
                {
                    simulation.features = more.simulator.featuresOf(
                        more.simulator.throughChain(simulation.plain, simulation.condition, setting));
                }
            }
            return simulations;
        };
        predictBy(one, recorded(more.setting));
        for (std::size_t i = 0; i < one.predicted.size(); ++i)
        {
            one.predicted[i].slopes.leftCols(study_.parameters.size()) = compared_.front().predicted[i].slopes;
        }
        const Eigen::Index last = one.count() - 1;
        const Eigen::VectorXd values = one.moved(last, emulatorStep);
        setSlope(one, last, values, recorded(one.setting(more.simulator, values)));
        compared_.push_back(std::move(one));
    }

    /// All predictions are compared on the same features: those that were measured and that all of them predict.
    void findScored()
    {
        const auto isLog = [](const Feature& feature) { return feature.kind->isLog(); };
        result_.ofLogs = std::any_of(study_.features.begin(), study_.features.end(), isLog);
        byRms_.resize(result_.conditions.size());
        for (std::size_t i = 0; i < result_.conditions.size(); ++i)
        {
            const std::size_t condition = result_.conditions[i];
            for (Eigen::Index f = 0; f < study_.featureCount(); ++f)
            {
                const std::string where = study_.features[f].name + " in " + study_.conditions[condition].name;
                if (!std::isfinite(result_.data[i].mean(f)))
                {
                    result_.notScored.push_back("no measurement of " + where);
                }
                else if (!std::all_of(compared_.begin(), compared_.end(),
                             [&](const Compared& one) { return std::isfinite(one.predicted[i].mean(f)); }))
                {
                    unpredicted_.push_back("no prediction of " + where);
                }
                else
                {
                    rows_.push_back({condition, f, i});
                    if (!result_.ofLogs || isLog(study_.features[f]))
                    {
                        byRms_[i].push_back(f);
                    }
                }
            }
        }
        append(result_.notScored, unpredicted_);
        measured_ = Eigen::VectorXd::NullaryExpr(
            rows_.size(), [&](Eigen::Index r) { return result_.data[rows_[r].place].mean(rows_[r].feature); });
    }

    LinearModel heldOutModel(const Compared& one) const
    {
        const Eigen::Index rows = rows_.size();
        LinearModel model{
            Eigen::VectorXd(rows), Eigen::MatrixXd(rows, one.at.size()), Eigen::MatrixXd::Zero(rows, rows)};
        for (Eigen::Index r = 0; r < rows; ++r)
        {
            const Eigen::Index f = rows_[r].feature;
            const HeldOutData& data = result_.data[rows_[r].place];
            const auto& [mean, variance, dataCovariance, slopes] = one.predicted[rows_[r].place];
            model.mean(r) = mean(f);
            model.slopes.row(r) << slopes.row(f), data.errorSlopes.row(f);
            for (Eigen::Index other = 0; other < rows; ++other)
            {
                const Eigen::Index g = rows_[other].feature;
                // Runs scatter as measurements do, so that the scatter of their mean has the same correlations.
                model.rest(r, other) =
                    rows_[other].place == rows_[r].place
                        ? dataCovariance(f, g) * data.meanShare(f, g)
                              + std::sqrt(variance(f) * variance(g)) * correlation(dataCovariance, f, g)
                        : 0.0;
            }
            model.rest(r, r) += data.declaredVariance(f);
        }
        return model;
    }

    Predictive predictiveOf(const Compared& one) const
    {
        return predict(
            sharedAfter(one.training, one.measured, one.at), heldOutModel(one), one.at, one.layout.noiseFreedom);
    }

    LogRatio ratio(const Predictive& one, const Predictive& other)
    {
        return logRatio(one, other, measured_, study_.settings.draws, random_);
    }

    HeldOutScore scoreOf(const Predictive& predictive, const std::vector<Prediction>& predicted)
    {
        HeldOutScore score;
        score.chiSquare = chiSquareOf(predictive, measured_);
        score.pValue = chanceOf(predictive, measured_);
        score.overNull = ratio(predictive, null_);
        std::tie(score.rmsLogError, score.errors) = rmsError(result_.data, predicted, byRms_, noise_, random_);
        return score;
    }

    void score()
    {
        noise_ = drawDataNoise(result_.data, result_.predictedBefore, draws, random_);
        null_ = predictiveOf(compared_.front());
        result_.before = scoreOf(null_, result_.predictedBefore);
        const Predictive oneMore = predictiveOf(compared_.back());
        result_.oneMoreParameter = scoreOf(oneMore, compared_.back().predicted);
        const auto process = withGaussianProcess();
        if (process)
        {
            // The simulation without an effect, moved to the means of this prediction.
            auto shown = result_.predictedBefore;
            for (std::size_t r = 0; r < rows_.size(); ++r)
            {
                shown[rows_[r].place].mean(rows_[r].feature) = process->mean(r);
            }
            result_.gaussianProcess = scoreOf(*process, shown);
        }
        if (answer_.set.empty() && answer_.nearest)
        {
            result_.nearest = scoreOf(predictiveOf(compared_[1]), compared_[1].predicted);
        }
        if (!answer_.set.empty())
        {
            const Predictive after = predictiveOf(compared_[1]);
            result_.after = scoreOf(after, compared_[1].predicted);
            // Draw by draw, so that noise common to both errors cancels.
            const Eigen::ArrayXd fall = result_.before.errors - result_.after->errors;
            result_.improvement = {result_.before.rmsLogError.value - result_.after->rmsLogError.value,
                std::sqrt((fall - fall.mean()).square().mean())};
            result_.overOneMore = ratio(after, oneMore);
            result_.overGaussianProcess = process ? ratio(after, *process) : LogRatio{};
        }
        // The error from noise alone is that of a prediction whose mean equals the measured one.
        auto right = result_.after ? result_.predictedAfter : result_.predictedBefore;
        for (std::size_t i = 0; i < right.size(); ++i)
        {
            right[i].mean = result_.data[i].mean;
        }
        result_.noiseFloor = std::sqrt(rmsError(result_.data, right, byRms_, noise_, random_).second.square().mean());
    }

    /// Control 2; empty if conditions lack coordinates.
    std::optional<Predictive> withGaussianProcess() const
    {
        const Compared& null = compared_.front();
        std::vector<Row> rows; // of the training data, then those held out
        for (const auto& block : null.layout.blocks)
        {
            for (const auto place : block.places)
            {
                rows.push_back({block.condition, null.emulator[block.condition]->features[place]});
            }
        }
        const Eigen::Index trained = rows.size();
        append(rows, rows_);
        const auto coordinatesOf = [&](std::size_t c) { return study_.conditions[c].coordinates; };
        const std::size_t dimensions = coordinatesOf(rows.front().condition).size(); // that of all conditions
        if (dimensions == 0)
        {
            return std::nullopt;
        }
        Eigen::MatrixXd coordinates(rows.size(), dimensions);
        for (std::size_t r = 0; r < rows.size(); ++r)
        {
            const auto values = coordinatesOf(rows[r].condition);
            std::transform(values.begin(), values.end(), coordinates.row(r).begin(),
                [](const auto& coordinate) { return coordinate.second; });
        }
        LinearModel training = null.training;
        LinearModel heldOut = heldOutModel(null);
        const Eigen::MatrixXd covariance = training.slopes * training.slopes.transpose() + training.rest;
        const Eigen::VectorXd atFit = null.measured - training.mean;
        const Eigen::VectorXd residual = atFit + training.slopes * null.at;
        Eigen::MatrixXd slopes(rows.size(), null.at.size());
        slopes << training.slopes, heldOut.slopes;
        for (Eigen::Index f = 0; f < study_.featureCount(); ++f)
        {
            const auto with =
                numbersWhere<Eigen::Index>(rows.size(), [&](Eigen::Index r) { return rows[r].feature == f; });
            const std::vector<Eigen::Index> own(with.begin(), std::lower_bound(with.begin(), with.end(), trained));
            if (own.size() < 2 || own.size() == with.size())
            {
                continue;
            }
            const Eigen::VectorXd left = atFit(own);
            const Eigen::MatrixXd process = discrepancySlopes(coordinates(with, Eigen::all), residual(own),
                covariance(own, own), left.squaredNorm() / static_cast<double>(own.size()));
            slopes.conservativeResize(Eigen::NoChange, slopes.cols() + process.cols());
            slopes.rightCols(process.cols()).setZero();
            slopes.rightCols(process.cols())(with, Eigen::all) = process;
        }
        training.slopes = slopes.topRows(trained);
        heldOut.slopes = slopes.bottomRows(rows_.size());
        Eigen::VectorXd fitted = Eigen::VectorXd::Zero(slopes.cols());
        fitted.head(null.at.size()) = null.at;
        return predict(sharedAfter(training, null.measured, fitted), heldOut, fitted, null.layout.noiseFreedom);
    }

    void judge()
    {
        if (!result_.after)
        {
            return;
        }
        const double level = study_.settings.level;
        if (rows_.empty())
        {
            unpredicted_.emplace_back("nothing could be compared");
        }
        auto& reasons = result_.notBetterBecause;
        reasons = unpredicted_;
        for (const auto& [isRefuted, reason] :
            {std::pair(answer_.decision == Decision::named, "it is not the only explanation"),
                std::pair(result_.after->overNull.isBeyondChance(level),
                    "it does not predict significantly better than no effect"),
                std::pair(
                    result_.overOneMore.isBeyondChance(level), "one more free parameter predicts as well or better"),
                std::pair(!result_.gaussianProcess || result_.overGaussianProcess.isBeyondChance(level),
                    "a Gaussian process on the residual predicts as well or better")})
        {
            if (!isRefuted)
            {
                reasons.emplace_back(reason);
            }
        }
        result_.better = reasons.empty();
        result_.complete = unpredicted_.empty() && result_.after->pValue > level;
    }

    StudySimulator& studySimulator_;
    const Study& study_;
    const Answer& answer_;
    std::mt19937_64& random_;
    /// The null; the most probable candidate or, without any, the nearest effect; control 1
    std::vector<Compared> compared_;
    std::vector<Row> rows_;                        // of the joint prediction
    std::vector<std::vector<Eigen::Index>> byRms_; // features that enter the rms error, by condition
    std::vector<std::string> unpredicted_;         // measured features that are not scored
    Eigen::VectorXd measured_;                     // values of the rows
    std::vector<Eigen::MatrixXd> noise_;           // draws for the rms errors
    Predictive null_;
    HeldOutResult result_;
};

} // namespace

HeldOutResult evaluateHeldOut(StudySimulator& studySimulator, const Library& library, const Answer& answer,
    const std::vector<MeasuredCondition>& training, const std::vector<MeasuredCondition>& heldOut,
    std::mt19937_64& random)
{
    return Comparison(studySimulator, answer, heldOut, random).run(library, training);
}

} // namespace clepsydra::identification
