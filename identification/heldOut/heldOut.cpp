#include "heldOut/heldOut.h"

#include "lists.h"
#include "effects/measuringChain.h"
#include "heldOut/gaussianProcess.h"
#include "emulator/commonErrors.h"
#include "emulator/distributions.h"
#include "emulator/settings.h"

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

constexpr int draws = 1000;
constexpr double largestChange = 0.2; // of control 1's operation on a curve

std::vector<Eigen::Index> logFeatures(const Study& study)
{
    const auto logs =
        numbersWhere(study.featureCount(), [&](Eigen::Index f) { return study.features[f].kind->isLog(); });
    return logs.empty() ? numbersWhere(study.featureCount(), [](Eigen::Index) { return true; }) : logs;
}

/// Quantile: the smallest of the values that at least this share of them does not exceed.
double quantile(std::vector<double> values, double share)
{
    std::sort(values.begin(), values.end());
    const auto index = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()))) - 1;
    return values[std::min(index, values.size() - 1)];
}

Prediction predictionOf(const Eigen::MatrixXd& features, const Study& study, const Answer& answer)
{
    const double seeds = std::max(1.0, static_cast<double>(features.array().isFinite().rowwise().any().count()));
    Prediction prediction;
    prediction.mean = meanFeatures(features);
    prediction.variance = answer.emulator->noise().diagonal() / seeds + study.modelError.cwiseAbs2();
    prediction.dataCovariance = answer.layout.noise;
    return prediction;
}

/// Control 1: one operation of the measuring chain, whose size is fitted together with the parameters as if it were an
/// effect.
struct FreeOperation
{
    double size = 0.0;
    Eigen::VectorXd parameters;
};

FreeOperation fitOneMore(const StudySimulator& studySimulator, const Library& library, const Answer& answer,
    const std::vector<MeasuredCondition>& training)
{
    Study study = studySimulator.study();
    Effect operation;
    operation.name = "one more parameter";
    operation.chainOperation = study.settings.oneMoreParameter;
    operation.chainSize = Expression(std::to_string(largestChange) + "*a");
    operation.bounds = {-1.0, 1.0};
    study.effects.push_back(operation);
    std::vector<Run> runs = library.runs;
    append(runs, answer.null.runs);
    for (auto& run : runs)
    {
        run.setting.amplitudes.conservativeResize(study.effects.size());
        run.setting.amplitudes.tail<1>().setZero();
    }
    const StudySimulator extended(study, studySimulator.simulator());
    const Emulator emulator(study, extended, runs, measuredFeatures(study, training));
    const auto [layout, measured] = arrange(study, emulator, training, library.errorSlopes);
    const Evidence evidence(study, emulator, layout, inSds(study, answer.null.setting.parameters));
    const Fit fit = evidence.fit(study.effects.size() - 1, measured);
    return {largestChange * fit.amplitude, physical(study, fit.parameters)};
}

Eigen::VectorXd coordinatesOf(const Study& study, std::size_t condition)
{
    auto values =
        mapped(study.conditions[condition].coordinates, [](const auto& coordinate) { return coordinate.second; });
    return Eigen::Map<Eigen::VectorXd>(values.data(), values.size());
}

