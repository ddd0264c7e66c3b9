#pragma once

#include "procedure/answer.h"
#include "procedure/nullFit.h"

namespace clepsydra::identification
{

/// Every effect of the library by itself: scored from its column, the best ones switched on in the simulator and scored
/// again from there.
class SingleEffects
{
public:
    /// Scores all from the library's columns, those of the measuring chain on the null fit's curves; runs nothing.
    /// The arguments must outlive this.
    SingleEffects(const TraceInputs& inputs, const NullFit& null, const Noise& noise, const Significance& test);

    /// The few best effects, switched on with fresh seeds, and one Gauss-Newton step from there. Once more where that
    /// step was a long one, or where several effects are so close that seeds decide between them.
    void confirmBest();

    std::vector<EffectFinding> findings() const;

    /// One for each effect, most likely first.
    std::vector<Explanation> explanations() const;

    const std::vector<std::string>& remarks() const
    {
        return remarks_;
    }

private:
    struct Trial
    {
        EffectFinding finding;
        Setting setting; // where its last fit ended
        //--- Of the last simulation, if there is one ---
        double simulatedAt = 0.0; // amplitude
        ResidualProblem problem;
        std::vector<Simulation> simulations;
    };

    Trial scoredByColumn(std::size_t effect) const;
    Score scoreChain(std::size_t effect) const;
    std::vector<std::size_t> byOdds() const;
    void followBest();
    bool isNear(const Trial& trial) const;
    void confirm(std::size_t effect, int round);

    const TraceInputs& inputs_;
    const NullFit& null_;
    const Noise& noise_;
    std::vector<Trial> trials_; // by effect of the study
    std::vector<std::string> remarks_;
};

} // namespace clepsydra::identification
