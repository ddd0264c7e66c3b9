#include "heldOut/heldOut.h"

#include "effects/measuringChain.h"
#include "heldOut/gaussianProcess.h"
#include "procedure/assemble.h"

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

constexpr int draws = 1000;
constexpr double smallChange = 0.01; // of control 1's operation on a curve, for its derivative

std::vector<Eigen::Index> logFeatures(const Study& study)
{
    std::vector<Eigen::Index> logs;
    std::vector<Eigen::Index> all;
    for (std::size_t f = 0; f < study.features.size(); ++f)
    {
        all.push_back(static_cast<Eigen::Index>(f));
        if (study.features[f].kind->name.rfind("log", 0) == 0)
        {
            logs.push_back(all.back());
        }
    }
    return logs.empty() ? all : logs;
}

Prediction predictionOf(const Eigen::MatrixXd& features, const Noise& noise)
{
    const double seeds = std::max(1.0, static_cast<double>(features.array().isFinite().rowwise().any().count()));
    Prediction prediction;
    prediction.mean = meanFeatures(features);
    prediction.variance = noise.simulation.matrix.diagonal() / seeds + noise.modelError.cwiseAbs2();
    prediction.dataCovariance = noise.data.matrix;
    return prediction;
}

/// Control 1: one operation on the curves with a free size, fitted together with the parameters.
struct FreeOperation
{
    double size = 0.0;
    Eigen::VectorXd parameters;
};

Curve changed(const Study& study, const Curve& curve, double size)
{
    return chainOperations().at(study.settings.oneMoreParameter).apply(curve, size);
}

FreeOperation fitOneMore(Simulator& simulator, const EffectLibrary& library, const Answer& answer,
    const std::vector<MeasuredCondition>& training)
{
    const Study& study = simulator.study();
    const Eigen::VectorXd anchor = physical(study, answer.problem.parameterOffset);
    ResidualProblem problem = assemble(study, library, training, answer.atFit, anchor);
    // The derivative of the features by the operation's size, as one more effect without bounds.
    auto moved = answer.atFit;
    for (auto& simulation : moved)
    {
        if (!simulation.failed)
        {
            simulation.features = simulator.featuresOf(changed(study, simulation.curve, smallChange));
        }
    }
    const ResidualProblem shifted = assemble(study, library, training, moved, anchor);
    if (shifted.residual.size() != problem.residual.size())
    {
        return {0.0, answer.null.setting.parameters};
    }
    problem.effectColumns = (problem.residual - shifted.residual) / smallChange;
    problem.columnShare = Eigen::MatrixXd::Zero(problem.columnShare.rows(), 1);
    const Fits fits(whitened(problem, answer.noise));
    const auto fit = fits.effect(0, -0.5, 0.5);
    return {fit.amplitude, physical(study, problem.parameterOffset + fits.parameterShift(0, fit.amplitude))};
}