/// Control 2: a Gaussian process through the residual of the null, feature by feature, over the conditions'
/// coordinates; empty if conditions lack coordinates.
std::optional<std::vector<Prediction>> withGaussianProcess(const Study& study, const Answer& answer,
    const std::vector<MeasuredCondition>& training, const std::vector<std::size_t>& conditions,
    std::vector<Prediction> predictions)
{
    const auto trained = study.conditionsOf(Role::training);
    const Eigen::Index dimensions = coordinatesOf(study, trained.front()).size();
    const auto same = [&](std::size_t c) { return coordinatesOf(study, c).size() == dimensions; };
    if (dimensions == 0 || !std::all_of(trained.begin(), trained.end(), same)
        || !std::all_of(conditions.begin(), conditions.end(), same))
    {
        return std::nullopt;
    }
    const Eigen::VectorXd parameters = inSds(study, answer.null.setting.parameters);
    for (Eigen::Index f = 0; f < study.featureCount(); ++f)
    {
        std::vector<double> residuals;
        std::vector<double> variances;
        std::vector<std::size_t> at;
        for (const auto c : trained)
        {
            const auto& emulator = (*answer.emulator)[c];
            if (!emulator)
            {
                continue;
            }
            const auto place = std::find(emulator->features.begin(), emulator->features.end(), f);
            const double measured = meanFeatures(training[c].features)(f);
            if (place != emulator->features.end() && std::isfinite(measured))
            {
                const auto k = place - emulator->features.begin();
                const double unknown = emulator->uncertainty(parameters, {})(k, k);
                residuals.push_back(measured - emulator->at(parameters, {})(k));
                variances.push_back(answer.layout.noise(f, f) * shareOfMean(training[c].features)(f, f) + unknown
                                    + training[c].declaredError(f) * training[c].declaredError(f)
                                    + study.modelError(f) * study.modelError(f) + 1e-12);
                at.push_back(c);
            }
        }
        if (at.size() < 2)
        {
            continue;
        }
        const Eigen::Index count = at.size();
        Eigen::MatrixXd coordinates(count, dimensions);
        for (Eigen::Index i = 0; i < count; ++i)
        {
            coordinates.row(i) = coordinatesOf(study, at[i]).transpose();
        }
        const GaussianProcess process(coordinates, Eigen::Map<Eigen::VectorXd>(residuals.data(), count),
            Eigen::Map<Eigen::VectorXd>(variances.data(), count));
        for (std::size_t i = 0; i < conditions.size(); ++i)
        {
            const auto value = process(coordinatesOf(study, conditions[i]));
            predictions[i].mean(f) += value.mean;
            predictions[i].variance(f) += value.variance;
        }
    }
    return predictions;
}

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
        predictNull();
        predictMembers();
        predictControls();
        findScored();
        score();
        findNoise();
        judge();
        return std::move(result_);
    }

