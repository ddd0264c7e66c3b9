#include "heldOut/heldOut.h"

#include "lists.h"
#include "effects/measuringChain.h"
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

bool isScoredByRms(const Study& study, Eigen::Index feature)
{
    const bool hasLogs = std::any_of(
        study.features.begin(), study.features.end(), [](const Feature& each) { return each.kind->isLog(); });
    return !hasLogs || study.features[feature].kind->isLog();
}

/// What an explanation fits, as shared quantities: the parameters, then the amplitudes of its effects except for
/// switches, in prior standard deviations.
class Fitted
{
public:
    Fitted(const Study& study, const std::vector<std::size_t>& effects)
        : study_(study),
          effects_(effects)
    {
        std::copy_if(effects.begin(), effects.end(), std::back_inserter(scaled_),
            [&](std::size_t e) { return !study.effects[e].isSwitch; });
    }

    Eigen::Index size() const
    {
        return static_cast<Eigen::Index>(study_.parameters.size() + scaled_.size());
    }

    /// Whether a quantity has an influence: the parameter of an effect has one only together with that effect.
    bool acts(Eigen::Index quantity) const
    {
        const auto q = static_cast<Eigen::Index>(study_.parameters.size());
        return quantity >= q || !study_.parameters[quantity].effect
               || contains(effects_, *study_.parameters[quantity].effect);
    }

    Eigen::VectorXd at(const Setting& setting) const
    {
        Eigen::VectorXd values(size());
        values.head(study_.parameters.size()) = inSds(study_, setting.parameters);
        for (std::size_t k = 0; k < scaled_.size(); ++k)
        {
            const auto [middle, sd] = prior(scaled_[k]);
            values(study_.parameters.size() + k) = (setting.amplitudes(scaled_[k]) - middle) / sd;
        }
        return values;
    }

    Eigen::VectorXd parameters(const Eigen::VectorXd& values) const
    {
        return values.head(study_.parameters.size());
    }

    std::vector<Present> present(const Eigen::VectorXd& values) const
    {
        return mapped(effects_, [&](std::size_t e) { return Present{e, amplitude(e, values)}; });
    }

    Setting setting(const StudySimulator& studySimulator, const Eigen::VectorXd& values) const
    {
        return settingOf(studySimulator, parameters(values), present(values));
    }

    /// The values with one of them moved up, or down where its range ends.
    Eigen::VectorXd moved(Eigen::VectorXd values, Eigen::Index quantity, double step) const
    {
        const auto [lower, upper] = range(quantity);
        double& value = values(quantity);
        value = value + step <= upper ? value + step : std::max(lower, value - step);
        return values;
    }

private:
    /// Mean and standard deviation of the prior of an amplitude: its independent measurement or, without one,
    /// uniform in its range.
    std::pair<double, double> prior(std::size_t effect) const
    {
        if (const auto& measured = study_.effects[effect].measured)
        {
            return {measured->mean, measured->sd};
        }
        const auto [lower, upper] = study_.effects[effect].bounds;
        return {0.5 * (lower + upper), (upper - lower) / std::sqrt(12.0)};
    }

    double amplitude(std::size_t effect, const Eigen::VectorXd& values) const
    {
        const auto place = std::find(scaled_.begin(), scaled_.end(), effect);
        if (place == scaled_.end())
        {
            return 1.0;
        }
        const auto [middle, sd] = prior(effect);
        return middle + sd * values(study_.parameters.size() + (place - scaled_.begin()));
    }

    std::pair<double, double> range(Eigen::Index quantity) const
    {
        const auto q = static_cast<Eigen::Index>(study_.parameters.size());
        if (quantity >= q)
        {
            const std::size_t effect = scaled_[quantity - q];
            const auto [middle, sd] = prior(effect);
            const Bounds& bounds = study_.effects[effect].bounds;
            return {(bounds.lower - middle) / sd, (bounds.upper - middle) / sd};
        }
        const auto [lower, upper] = study_.parameters[quantity].boundsInSds();
        return {lower, upper};
    }

    const Study& study_;
    const std::vector<std::size_t>& effects_;
    std::vector<std::size_t> scaled_;
};