Eigen::VectorXd coordinatesOf(const Study& study, std::size_t condition)
{
    std::vector<double> values;
    for (const auto& [name, value] : study.conditions[condition].coordinates)
    {
        values.push_back(value);
    }
    return Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Control 2: a Gaussian process through what the null leaves, feature by feature, over the conditions' coordinates.
std::vector<Prediction> withGaussianProcess(const Study& study, const Answer& answer,
    const std::vector<MeasuredCondition>& training, const std::vector<std::size_t>& conditions,
    std::vector<Prediction> predictions)
{
    const auto trained = study.conditionsOf(Role::training);
    const Eigen::Index dimensions = coordinatesOf(study, trained.front()).size();
    const auto same = [&](std::size_t c) { return coordinatesOf(study, c).size() == dimensions; };
    if (dimensions == 0 || !std::all_of(trained.begin(), trained.end(), same)
        || !std::all_of(conditions.begin(), conditions.end(), same))
    {
        return predictions;
    }
    for (Eigen::Index f = 0; f < study.featureCount(); ++f)
    {
        std::vector<double> residuals;
        std::vector<double> variances;
        std::vector<std::size_t> at;
        for (const auto c : trained)
        {
            const Eigen::MatrixXd simulated = featureRows(answer.atFit, c, study.featureCount());
            const double residual = meanFeatures(training[c].features)(f) - meanFeatures(simulated)(f);
            if (std::isfinite(residual))
            {
                residuals.push_back(residual);
                variances.push_back(answer.noise.data.matrix(f, f) * shareOfMean(training[c].features)(f, f)
                                    + answer.noise.simulation.matrix(f, f) / static_cast<double>(simulated.rows())
                                    + training[c].declaredError(f) * training[c].declaredError(f)
                                    + answer.noise.modelError(f) * answer.noise.modelError(f) + 1e-12);
                at.push_back(c);
            }
        }
        if (at.size() < 2)
        {
            continue;
        }
        const auto count = static_cast<Eigen::Index>(at.size());
        Eigen::MatrixXd coordinates(count, dimensions);
        for (Eigen::Index i = 0; i < count; ++i)
        {
            coordinates.row(i) = coordinatesOf(study, at[static_cast<std::size_t>(i)]).transpose();
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

} // namespace

HeldOutResult evaluateHeldOut(Simulator& simulator, const EffectLibrary& library, const Answer& answer,
    const std::vector<MeasuredCondition>& training, const std::vector<MeasuredCondition>& heldOut,
    std::mt19937_64& random)
{
    const Study& study = simulator.study();
    const auto features = study.featureCount();
    HeldOutResult result;
    for (const auto c : study.conditionsOf(Role::heldOut))
    {
        if (heldOut[c].features.rows() > 0)
        {
            result.conditions.push_back(c);
            result.data.push_back(
                {heldOut[c].features, shareOfMean(heldOut[c].features), heldOut[c].declaredError.cwiseAbs2()});
        }
    }
    const auto predict = [&](const std::vector<Simulation>& simulations) {
        std::vector<Prediction> predictions;
        for (const auto c : result.conditions)
        {
            predictions.push_back(predictionOf(featureRows(simulations, c, features), answer.noise));
        }
        return predictions;
    };
    const auto simulate = [&](const Setting& setting, const std::string& purpose) {
        return simulator.repeats(result.conditions, setting, "held out, " + purpose, study.settings.repeatsHeldOut);
    };
    const auto logs = logFeatures(study);

    const auto before = simulate(answer.null.setting, "before");
    result.predictedBefore = predict(before);
    result.simulations.push_back(before);
    const DataNoise noise = drawDataNoise(result.data, result.predictedBefore, draws, random);
    const auto scoreOf = [&](const std::vector<Prediction>& predictions, std::vector<double>* samples = nullptr) {
        return heldOutScore(result.data, predictions, logs, noise, random, samples);
    };

    std::vector<double> samplesBefore;
    result.before = scoreOf(result.predictedBefore, &samplesBefore);
    for (std::size_t member = 0; member < answer.set.size(); ++member)
    {
        std::string name;
        for (const auto e : answer.set[member].effects)
        {
            name += (name.empty() ? "" : " with ") + study.effects[e].name;
        }
        const auto after = simulate(answer.set[member].setting, name);
        const auto predicted = predict(after);
        std::vector<double> samples;
        result.members.push_back({member, scoreOf(predicted, &samples)});
        if (member == 0)
        {
            result.after = result.members.front().score;
            result.predictedAfter = predicted;
            result.simulations.push_back(after);
            Eigen::ArrayXd gain = Eigen::Map<Eigen::ArrayXd>(samplesBefore.data(), draws)
                                  - Eigen::Map<Eigen::ArrayXd>(samples.data(), draws);
            result.improvement.value = result.before.rmsLogError.value - result.after->rmsLogError.value;
            result.improvement.standardError = std::sqrt((gain - gain.mean()).square().mean());
            result.accepted = result.improvement.value > result.improvement.standardError;
        }
    }

    const FreeOperation more = fitOneMore(simulator, library, answer, training);
    result.oneMoreAmplitude = more.size;
    auto oneMore = simulate(simulator.plainSetting(more.parameters), "one more parameter");
    for (auto& simulation : oneMore)
    {
        if (!simulation.failed)
        {
            simulation.features = simulator.featuresOf(changed(study, simulation.curve, more.size));
        }
    }
    result.oneMoreParameter = scoreOf(predict(oneMore));
    result.gaussianProcess =
        scoreOf(withGaussianProcess(study, answer, training, result.conditions, result.predictedBefore));

    if (answer.bestOfUnknown)
    {
        result.bestOfUnknown = scoreOf(predict(simulate(answer.bestOfUnknown->setting, "best of unknown")));
    }

    double floor = 0.0;
    for (std::size_t i = 0; i < result.data.size(); ++i)
    {
        for (const auto f : logs)
        {
            floor += answer.noise.data.matrix(f, f) * result.data[i].meanShare(f, f)
                     + result.data[i].declaredVariance(f) + result.predictedBefore[i].variance(f);
        }
    }
    result.noiseFloor =
        std::sqrt(floor / static_cast<double>(logs.size() * std::max<std::size_t>(result.data.size(), 1)));
    return result;
}

} // namespace clepsydra::identification
