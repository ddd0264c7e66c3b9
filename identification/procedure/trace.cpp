#include "procedure/trace.h"

#include "decision/pairs.h"
#include "emulator/settings.h"
#include "lists.h"
#include "nextRuns/chooseRuns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

/// Largest numbers of rounds of deciding runs.
struct Rounds
{
    int ofSingles; // the first simulates the null fit, the others the fits of the leading explanations
    int ofPairs;
};
constexpr Rounds rounds{3, 1};

/// If runs do not scatter, one run at each fit is enough, and each round brings the fits closer to the truth.
constexpr Rounds roundsOfExact{9, 9};

/// Largest number of explanations that get runs, in addition to no effect.
constexpr std::size_t mostContenders = 4;

/// Weight of no effect among the contenders, because the runs must also decide whether there is a residual.
constexpr double nullWeight = 0.3;

class Tracing
{
public:
    Tracing(StudySimulator& studySimulator, const Library& library, const std::vector<MeasuredCondition>& data,
        std::mt19937_64& random, bool withVisibility)
        : studySimulator_(studySimulator),
          study_(studySimulator.study()),
          data_(data),
          features_(measuredFeatures(study_, data)),
          runs_(library.runs),
          errorSlopes_(library.errorSlopes),
          random_(random),
          withVisibility_(withVisibility)
    {}

    Answer run()
    {
        learn();
        Eigen::VectorXd around = Eigen::VectorXd::Zero(study_.parameters.size());
        for (int round = 0; round < rounds_.ofSingles; ++round)
        {
            const Evidence evidence = evidenceNear(around);
            around = evidence.fitNull(answer_.measured).parameters;
            const bool libraryAlone = study_.settings.decidingRuns == 0;
            if (libraryAlone || !(round == 0 ? simulateNull(around) : simulateContenders(evidence, round)))
            {
                break;
            }
            learn();
        }
        decide(evidenceNear(around));
        if (answer_.decision == Decision::unknown)
        {
            tryPairs(around);
        }
        refuseStrainedName();
        if (answer_.decision == Decision::unknown)
        {
            findNearest();
        }
        return std::move(answer_);
    }

private:
    /// Builds the emulator of all runs made so far.
    void learn()
    {
        answer_.emulator = std::make_shared<Emulator>(study_, studySimulator_, runs_, features_);
        std::tie(answer_.layout, answer_.measured) = arrange(study_, *answer_.emulator, data_, errorSlopes_);
    }

    Evidence evidenceNear(const Eigen::VectorXd& parameters) const
    {
        Evidence evidence(study_, *answer_.emulator, answer_.layout, parameters);
        evidence.refine(answer_.measured);
        return evidence;
    }

    /// \return whether any of the runs has succeeded
    bool add(const std::vector<Simulation>& more)
    {
        append(runs_, more);
        return std::any_of(more.begin(), more.end(), [](const Simulation& run) { return !run.failed; });
    }

    bool simulateNull(const Eigen::VectorXd& parameters)
    {
        const int repeats = scatters_ ? std::max(1, study_.settings.decidingRuns / rounds_.ofSingles) : 1;
        const auto conditions = mapped(answer_.layout.blocks, [](const auto& block) { return block.condition; });
        const Setting setting = settingOf(studySimulator_, parameters, {});
        if (!add(studySimulator_.repeats(conditions, setting, "null fit", repeats)))
        {
            throw std::runtime_error("all runs at the null fit have failed" + studySimulator_.effort().lastFailure());
        }
        return true;
    }

