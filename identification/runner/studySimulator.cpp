#include "runner/studySimulator.h"

#include "lists.h"
#include "effects/measuringChain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace clepsydra::identification
{

namespace
{

void assign(Entries& entries, const std::map<std::string, std::string>& changes)
{
    for (const auto& [name, value] : changes)
    {
        entries[name] = value;
    }
}

/// All formulas are evaluated with the entries as they were before the first of them was assigned.
void assign(Entries& entries, const Entries& defaults, const std::map<std::string, Expression>& formulas,
    const std::string& variable, double value)
{
    auto variables = numbersOf(entries, defaults);
    variables[variable] = value;
    for (const auto& [name, formula] : formulas)
    {
        const double number = formula(variables);
        if (!std::isfinite(number))
        {
            throw std::runtime_error("the formula '" + formula.text() + "' of entry '" + name + "' gives no number at "
                                     + variable + " = " + textOf(value));
        }
        entries[name] = textOf(number);
    }
}

std::string failureOf(const Simulation& simulation, const RunResult& result)
{
    if (!result.failure.empty())
    {
        return result.failure;
    }
    if (result.curve.time.size() < 2)
    {
        return "the observable has fewer than two rows";
    }
    return simulation.features.array().isFinite().any() ? "" : "the curve has none of the features";
}

} // namespace

StudySimulator::StudySimulator(const Study& study, Simulator& simulator)
    : study_(study),
      simulator_(simulator),
      defaults_(simulator.defaults())
{}

Setting StudySimulator::plainSetting(const Eigen::VectorXd& parameters) const
{
    Setting setting{parameters, Eigen::VectorXd::Zero(study_.effects.size()), {}};
    if (parameters.size() == 0)
    {
        setting.parameters = Eigen::VectorXd::NullaryExpr(
            study_.parameters.size(), [&](Eigen::Index i) { return study_.parameters[i].mean; });
    }
    return setting;
}

Entries StudySimulator::entriesOf(std::size_t condition, const Setting& setting) const
{
    const Condition& c = study_.conditions[condition];
    Entries entries = study_.simulator.entries;
    assign(entries, c.entries);
    for (std::size_t i = 0; i < study_.parameters.size(); ++i)
    {
        const Parameter& parameter = study_.parameters[i];
        const double value = setting.parameters(i);
        assign(
            entries, defaults_, parameter.entries, parameter.name, std::clamp(value, parameter.lower, parameter.upper));
    }
    for (std::size_t i = 0; i < study_.effects.size(); ++i)
    {
        const Effect& effect = study_.effects[i];
        const double amplitude = setting.amplitudes(i);
        if (amplitude == 0.0 || effect.isOfChain() || !acts(effect, c))
        {
            continue;
        }
        try
        {
            assign(entries, defaults_, effect.entries, "a", amplitude);
        }
        catch (const std::exception& error)
        {
            throw std::runtime_error("effect '" + effect.name + "': " + error.what());
        }
        assign(entries, effect.textEntries);
    }
    for (Eigen::Index i = 0; i < setting.errors.size(); ++i)
    {
        if (setting.errors(i) != 0.0)
        {
            const CommonError& error = study_.commonErrors[i];
            assign(entries, defaults_, error.entries, error.variable, error.unit * setting.errors(i));
        }
    }
    return entries;
}

Curve StudySimulator::throughChain(Curve curve, std::size_t condition, const Setting& setting) const
{
    const auto operate = [&](const std::string& operation, const Expression& size, const std::string& variable,
                             double value) {
        curve = chainOperations().at(operation).apply(std::move(curve), size({{variable, value}}));
    };
    for (std::size_t i = 0; i < study_.effects.size(); ++i)
    {
        const Effect& effect = study_.effects[i];
        const double amplitude = setting.amplitudes(i);
        if (effect.isOfChain() && amplitude != 0.0 && acts(effect, study_.conditions[condition]))
        {
            operate(effect.chainOperation, *effect.chainSize, "a", amplitude);
        }
    }
    for (Eigen::Index i = 0; i < setting.errors.size(); ++i)
    {
        const CommonError& error = study_.commonErrors[i];
        if (error.chainSize && setting.errors(i) != 0.0)
        {
            operate(error.chainOperation, *error.chainSize, error.variable, error.unit * setting.errors(i));
        }
    }
    return curve;
}

Eigen::VectorXd StudySimulator::featuresOf(const Curve& curve) const
{
    Eigen::VectorXd features =
        Eigen::VectorXd::Constant(study_.featureCount(), std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index i = 0; i < features.size() && curve.time.size() >= 2; ++i)
    {
        const double value = study_.features[i](curve);
        features(i) = std::isfinite(value) ? value : features(i);
    }
    return features;
}

/// The observable with the factor and the offset that its condition states.
Curve StudySimulator::observed(Curve curve, std::size_t condition, const Entries& entries) const
{
    const auto numbers = numbersOf(entries, defaults_);
    const ObservableScale& scale = study_.conditions[condition].observable;
    const double factor = scale.factor(numbers);
    const double offset = scale.offset(numbers);
    for (double& value : curve.value)
    {
        value = value * factor + offset;
    }
    return curve;
}

RunOrder StudySimulator::runOrder(const SimulationOrder& order, int attempt) const
{
    const Condition& condition = study_.conditions[order.condition];
    RunOrder run;
    run.command = condition.command.empty() ? study_.simulator.command : condition.command;
    run.file = condition.file;
    run.entries = entriesOf(order.condition, order.setting);
    run.purpose = order.purpose + ", " + condition.name;
    if (study_.simulator.scatters())
    {
        const std::string seeds = order.seeds.empty() ? order.purpose : order.seeds;
        run.seed = seedOf(study_.settings.seed, seeds + (attempt > 0 ? "/" + std::to_string(attempt) : ""),
            condition.name, order.number);
        run.entries[study_.simulator.seedEntry] = std::to_string(run.seed);
    }
    return run;
}

int StudySimulator::missing(const std::vector<SimulationOrder>& orders)
{
    return simulator_.missing(mapped(orders, [&](const SimulationOrder& order) { return runOrder(order, 0); }));
}

std::vector<Simulation> StudySimulator::run(const std::vector<SimulationOrder>& orders)
{
    std::vector<Simulation> done(orders.size());
    // Indices in effort_.failures, by order: orders of different settings may share a seed.
    std::vector<std::vector<std::size_t>> failuresOf(orders.size());
    auto open = numbersWhere(orders.size(), [](std::size_t) { return true; });
    // Without a seed, a second attempt would fail in the same way.
    const int attempts = study_.simulator.scatters() ? study_.settings.attempts : 1;
    for (int attempt = 0; attempt < attempts && !open.empty(); ++attempt)
    {
        const auto runs = mapped(open, [&](std::size_t i) { return runOrder(orders[i], attempt); });
        const int toExecute = simulator_.missing(runs);
        if (effort_.executed + toExecute > study_.settings.budget)
        {
            const std::string needs =
                '\'' + orders[open.front()].purpose + "' needs " + std::to_string(toExecute) + " more runs";
            throw std::runtime_error(study_.file.string()
                                     + (study_.settings.budget == 0 // a report from stored runs alone
                                             ? ": not all runs are stored; " + needs
                                             : ": budget.runs is " + std::to_string(study_.settings.budget) + "; "
                                                   + std::to_string(effort_.executed) + " have been made, and " + needs
                                                   + ". Increase budget.runs; runs that have been made are stored"));
        }
        const auto results = simulator_.run(runs);
        std::vector<std::size_t> failed;
        for (std::size_t k = 0; k < open.size(); ++k)
        {
            const SimulationOrder& order = orders[open[k]];
            Simulation& simulation = done[open[k]];
            simulation.condition = order.condition;
            simulation.setting = order.setting;
            simulation.plain = observed(results[k].curve, order.condition, runs[k].entries);
            simulation.curve = simulation.plain;
            if (simulation.plain.time.size() >= 2)
            {
                simulation.curve = throughChain(std::move(simulation.curve), order.condition, order.setting);
            }
            simulation.features = featuresOf(simulation.curve);
            ++effort_.runsByPurpose[order.purpose];
            effort_.seedsByPurpose[order.purpose].push_back(runs[k].seed);
            effort_.executed += results[k].cached ? 0 : 1;
            (results[k].cached ? effort_.secondsOfStored : effort_.seconds) += results[k].seconds;
            const std::string reason = failureOf(simulation, results[k]);
            simulation.failed = !reason.empty();
            if (simulation.failed)
            {
                simulation.features.setConstant(std::numeric_limits<double>::quiet_NaN());
                failuresOf[open[k]].push_back(effort_.failures.size());
                effort_.failures.push_back(
                    {order.purpose, study_.conditions[order.condition].name, runs[k].seed, reason, false});
                failed.push_back(open[k]);
                continue;
            }
            for (const std::size_t failure : failuresOf[open[k]])
            {
                effort_.failures[failure].repeated = true;
            }
        }
        open = failed;
    }
    if (!open.empty() && study_.settings.onFailure == "stop")
    {
        throw std::runtime_error("a run failed, and the study has 'failures: { then: stop }'; "
                                 + effort_.failures.back().purpose + ", condition " + effort_.failures.back().condition
                                 + ": " + effort_.failures.back().reason);
    }
    return done;
}

std::vector<Simulation> StudySimulator::repeats(const std::vector<std::size_t>& conditions, const Setting& setting,
    const std::string& purpose, int repeats, const std::string& seeds)
{
    std::vector<SimulationOrder> orders;
    for (const auto condition : conditions)
    {
        for (int number = 0; number < repeats; ++number)
        {
            orders.push_back({condition, setting, purpose, number, seeds});
        }
    }
    return run(orders);
}

} // namespace clepsydra::identification