/// An explanation with all that its prediction needs. Control 1 is an effect of a study of its own.
struct Compared
{
    const Study& study;
    const Emulator& emulator;
    const Layout& layout;
    const Eigen::VectorXd& measured; // training data
    Fitted fitted;
    Eigen::VectorXd at;                       // the fitted values
    LinearModel training = {};                // common and model errors follow the fitted quantities
    std::vector<Prediction> predicted = {};   // by held-out condition
    std::vector<Eigen::MatrixXd> slopes = {}; // of the fitted quantities, by held-out condition: features x quantities
};

/// Control 1: one operation of the measuring chain, whose size is fitted together with the parameters as if it were an
/// effect.
class OneMore
{
public:
    OneMore(const StudySimulator& studySimulator, const Library& library, const Answer& answer,
        const std::vector<MeasuredCondition>& training)
        : study(withOperation(studySimulator.study())),
          simulator(study, studySimulator.simulator()),
          emulator(study, simulator, runsOf(library, answer), measuredFeatures(study, training)),
          effects{study.effects.size() - 1}
    {
        Measured all;
        std::tie(layout, all) = arrange(study, emulator, training, library.errorSlopes);
        measured = all.mean;
        const Evidence evidence(study, emulator, layout, inSds(study, answer.null.setting.parameters));
        const Fit fit = evidence.fit(effects.front(), all);
        setting = simulator.plainSetting(physical(study, fit.parameters));
        setting.amplitudes(effects.front()) = fit.amplitude;
    }

    double size() const
    {
        return largestChange * setting.amplitudes.tail<1>()(0);
    }

    const Study study;
    const StudySimulator simulator;
    const Emulator emulator;
    const std::vector<std::size_t> effects;
    Layout layout;
    Eigen::VectorXd measured;
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

Eigen::VectorXd coordinatesOf(const Study& study, std::size_t condition)
{
    auto values =
        mapped(study.conditions[condition].coordinates, [](const auto& coordinate) { return coordinate.second; });
    return Eigen::Map<Eigen::VectorXd>(values.data(), values.size());
}

/// Feature of a condition, one row of a model.
struct Row
{
    std::size_t condition; // index in the study
    Eigen::Index feature;
};

/// Scores all predictions on the held-out conditions with the same draws of the measurement noise.
class Comparison
{
public:
    Comparison(StudySimulator& studySimulator, const Library& library, const Answer& answer,
        const std::vector<MeasuredCondition>& training, const std::vector<MeasuredCondition>& heldOut,
        std::mt19937_64& random)
        : studySimulator_(studySimulator),
          study_(studySimulator.study()),
          library_(library),
          answer_(answer),
          training_(training),
          random_(random)
    {
        if (answer.set.empty() && answer.nearest)
        {
            tested_.push_back(&*answer.nearest);
        }
        for (const auto& member : answer.set)
        {
            tested_.push_back(&member);
        }
        for (const auto c : study_.conditionsOf(Role::heldOut))
        {
            if (heldOut[c].features.rows() > 0)
            {
                result_.conditions.push_back(c);
                result_.data.push_back(
                    {heldOut[c].features, shareOfMean(heldOut[c].features), heldOut[c].declaredError.cwiseAbs2(), {}});
            }
        }
    }

    HeldOutResult run()
    {
        if (result_.conditions.empty())
        {
            return std::move(result_);
        }
        simulateNull();
        simulateTested();
        const OneMore more(studySimulator_, library_, answer_, training_);
        simulateOneMore(more);
        findScored();
        score();
        findNoise();
        judge();
        return std::move(result_);
    }

private:
    Compared compared(const Explanation& explanation) const
    {
        const Fitted fitted(study_, explanation.effects);
        return withTraining(
            {study_, *answer_.emulator, answer_.layout, answer_.measured.mean, fitted, fitted.at(explanation.setting)});
    }