    bool simulateContenders(const Evidence& evidence, int round)
    {
        const Odds odds = oddsOf(study_, evidence(answer_.measured));
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t e = 0; e < study_.effects.size(); ++e)
        {
            order.emplace_back(odds.effects(e), e);
        }
        std::sort(order.rbegin(), order.rend());
        std::vector<Contender> contenders = {{{}, evidence.fitNull(answer_.measured).parameters, nullWeight}};
        for (std::size_t i = 0; i < std::min(mostContenders, order.size()); ++i)
        {
            const auto& [log, e] = order[i];
            if (log < order.front().first - negligibleLogOdds || !std::isfinite(log))
            {
                break;
            }
            addContender(contenders, {e}, {evidence.fit(e, answer_.measured)}, log - order.front().first, i == 0);
        }
        return simulateAmong(contenders, "deciding, round " + std::to_string(round));
    }

    /// \param logOdds  relative to those of the leading explanation
    void addContender(std::vector<Contender>& contenders, const std::vector<std::size_t>& effects,
        const std::vector<Fit>& fits, double logOdds, bool leads) const
    {
        // The square root of the odds, so that an explanation that is behind by chance gets runs too.
        contenders.push_back({presentAt(effects, fits), fits.front().parameters, std::exp(0.5 * logOdds)});
        if (leads && !scatters_)
        {
            addNeighbours(contenders, fits);
        }
    }

    /// Adds copies of the last contender, in each of which one fitted quantity is changed by its standard error. Runs
    /// there give the slopes for the next fit.
    void addNeighbours(std::vector<Contender>& contenders, const std::vector<Fit>& fits) const
    {
        const Contender centre = contenders.back();
        for (Eigen::Index p = 0; p < centre.parameters.size(); ++p)
        {
            const double error = std::sqrt(fits.front().covariance(p, p));
            const double end = study_.parameters[p].boundsInSds().upper;
            contenders.push_back(centre);
            contenders.back().parameters(p) += centre.parameters(p) + error > end ? -error : error;
        }
        for (std::size_t k = 0; k < fits.size(); ++k)
        {
            const auto& [effect, amplitude] = centre.present[k];
            if (!study_.effects[effect].isSwitch)
            {
                const double error = fits[k].sd;
                const double end = study_.effects[effect].bounds.upper;
                contenders.push_back(centre);
                contenders.back().present[k].amplitude += amplitude + error > end ? -error : error;
            }
        }
    }

    /// Makes the runs that distinguish the contenders best. \return whether any run has succeeded
    bool simulateAmong(const std::vector<Contender>& contenders, const std::string& purpose)
    {
        std::map<std::pair<std::size_t, std::size_t>, int> numbers;
        std::vector<SimulationOrder> orders;
        const int all = study_.settings.decidingRuns * static_cast<int>(answer_.layout.blocks.size());
        const auto wanted = scatters_
                                ? chooseRuns(*answer_.emulator, answer_.layout, contenders, all / rounds_.ofSingles)
                                : openRuns(study_, *answer_.emulator, answer_.layout, contenders, runs_);
        for (const auto& [contender, condition] : wanted)
        {
            const auto& [present, parameters, weight] = contenders[contender];
            const auto effects = mapped(present, [](const Present& one) { return one.effect; });
            orders.push_back({condition, settingOf(studySimulator_, parameters, present),
                purpose + ": " + nameOf(study_, effects), numbers[{contender, condition}]++});
        }
        return !orders.empty() && add(studySimulator_.run(orders));
    }

    /// Tries pairs of effects if no single effect explains the data.
    void tryPairs(const Eigen::VectorXd& around)
    {
        for (int round = 0; round < rounds_.ofPairs; ++round)
        {
            Evidence evidence = evidenceNear(around);
            const auto leading = leadingPairs(study_, evidence, answer_.measured);
            if (leading.empty())
            {
                return;
            }
            std::vector<Contender> contenders;
            for (const auto& pair : leading)
            {
                addContender(contenders, pair.effects, pair.fits, pair.logOdds - leading.front().logOdds,
                    &pair == &leading.front());
            }
            if (!simulateAmong(contenders, "deciding between pairs"))
            {
                break;
            }
            learn();
        }
        Evidence evidence = evidenceNear(around);
        auto pairs = leadingPairs(study_, evidence, answer_.measured);
        Replicas replicas(*answer_.emulator, answer_.layout, evidence, random_);
        const double other = judgePairs(pairs, study_, evidence, replicas, answer_.measured, random_);
        for (auto& pair : pairs)
        {
            if (!pair.inSet)
            {
                continue;
            }
            const Contender own{presentAt(pair.effects, pair.fits), pair.fits.front().parameters, 1.0};
            const Explanation found = explanation(pair.effects, pair.fits, pair.logOdds, pair.probability);
            pair.inSet = scatters_ || openRuns(study_, *answer_.emulator, answer_.layout, {own}, runs_).empty();
            if (pair.inSet)
            {
                answer_.set.push_back(found);
            }
            else
            {
                answer_.remarks.push_back(
                    nameOf(study_, pair.effects)
                    + " might explain the measurements, but no run near its fit confirms it: "
                    + (found.runs.empty() ? "none was made, since other pairs looked better at first"
                                          : "each run that was made has moved the fit"));
            }
        }
        if (!answer_.set.empty())
        {
            const bool isName = mayBeNamed(study_, pairs);
            answer_.decision = isName ? Decision::named : Decision::set;
            answer_.unlistedCauseInSet = !isName;
            answer_.otherProbability = other;
            answer_.otherThreshold = std::numeric_limits<double>::quiet_NaN();
            answer_.family = isName && answer_.set.size() > 1 ? sharedName(study_, pairs) : "";
        }
    }

    void refuseStrainedName()
    {
        const std::string reason = answer_.decision == Decision::named ? strainOf(study_, answer_.set.front()) : "";
        if (!reason.empty())
        {
            answer_.decision = Decision::set;
            answer_.unlistedCauseInSet = true;
            answer_.family = "";
            answer_.remarks.push_back(nameOf(study_, answer_.set.front().effects) + " is not named: " + reason);
        }
    }

    static std::vector<Present> presentAt(const std::vector<std::size_t>& effects, const std::vector<Fit>& fits)
    {
        std::vector<Present> present;
        for (std::size_t k = 0; k < effects.size(); ++k)
        {
            present.push_back({effects[k], fits[k].amplitude});
        }
        return present;
    }

    void decide(const Evidence& evidence)
    {
        const Measured& measured = answer_.measured;
        Replicas replicas(*answer_.emulator, answer_.layout, evidence, random_);
        answer_.calibration = calibrate(study_, evidence, replicas, measured, random_);
        const Calibration& calibration = answer_.calibration;
        const Evidences evidences = evidence(measured);
        const Odds odds = oddsOf(study_, evidences);
        answer_.logOdds = odds.logOdds;
        answer_.pValue = calibration.pValue(odds);
        answer_.otherProbability = std::exp(odds.other);
        answer_.otherThreshold = std::exp(calibration.otherMembership);
        answer_.null = explanation({}, {evidence.fitNull(measured)}, 0.0, 0.0);
        for (std::size_t e = 0; e < study_.effects.size(); ++e)
        {
            EffectFinding& finding = answer_.effects.emplace_back();
            finding.fit = calibration.widened(e, evidence.fit(e, measured), study_.effects[e].bounds);
            finding.parameters = physical(study_, finding.fit.parameters);
            finding.logOdds = odds.effects(e) + odds.logOdds;
            finding.probability = std::exp(odds.effects(e));
            finding.chiSquare = odds.chiSquares(e);
            finding.threshold = std::exp(calibration.membership(e));
            finding.known = answer_.emulator->knows(e);
            if (study_.effects[e].measured && finding.known)
            {
                finding.alone = evidence.fitAlone(e, measured);
            }
        }
        if (withVisibility_)
        {
            // A copy of the random generator, so that the visibility does not change the decision.
            std::mt19937_64 own = random_;
            answer_.visibility = visibility(study_, evidence, replicas, calibration, own);
        }
        append(answer_.remarks, answer_.emulator->remarks());
        if (!isDetected(study_, calibration, odds))
        {
            return;
        }
        for (std::size_t e = 0; e < study_.effects.size(); ++e)
        {
            EffectFinding& finding = answer_.effects[e];
            finding.notInSetBecause = finding.probability >= finding.threshold ? exclusionOf(calibration, odds, e) : "";
        }
        for (const auto e : membersOf(calibration, odds))
        {
            answer_.effects[e].inSet = true;
            answer_.set.push_back(explanationBy(e));
        }
        answer_.unlistedCauseInSet = odds.other >= calibration.otherMembership;
        if (answer_.set.size() == 1)
        {
            addRival(calibration, odds);
        }
        const auto sole = soleMember(study_, calibration, odds);
        if (answer_.set.empty())
        {
            answer_.decision = Decision::unknown;
            answer_.unlistedCauseInSet = true;
        }
        else if (sole && marginOf(study_, odds, *sole) >= calibration.naming(*sole))
        {
            answer_.decision = Decision::named;
            answer_.family = answer_.set.size() > 1 ? study_.effects[*sole].family : "";
        }
        else
        {
            answer_.decision = Decision::set;
            // A single member that may not be named: an unlisted cause cannot be excluded.
            answer_.unlistedCauseInSet = answer_.unlistedCauseInSet || sole || answer_.set.size() == 1;
            if (sole)
            {
                answer_.oddsOfName = {marginOf(study_, odds, *sole), calibration.naming(*sole)};
            }
        }
    }

    void findNearest()
    {
        const auto known = numbersWhere(study_.effects.size(), [&](std::size_t e) { return answer_.effects[e].known; });
        const auto nearest = std::min_element(known.begin(), known.end(), [&](std::size_t a, std::size_t b) {
            return answer_.effects[a].fit.chiSquare < answer_.effects[b].fit.chiSquare;
        });
        if (nearest != known.end())
        {
            answer_.nearest = explanationBy(*nearest);
        }
    }

    /// One effect alone, as it was found.
    Explanation explanationBy(std::size_t effect) const
    {
        const EffectFinding& finding = answer_.effects[effect];
        return explanation({effect}, {finding.fit}, finding.logOdds, finding.probability);
    }

    void addRival(const Calibration& calibration, const Odds& odds)
    {
        const auto others = numbersWhere(study_.effects.size(), [&](std::size_t e) {
            return !answer_.effects[e].inSet && exclusionOf(calibration, odds, e).empty()
                   && odds.effects(e) > odds.effects(answer_.set.front().effects.front()) - negligibleLogOdds;
        });
        const auto rival = std::max_element(others.begin(), others.end(),
            [&](std::size_t a, std::size_t b) { return odds.effects(a) < odds.effects(b); });
        if (rival != others.end())
        {
            answer_.rivals.push_back(explanationBy(*rival));
        }
    }

    /// \param fits  of the effects; their parameters are equal
    Explanation explanation(
        const std::vector<std::size_t>& effects, const std::vector<Fit>& fits, double logOdds, double probability) const
    {
        Explanation found{effects, settingOf(studySimulator_, fits.front().parameters, presentAt(effects, fits)), fits,
            logOdds, probability, fits.front().chiSquare, {}};
        std::copy_if(
            runs_.begin() + librarySize_, runs_.end(), std::back_inserter(found.runs), [&](const Simulation& run) {
                const auto& amplitudes = run.setting.amplitudes.array();
                const auto isOn = [&](std::size_t effect) { return amplitudes(effect) != 0.0; };
                return !run.failed && std::all_of(effects.begin(), effects.end(), isOn)
                       && (amplitudes != 0.0).count() == static_cast<Eigen::Index>(effects.size());
            });
        return found;
    }

    StudySimulator& studySimulator_;
    const Study& study_;
    const std::vector<MeasuredCondition>& data_;
    const std::vector<std::vector<Eigen::Index>> features_;
    std::vector<Simulation> runs_;
    const std::vector<Eigen::MatrixXd>& errorSlopes_;
    const std::ptrdiff_t librarySize_ = runs_.size();
    const bool scatters_ = study_.simulator.scatters();
    const Rounds rounds_ = scatters_ ? rounds : roundsOfExact;
    std::mt19937_64& random_;
    const bool withVisibility_;
    Answer answer_;
};

} // namespace

std::string strainOf(const Study& study, const Explanation& explanation)
{
    constexpr double far = 2.0; // standard deviations
    const Eigen::VectorXd sds = inSds(study, explanation.setting.parameters);
    for (std::size_t k = 0; k < explanation.effects.size(); ++k)
    {
        for (std::size_t p = 0; p < study.parameters.size() && explanation.fits[k].isAtEnd; ++p)
        {
            const Parameter& parameter = study.parameters[p];
            if (!parameter.effect && parameter.from != Origin::guess && std::abs(sds(p)) > far)
            {
                return "the amplitude of " + study.effects[explanation.effects[k]].name
                       + " is at the end of its range, while " + parameter.name
                       + " is more than 2 standard deviations from its measured or published value";
            }
        }
    }
    return "";
}

Answer trace(StudySimulator& studySimulator, const Library& library, const std::vector<MeasuredCondition>& data,
    std::mt19937_64& random, bool withVisibility)
{
    return Tracing(studySimulator, library, data, random, withVisibility).run();
}

} // namespace clepsydra::identification
