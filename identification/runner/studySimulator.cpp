#include "runner/studySimulator.h"

#include "lists.h"
#include "effects/measuringChain.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace clepsydra::identification
{

namespace
{

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

/// An effect or a common error of a setting, with the value of the variable in its formulas.
struct Influence
{
    const std::map<std::string, Expression>& entries;
    const std::string& chainOperation;
    const std::optional<Expression>& chainSize;
    std::string variable;
    double value;
    const Effect* effect; // null for a common error
};

/// Effects come before common errors.
std::vector<Influence> influencesOf(const Study& study, std::size_t condition, const Setting& setting)
{
    std::vector<Influence> influences;
    for (std::size_t i = 0; i < study.effects.size(); ++i)
    {
        const Effect& effect = study.effects[i];
        if (setting.amplitudes(i) != 0.0 && acts(effect, study.conditions[condition]))
        {
            influences.push_back(
                {effect.entries, effect.chainOperation, effect.chainSize, "a", setting.amplitudes(i), &effect});
        }
    }
    for (Eigen::Index i = 0; i < setting.errors.size(); ++i)
    {
        const CommonError& error = study.commonErrors[i];
        if (setting.errors(i) != 0.0 && contains(error.conditions, condition))
        {
            influences.push_back({error.entries, error.chainOperation, error.chainSize, error.variable,
                error.unit * setting.errors(i), nullptr});
        }
    }
    return influences;
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
    Entries entries = study_.conditions[condition].entries;
    entries.insert(study_.simulator.entries.begin(), study_.simulator.entries.end());
    for (std::size_t i = 0; i < study_.parameters.size(); ++i)
    {
        const Parameter& own = study_.parameters[i];
        assign(entries, defaults_, own.entries, own.name, std::clamp(setting.parameters(i), own.lower, own.upper));
    }
    for (const auto& influence : influencesOf(study_, condition, setting))
    {
        const Effect* effect = influence.effect;
        try
        {
            assign(entries, defaults_, influence.entries, influence.variable, influence.value);
        }
        catch (const std::exception& error)
        {
            throw std::runtime_error((effect ? "effect '" + effect->name + "': " : "") + error.what());
        }
        for (const auto& [name, value] : effect ? effect->textEntries : Entries())
        {
            entries[name] = value;
        }
    }
    return entries;
}

Curve StudySimulator::throughChain(Curve curve, std::size_t condition, const Setting& setting) const
{
    for (const auto& influence : influencesOf(study_, condition, setting))
    {
        if (influence.chainSize)
        {
            const double size = (*influence.chainSize)({{influence.variable, influence.value}});
            curve = chainOperations().at(influence.chainOperation).apply(std::move(curve), size);
        }
    }
    return curve;
}

Eigen::VectorXd StudySimulator::featuresOf(const Curve& curve) const
{
    return Eigen::VectorXd::NullaryExpr(study_.featureCount(), [&](Eigen::Index i) {
        const double value = curve.time.size() >= 2 ? study_.features[i](curve) : NAN;
        return std::isfinite(value) ? value : NAN;
    });
}

/// The observable with the factor and the offset that its condition states.
Curve StudySimulator::observed(Curve curve, std::size_t condition, const Entries& entries) const
{
    const auto numbers = numbersOf(entries, defaults_);
    const auto& [factorOf, offsetOf] = study_.conditions[condition].observable;
    const double factor = factorOf(numbers);
    const double offset = offsetOf(numbers);
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

void StudySimulator::requireBudget(int more, const std::string& purpose) const
{
    const int budget = study_.settings.budget;
    if (effort_.executed + more > budget)
    {
        const std::string needs = '\'' + purpose + "' needs " + std::to_string(more) + " more runs";
        throw std::runtime_error(study_.file.string()
                                 + (budget == 0 // a report from stored runs alone
                                         ? ": not all runs are stored; " + needs
                                         : ": budget.runs is " + std::to_string(budget) + "; "
                                               + std::to_string(effort_.executed) + " have been made, and " + needs
                                               + ". Increase budget.runs; runs that have been made are stored"));
    }
}

std::vector<Simulation> StudySimulator::run(const std::vector<SimulationOrder>& orders)
{
    std::vector<Simulation> done(orders.size());
    std::vector<std::size_t> failing; // the orders of the failures that are added here
    auto open = numbersWhere(orders.size(), [](std::size_t) { return true; });
    // Without a seed, a second attempt would fail in the same way.
    const int attempts = study_.simulator.scatters() ? study_.settings.attempts : 1;
    for (int attempt = 0; attempt < attempts && !open.empty(); ++attempt)
    {
        const auto runs = mapped(open, [&](std::size_t i) { return runOrder(orders[i], attempt); });
        requireBudget(simulator_.missing(runs), orders[open.front()].purpose);
        const auto results = simulator_.run(runs);
        for (std::size_t k = 0; k < open.size(); ++k)
        {
            const RunResult& result = results[k];
            const auto& [condition, setting, purpose, number, seeds] = orders[open[k]];
            Simulation& simulation = done[open[k]];
            simulation = {condition, setting, {}, {}, observed(result.curve, condition, runs[k].entries)};
            simulation.curve = simulation.plain.time.size() < 2 ? simulation.plain
                                                                : throughChain(simulation.plain, condition, setting);
            simulation.features = featuresOf(simulation.curve);
            ++effort_.runsByPurpose[purpose];
            effort_.seedsByPurpose[purpose].push_back(runs[k].seed);
            effort_.executed += result.cached ? 0 : 1;
            (result.cached ? effort_.secondsOfStored : effort_.seconds) += result.seconds;
            const std::string reason = failureOf(simulation, result);
            simulation.failed = !reason.empty();
            if (simulation.failed)
            {
                simulation.features.setConstant(NAN);
                effort_.failures.push_back({purpose, study_.conditions[condition].name, runs[k].seed, reason, false});
                failing.push_back(open[k]);
            }
        }
        open = numbersWhere(orders.size(), [&](std::size_t i) { return done[i].failed; });
    }
    for (std::size_t k = 0; k < failing.size(); ++k)
    {
        effort_.failures[effort_.failures.size() - failing.size() + k].repeated = !done[failing[k]].failed;
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