    Compared withTraining(Compared one) const
    {
        const Fitted& fitted = one.fitted;
        const Eigen::Index errors = one.layout.blocks.front().shared.cols();
        const auto mean = [&](const Eigen::VectorXd& values) {
            return meanAt(one.emulator, one.layout, fitted.present(values), fitted.parameters(values));
        };
        LinearModel& model = one.training;
        model.mean = mean(one.at);
        model.slopes = Eigen::MatrixXd::Zero(one.layout.rows, fitted.size() + errors);
        for (Eigen::Index i = 0; i < fitted.size(); ++i)
        {
            Eigen::VectorXd step = Eigen::VectorXd::Zero(fitted.size());
            step(i) = emulatorStep;
            model.slopes.col(i) = (mean(one.at + step) - mean(one.at - step)) / (2.0 * emulatorStep);
        }
        model.rest = Eigen::MatrixXd::Zero(one.layout.rows, one.layout.rows);
        const auto present = fitted.present(one.at);
        for (const auto& block : one.layout.blocks)
        {
            const ConditionEmulator& here = *one.emulator[block.condition];
            model.slopes.block(block.first, fitted.size(), block.size(), errors) = block.shared;
            auto rest = model.rest.block(block.first, block.first, block.size(), block.size());
            rest = block.ofOne(here, present).cwiseProduct(block.meanShare)
                   + here.uncertainty(fitted.parameters(one.at), present)(block.places, block.places) + block.declared;
            // The covariance of exact numbers would be singular.
            rest.diagonal().array() += 1e-18;
        }
        return one;
    }

    std::vector<Simulation> simulated(const Setting& setting, const std::string& purpose)
    {
        return studySimulator_.repeats(result_.conditions, setting, purpose, study_.settings.repeatsHeldOut, seeds);
    }

    /// Means of the features, by held-out condition.
    std::vector<Eigen::VectorXd> meansOf(const std::vector<Simulation>& simulations) const
    {
        return mapped(result_.conditions, [&](std::size_t c) -> Eigen::VectorXd {
            return meanFeatures(featureRows(simulations, c, study_.featureCount()));
        });
    }

    /// Factors on the standard deviations in a held-out condition. Effects that raise the scatter do so as on average
    /// over the training conditions in which the same effects act.
    Eigen::VectorXd scatterIn(const Compared& one, std::size_t condition) const
    {
        const auto present = one.fitted.present(one.at);
        Eigen::ArrayXd logs = Eigen::ArrayXd::Zero(study_.featureCount());
        Eigen::ArrayXd counts = logs;
        for (const auto& block : one.layout.blocks)
        {
            const bool isAlike = std::all_of(present.begin(), present.end(), [&](const Present& each) {
                const Effect& effect = one.study.effects[each.effect];
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
                    scatter.asDiagonal() * one.layout.noise * scatter.asDiagonal()});
            one.slopes.emplace_back(Eigen::MatrixXd::Zero(study_.featureCount(), one.fitted.size()));
        }
    }

    void setSlope(Compared& one, Eigen::Index quantity, double step, const std::vector<Eigen::VectorXd>& moved) const
    {
        for (std::size_t i = 0; i < moved.size(); ++i)
        {
            const Eigen::VectorXd slope = (moved[i] - one.predicted[i].mean) / step;
            // Where a run lacks the feature, it says nothing of the slope.
            one.slopes[i].col(quantity) = slope.array().isFinite().select(slope, 0.0);
        }
    }

    /// Runs at the fitted setting, and with each fitted quantity moved.
    std::vector<Simulation> simulate(Compared& one, const Setting& setting, const std::string& purpose)
    {
        auto simulations = simulated(setting, "held out, " + purpose);
        predictBy(one, simulations);
        const Eigen::VectorXd variances = sharedAfter(one.training, one.measured, padded(one)).covariance.diagonal();
        for (Eigen::Index i = 0; i < one.fitted.size(); ++i)
        {
            const double sd = std::sqrt(std::max(0.0, variances(i)));
            const Eigen::VectorXd values = one.fitted.moved(one.at, i, differenceStep(study_) * sd);
            const double step = values(i) - one.at(i);
            if (one.fitted.acts(i) && step != 0.0)
            {
                setSlope(one, i, step,
                    meansOf(simulated(one.fitted.setting(studySimulator_, values), "held out, slopes, " + purpose)));
            }
        }
        return simulations;
    }

    void simulateNull()
    {
        compared_.push_back(compared(answer_.null));
        result_.simulations.push_back(simulate(compared_.back(), answer_.null.setting, "before"));
        result_.predictedBefore = compared_.back().predicted;
        for (std::size_t i = 0; i < result_.data.size(); ++i)
        {
            result_.data[i].errorSlopes =
                sharedErrorSlopes(studySimulator_, result_.conditions[i], result_.simulations.back());
        }
    }

