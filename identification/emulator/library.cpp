#include "emulator/library.h"

#include "lists.h"

#include <map>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

/// Levels of a parameter in the design, in prior standard deviations. Fits lie within two.
constexpr double parameterStep = 1.5;

/// Levels of a parameter in runs without effects, in prior standard deviations, and number of runs at each.
constexpr double axialStep = 2.5;
constexpr int axialRepeats = 3;

/// Whether an effect is left out of the design: a switch has no lower level, and an effect that raises the scatter in
/// half of the design's runs would hide all other effects.
bool runsAlone(const Effect& effect)
{
    return effect.isSwitch || effect.raisesScatter;
}

/// Orders of one condition's library.
class Orders
{
public:
    Orders(const StudySimulator& studySimulator, std::size_t condition)
        : plain_(studySimulator.plainSetting()),
          study_(studySimulator.study()),
          condition_(condition)
    {}

    std::vector<SimulationOrder> all()
    {
        const bool scatters = study_.simulator.scatters();
        add(plain_, "base", scatters ? study_.settings.repeatsBase : 1);
        // In the design all parameters are at one of two levels; the runs outside of it show the curvature.
        for (std::size_t p = 0; p < study_.parameters.size(); ++p)
        {
            for (const double side : {-1.0, 1.0})
            {
                scatters ? add(at(p, side * axialStep), study_.parameters[p].name + " alone", axialRepeats)
                         : add(at(p, side * parameterStep), "design", 1);
            }
        }
        std::vector<std::size_t> designed;
        for (const auto e : simulatedEffects(study_, condition_))
        {
            const Effect& effect = study_.effects[e];
            const auto [lower, upper] = effect.bounds;
            if (!scatters)
            {
                // A one-sided effect is also simulated at half its amplitude.
                for (const double amplitude : {lower == 0.0 && !effect.isSwitch ? upper / 2.0 : lower, upper})
                {
                    add(with(e, amplitude), "design", amplitude != 0.0 ? 1 : 0);
                }
            }
            else if (runsAlone(effect))
            {
                add(with(e, upper), effect.name + " alone", study_.settings.repeatsAlone);
            }
            else
            {
                designed.push_back(e);
                // The design has two levels; a run at half the amplitude shows whether the effect is linear.
                add(with(e, upper / 2.0), effect.name + " alone", lower >= 0.0 ? 1 : 0);
            }
        }
        if (scatters)
        {
            addDesign(designed);
        }
        return std::move(orders_);
    }

private:
    Setting with(std::size_t effect, double amplitude) const
    {
        Setting setting = plain_;
        setting.amplitudes(effect) = amplitude;
        return setting;
    }

    /// A setting with one parameter changed. If the parameter belongs to an effect, the effect is switched on.
    Setting at(std::size_t parameter, double sds) const
    {
        const Parameter& own = study_.parameters[parameter];
        Setting setting = own.effect ? with(*own.effect, study_.effects[*own.effect].bounds.upper) : plain_;
        setting.parameters(parameter) = own.at(sds);
        return setting;
    }

    /// Orders of one purpose are numbered consecutively, so that each has its own seed.
    void add(const Setting& setting, const std::string& purpose, int count)
    {
        int& number = numbers_[purpose];
        for (int i = 0; i < count; ++i)
        {
            orders_.push_back({condition_, setting, purpose, number++});
        }
    }

    void addDesign(const std::vector<std::size_t>& effects)
    {
        const Eigen::Index parameters = study_.parameters.size();
        const auto factors = parameters + static_cast<Eigen::Index>(effects.size());
        if (factors == 0)
        {
            return;
        }
        const Eigen::MatrixXd design = foldover(plackettBurman(factors));
        for (const auto& row : design.rowwise())
        {
            Setting setting = plain_;
            for (Eigen::Index p = 0; p < parameters; ++p)
            {
                setting.parameters(p) = study_.parameters[p].at(parameterStep * row(p));
            }
            for (std::size_t k = 0; k < effects.size(); ++k)
            {
                const Bounds& bounds = study_.effects[effects[k]].bounds;
                const bool high = row(parameters + static_cast<Eigen::Index>(k)) > 0.0;
                setting.amplitudes(effects[k]) = high ? bounds.upper : bounds.lower;
            }
            add(setting, "design", 1);
        }
    }

    const Setting plain_;
    const Study& study_;
    std::size_t condition_;
    std::map<std::string, int> numbers_; // of orders, by purpose
    std::vector<SimulationOrder> orders_;
};

} // namespace

Eigen::MatrixXd foldover(const Eigen::MatrixXd& design)
{
    Eigen::MatrixXd both(2 * design.rows(), design.cols());
    both << design, -design;
    return both;
}

std::vector<std::size_t> simulatedEffects(const Study& study, std::size_t condition)
{
    return numbersWhere(study.effects.size(), [&](std::size_t e) {
        return !study.effects[e].isOfChain() && acts(study.effects[e], study.conditions[condition]);
    });
}

std::vector<const Simulation*> goodRuns(const std::vector<Simulation>& runs, std::size_t condition)
{
    std::vector<const Simulation*> good;
    for (const auto& run : runs)
    {
        if (run.condition == condition && !run.failed)
        {
            good.push_back(&run);
        }
    }
    return good;
}

std::vector<SimulationOrder> libraryOrders(const StudySimulator& studySimulator)
{
    std::vector<SimulationOrder> all;
    for (const auto condition : studySimulator.study().conditionsOf(Role::training))
    {
        append(all, Orders(studySimulator, condition).all());
        append(all, commonErrorOrders(studySimulator, condition));
    }
    return all;
}

Library makeLibrary(StudySimulator& studySimulator)
{
    const Study& study = studySimulator.study();
    // The runs at the base setting come first: if they fail, all other runs would be useless.
    std::vector<SimulationOrder> first;
    std::vector<SimulationOrder> rest;
    for (const auto condition : study.conditionsOf(Role::training))
    {
        for (const auto& order : Orders(studySimulator, condition).all())
        {
            (order.purpose == "base" ? first : rest).push_back(order);
        }
    }
    Library library{studySimulator.run(first), {}};
    for (const auto condition : study.conditionsOf(Role::training))
    {
        if (goodRuns(library.runs, condition).empty())
        {
            throw std::runtime_error("condition '" + study.conditions[condition].name
                                     + "': all runs at the base setting have failed"
                                     + studySimulator.effort().lastFailure());
        }
    }
    const auto base = library.runs;
    append(library.runs, studySimulator.run(rest));
    library.errorSlopes.resize(study.conditions.size());
    for (const auto condition : study.conditionsOf(Role::training))
    {
        library.errorSlopes[condition] = sharedErrorSlopes(studySimulator, condition, base);
    }
    return library;
}

} // namespace clepsydra::identification