private:
    struct Scored
    {
        HeldOutScore score;
        std::vector<double> draws; // of the rms error
    };

    std::vector<Simulation> simulated(const Setting& setting, const std::string& purpose)
    {
        return studySimulator_.repeats(
            result_.conditions, setting, "held out, " + purpose, study_.settings.repeatsHeldOut);
    }

    std::vector<Prediction> predictionsOf(const std::vector<Simulation>& simulations) const
    {
        return mapped(result_.conditions, [&](std::size_t c) {
            return predictionOf(featureRows(simulations, c, study_.featureCount()), study_, answer_);
        });
    }

    Scored scored(const std::vector<Prediction>& predictions)
    {
        Scored one;
        one.score = heldOutScore(result_.data, predictions, scored_, noise_, random_, &one.draws);
        return one;
    }

    void predictNull()
    {
        result_.simulations.push_back(simulated(answer_.null.setting, "before"));
        for (std::size_t i = 0; i < result_.data.size(); ++i)
        {
            result_.data[i].errorSlopes =
                commonErrorSlopes(studySimulator_, result_.conditions[i], result_.simulations.back());
        }
        compared_.push_back(predictionsOf(result_.simulations.back()));
        result_.predictedBefore = compared_.front();
    }

    void predictMembers()
    {
        for (const auto& member : answer_.set)
        {
            auto after = simulated(member.setting, nameOf(study_, member.effects));
            compared_.push_back(predictionsOf(after));
            if (result_.simulations.size() == 1)
            {
                result_.predictedAfter = compared_.back();
                result_.simulations.push_back(std::move(after));
            }
        }
    }

    void predictControls()
    {
        const FreeOperation more = fitOneMore(studySimulator_, library_, answer_, training_);
        result_.oneMoreAmplitude = more.size;
        auto oneMore = simulated(studySimulator_.plainSetting(more.parameters), "one more parameter");
        for (auto& simulation : oneMore)
        {
            if (!simulation.failed)
            {
                const auto& operation = chainOperations().at(study_.settings.oneMoreParameter);
                simulation.features = studySimulator_.featuresOf(operation.apply(simulation.curve, more.size));
            }
        }
        compared_.push_back(predictionsOf(oneMore));
    }

    /// All predictions are compared on the same features: those that were measured and that all of them predict.
    void findScored()
    {
        for (std::size_t i = 0; i < result_.conditions.size(); ++i)
        {
            const Eigen::VectorXd measured = meanFeatures(result_.data[i].features);
            scored_.emplace_back();
            for (const auto f : logFeatures(study_))
            {
                const bool isPredicted = std::all_of(compared_.begin(), compared_.end(),
                    [&](const auto& predictions) { return std::isfinite(predictions[i].mean(f)); });
                if (std::isfinite(measured(f)) && isPredicted)
                {
                    scored_.back().push_back(f);
                }
                else if (std::isfinite(measured(f)))
                {
                    unpredicted_.push_back("no prediction of " + study_.features[f].name + " in "
                                           + study_.conditions[result_.conditions[i]].name);
                }
            }
        }
    }

    void score()
    {
        noise_ = drawDataNoise(result_.data, result_.predictedBefore, draws, random_);
        before_ = scored(result_.predictedBefore);
        result_.before = before_.score;
        for (std::size_t member = 0; member < answer_.set.size(); ++member)
        {
            Scored one = scored(compared_[1 + member]);
            result_.members.push_back(one.score);
            if (member == 0)
            {
                result_.after = one.score;
                after_ = std::move(one);
            }
        }
        oneMore_ = scored(compared_.back());
        result_.oneMoreParameter = oneMore_.score;
        if (const auto smooth =
                withGaussianProcess(study_, answer_, training_, result_.conditions, result_.predictedBefore))
        {
            result_.gaussianProcess = scored(*smooth).score;
        }
    }

    /// Error from noise alone: that of a prediction whose mean equals the measured one.
    void findNoise()
    {
        auto right = result_.after ? result_.predictedAfter : result_.predictedBefore;
        for (std::size_t i = 0; i < right.size(); ++i)
        {
            right[i].mean = meanFeatures(result_.data[i].features);
        }
        const auto errors = scored(right).draws;
        const Eigen::Map<const Eigen::ArrayXd> all(errors.data(), errors.size());
        result_.noiseFloor = std::sqrt(all.square().mean());
        result_.noiseLimit = quantile(errors, 0.99);
    }

    void judge()
    {
        if (!result_.after)
        {
            return;
        }
        result_.improvement = difference(before_, after_);
        result_.overOneMore = difference(oneMore_, after_);
        auto& reasons = result_.notAcceptedBecause = std::move(unpredicted_);
        if (answer_.decision != Decision::named)
        {
            reasons.emplace_back("it is not the only explanation");
        }
        if (!isBeyondItsError(result_.improvement))
        {
            reasons.emplace_back("the error does not fall significantly");
        }
        if (!isBeyondItsError(result_.overOneMore))
        {
            reasons.emplace_back("one more free parameter predicts as well");
        }
        if (result_.after->rmsLogError.value > result_.noiseLimit)
        {
            reasons.emplace_back("the remaining error is larger than noise");
        }
    }

    bool isBeyondItsError(const Estimate& estimate) const
    {
        const double sds = normalQuantile(1.0 - study_.settings.level);
        return estimate.value > sds * estimate.standardError;
    }

    /// Difference of two rms errors. Its standard error is taken draw by draw, so that noise common to both cancels.
    static Estimate difference(const Scored& larger, const Scored& smaller)
    {
        const auto drawsOf = [](const Scored& one) {
            return Eigen::Map<const Eigen::ArrayXd>(one.draws.data(), one.draws.size());
        };
        const Eigen::ArrayXd gain = drawsOf(larger) - drawsOf(smaller);
        return {larger.score.rmsLogError.value - smaller.score.rmsLogError.value,
            std::sqrt((gain - gain.mean()).square().mean())};
    }

    StudySimulator& studySimulator_;
    const Study& study_;
    const Library& library_;
    const Answer& answer_;
    const std::vector<MeasuredCondition>& training_;
    std::mt19937_64& random_;
    std::vector<std::vector<Prediction>> compared_; // of the null, the members of the set, control 1
    std::vector<std::vector<Eigen::Index>> scored_; // features, by condition
    std::vector<std::string> unpredicted_;          // measured features that are not scored
    std::vector<Eigen::MatrixXd> noise_;            // of the measurements
    Scored before_;
    Scored after_;
    Scored oneMore_;
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