    void simulateTested()
    {
        for (const auto* one : tested_)
        {
            compared_.push_back(compared(*one));
            auto after = simulate(compared_.back(), one->setting, nameOf(study_, one->effects));
            if (result_.simulations.size() == 1)
            {
                result_.predictedAfter = compared_.back().predicted;
                result_.simulations.push_back(std::move(after));
            }
        }
    }

    void simulateOneMore(const OneMore& more)
    {
        result_.oneMoreAmplitude = more.size();
        const Fitted fitted(more.study, more.effects);
        Compared one =
            withTraining({more.study, more.emulator, more.layout, more.measured, fitted, fitted.at(more.setting)});
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
        for (std::size_t i = 0; i < one.slopes.size(); ++i)
        {
            one.slopes[i].leftCols(study_.parameters.size()) = compared_.front().slopes[i];
        }
        const Eigen::Index last = fitted.size() - 1;
        const Eigen::VectorXd values = fitted.moved(one.at, last, emulatorStep);
        setSlope(one, last, values(last) - one.at(last), meansOf(recorded(fitted.setting(more.simulator, values))));
        compared_.push_back(std::move(one));
    }

    /// All predictions are compared on the same features: those that were measured and that all of them predict.
    void findScored()
    {
        for (std::size_t i = 0; i < result_.conditions.size(); ++i)
        {
            const Eigen::VectorXd measured = meanFeatures(result_.data[i].features);
            byRms_.emplace_back();
            for (Eigen::Index f = 0; f < study_.featureCount(); ++f)
            {
                const std::string where =
                    study_.features[f].name + " in " + study_.conditions[result_.conditions[i]].name;
                const bool isPredicted = std::all_of(compared_.begin(), compared_.end(),
                    [&](const Compared& one) { return std::isfinite(one.predicted[i].mean(f)); });
                if (!std::isfinite(measured(f)))
                {
                    result_.notScored.push_back("no measurement of " + where);
                }
                else if (!isPredicted)
                {
                    unpredicted_.push_back("no prediction of " + where);
                }
                else
                {
                    rows_.push_back({i, f});
                    if (isScoredByRms(study_, f))
                    {
                        byRms_.back().push_back(f);
                    }
                }
            }
        }
        append(result_.notScored, unpredicted_);
        measured_ = Eigen::VectorXd::NullaryExpr(rows_.size(),
            [&](Eigen::Index r) { return meanFeatures(result_.data[rows_[r].condition].features)(rows_[r].feature); });
    }

    /// The fitted values, followed by zeros for the other shared quantities.
    static Eigen::VectorXd padded(const Compared& one)
    {
        Eigen::VectorXd all = Eigen::VectorXd::Zero(one.training.slopes.cols());
        all.head(one.at.size()) = one.at;
        return all;
    }

    LinearModel heldOutModel(const Compared& one) const
    {
        const Eigen::Index rows = rows_.size();
        LinearModel model{Eigen::VectorXd(rows), Eigen::MatrixXd(rows, one.training.slopes.cols()),
            Eigen::MatrixXd::Zero(rows, rows)};
        for (Eigen::Index r = 0; r < rows; ++r)
        {
            const auto [i, f] = rows_[r];
            const HeldOutData& data = result_.data[i];
            const Prediction& predicted = one.predicted[i];
            model.mean(r) = predicted.mean(f);
            model.slopes.row(r) << one.slopes[i].row(f), data.errorSlopes.row(f);
            for (Eigen::Index other = 0; other < rows; ++other)
            {
                const auto [condition, g] = rows_[other];
                // Runs scatter as measurements do, so that the scatter of their mean has the same correlations.
                model.rest(r, other) = condition == i ? predicted.dataCovariance(f, g) * data.meanShare(f, g)
                                                            + std::sqrt(predicted.variance(f) * predicted.variance(g))
                                                                  * correlation(predicted.dataCovariance, f, g)
                                                      : 0.0;
            }
            model.rest(r, r) += data.declaredVariance(f);
        }
        return model;
    }

    static double correlation(const Eigen::MatrixXd& covariance, Eigen::Index f, Eigen::Index g)
    {
        const double scale = std::sqrt(covariance(f, f) * covariance(g, g));
        return scale > 0.0 ? covariance(f, g) / scale : f == g ? 1.0 : 0.0;
    }

    Predictive predictiveOf(const Compared& one) const
    {
        const Eigen::VectorXd fitted = padded(one);
        return predict(
            sharedAfter(one.training, one.measured, fitted), heldOutModel(one), fitted, one.layout.noiseFreedom);
    }

    HeldOutScore scoreOf(const Predictive& predictive)
    {
        HeldOutScore score;
        score.chiSquare = chiSquareOf(predictive, measured_);
        score.pValue = chanceOf(predictive, measured_);
        score.overNull = ratio(predictive, null_);
        return score;
    }

    LogRatio ratio(const Predictive& one, const Predictive& other)
    {
        return logRatio(one, other, measured_, study_.settings.draws, random_);
    }

    Estimate rms(const std::vector<Prediction>& predicted, std::vector<double>* samples = nullptr)
    {
        return rmsError(result_.data, predicted, byRms_, noise_, random_, samples);
    }

    void score()
    {
        noise_ = drawDataNoise(result_.data, result_.predictedBefore, draws, random_);
        null_ = predictiveOf(compared_.front());
        result_.before = scoreOf(null_);
        std::vector<double> before;
        result_.before.rmsLogError = rms(result_.predictedBefore, &before);
        const Predictive oneMore = predictiveOf(compared_.back());
        result_.oneMoreParameter = scoreOf(oneMore);
        result_.oneMoreParameter.rmsLogError = rms(compared_.back().predicted);
        const auto process = withGaussianProcess();
        if (process)
        {
            result_.gaussianProcess = scoreOf(*process);
            result_.gaussianProcess->rmsLogError = rms(shownBy(*process));
        }
        for (std::size_t i = 0; i < tested_.size(); ++i)
        {
            const Compared& one = compared_[1 + i];
            const Predictive predictive = predictiveOf(one);
            std::vector<double> after;
            HeldOutScore score = scoreOf(predictive);
            score.rmsLogError = rms(one.predicted, &after);
            if (answer_.set.empty())
            {
                result_.nearest = score;
                continue;
            }
            result_.members.push_back(score);
            if (i == 0)
            {
                result_.after = result_.members.back();
                result_.improvement = difference(result_.before.rmsLogError, before, result_.after->rmsLogError, after);
                result_.overOneMore = ratio(predictive, oneMore);
                result_.overGaussianProcess = process ? ratio(predictive, *process) : LogRatio{};
            }
        }
    }

    /// Difference of two rms errors. Its standard error is taken draw by draw, so that noise common to both cancels.
    static Estimate difference(const Estimate& larger, const std::vector<double>& ofLarger, const Estimate& smaller,
        const std::vector<double>& ofSmaller)
    {
        const Eigen::ArrayXd gain = Eigen::Map<const Eigen::ArrayXd>(ofLarger.data(), ofLarger.size())
                                    - Eigen::Map<const Eigen::ArrayXd>(ofSmaller.data(), ofSmaller.size());
        return {larger.value - smaller.value, std::sqrt((gain - gain.mean()).square().mean())};
    }

    /// Control 2; empty if conditions lack coordinates.
    std::optional<Predictive> withGaussianProcess() const
    {
        Compared null = compared_.front();
        const auto trained = mapped(null.layout.blocks, [](const Layout::Block& block) { return block.condition; });
        const Eigen::Index dimensions = coordinatesOf(study_, trained.front()).size();
        const auto lacks = [&](std::size_t c) { return coordinatesOf(study_, c).size() != dimensions; };
        if (dimensions == 0 || std::any_of(trained.begin(), trained.end(), lacks)
            || std::any_of(result_.conditions.begin(), result_.conditions.end(), lacks))
        {
            return std::nullopt;
        }
        LinearModel heldOut = heldOutModel(null);
        LinearModel& training = null.training;
        const LinearModel plain = training;
        const Eigen::MatrixXd covariance = plain.slopes * plain.slopes.transpose() + plain.rest;
        const Eigen::VectorXd atFit = null.measured - plain.mean;
        const Eigen::VectorXd residual = atFit + plain.slopes * padded(null);
        for (Eigen::Index f = 0; f < study_.featureCount(); ++f)
        {
            std::vector<Eigen::Index> own; // rows of the training data
            std::vector<std::size_t> at;   // conditions of all rows
            for (const auto& block : null.layout.blocks)
            {
                for (Eigen::Index k = 0; k < block.size(); ++k)
                {
                    if (null.emulator[block.condition]->features[block.places[k]] == f)
                    {
                        own.push_back(block.first + k);
                        at.push_back(block.condition);
                    }
                }
            }
            const auto other =
                numbersWhere<Eigen::Index>(rows_.size(), [&](Eigen::Index r) { return rows_[r].feature == f; });
            if (own.size() < 2 || other.empty())
            {
                continue;
            }
            for (const auto r : other)
            {
                at.push_back(result_.conditions[rows_[r].condition]);
            }
            Eigen::MatrixXd coordinates(at.size(), dimensions);
            for (Eigen::Index i = 0; i < coordinates.rows(); ++i)
            {
                coordinates.row(i) = coordinatesOf(study_, at[i]).transpose();
            }
            const Eigen::VectorXd left = atFit(own);
            const Eigen::MatrixXd slopes = discrepancySlopes(
                coordinates, residual(own), covariance(own, own), left.squaredNorm() / static_cast<double>(own.size()));
            const auto addTo = [&](LinearModel& model, const std::vector<Eigen::Index>& rows, const auto& values) {
                const Eigen::Index before = model.slopes.cols();
                model.slopes.conservativeResize(Eigen::NoChange, before + slopes.cols());
                model.slopes.rightCols(slopes.cols()).setZero();
                for (std::size_t i = 0; i < rows.size(); ++i)
                {
                    model.slopes.row(rows[i]).tail(slopes.cols()) = values.row(i);
                }
            };
            addTo(training, own, slopes.topRows(own.size()));
            addTo(heldOut, other, slopes.bottomRows(other.size()));
        }
        const Eigen::VectorXd fitted = padded(null);
        return predict(sharedAfter(training, null.measured, fitted), heldOut, fitted, null.layout.noiseFreedom);
    }

    /// The simulation without an effect, moved to the means of a prediction.
    std::vector<Prediction> shownBy(const Predictive& predictive) const
    {
        auto predictions = result_.predictedBefore;
        for (std::size_t r = 0; r < rows_.size(); ++r)
        {
            predictions[rows_[r].condition].mean(rows_[r].feature) = predictive.mean(r);
        }
        return predictions;
    }

    /// Error from noise alone: that of a prediction whose mean equals the measured one.
    void findNoise()
    {
        auto right = result_.after ? result_.predictedAfter : result_.predictedBefore;
        for (std::size_t i = 0; i < right.size(); ++i)
        {
            right[i].mean = meanFeatures(result_.data[i].features);
        }
        std::vector<double> errors;
        rms(right, &errors);
        result_.noiseFloor = std::sqrt(Eigen::Map<const Eigen::ArrayXd>(errors.data(), errors.size()).square().mean());
    }

    void judge()
    {
        if (!result_.after)
        {
            return;
        }
        const double level = study_.settings.level;
        auto& reasons = result_.notBetterBecause;
        reasons = unpredicted_;
        if (answer_.decision != Decision::named)
        {
            reasons.emplace_back("it is not the only explanation");
        }
        if (!result_.after->overNull.isBeyondChance(level))
        {
            reasons.emplace_back("it does not predict significantly better than no effect");
        }
        if (!result_.overOneMore.isBeyondChance(level))
        {
            reasons.emplace_back("one more free parameter predicts as well");
        }
        if (result_.gaussianProcess && !result_.overGaussianProcess.isBeyondChance(level))
        {
            reasons.emplace_back("a Gaussian process on the residual predicts as well");
        }
        result_.better = reasons.empty();
        result_.complete = unpredicted_.empty() && result_.after->pValue > level;
    }

    StudySimulator& studySimulator_;
    const Study& study_;
    const Library& library_;
    const Answer& answer_;
    const std::vector<MeasuredCondition>& training_;
    std::mt19937_64& random_;
    std::vector<const Explanation*> tested_;       // the members of the set; without any, the nearest effect
    std::vector<Compared> compared_;               // the null, those tested, control 1
    std::vector<Row> rows_;                        // of the joint prediction; the condition is an index in the result
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
    return Comparison(studySimulator, library, answer, training, heldOut, random).run();
}

} // namespace clepsydra::identification
