#include "procedure/doubts.h"

#include "procedure/assemble.h"

namespace clepsydra::identification
{

namespace
{

/// Whether the simulations scatter as the measurements do and as those of the library do not.
bool explainsSpread(const std::vector<Simulation>& simulations, const Scatter& measured, const TraceInputs& inputs,
    std::mt19937_64& random)
{
    Scatter simulated;
    for (const auto condition : inputs.training)
    {
        simulated.add(featureRows(simulations, condition, inputs.study.featureCount()));
    }
    const int draws = inputs.study.settings.draws;
    return compareSpread(simulated, inputs.library.scatter, draws, random).pValue <= otherSpread
           && compareSpread(measured, simulated, draws, random).pValue > otherSpread;
}

} // namespace

std::vector<std::string> doubtsAbout(const Explanation& best, const Answer& answer, double nullMisfit,
    const Scatter& measured, const TraceInputs& inputs, std::mt19937_64& random)
{
    std::vector<std::string> doubts;
    if (answer.otherLogOdds > best.logOdds - inputs.study.settings.setWidth)
    {
        doubts.emplace_back("it is as likely by the evidence");
    }
    if (answer.significance.noticed > otherShape * otherShape * (nullMisfit - best.misfit))
    {
        doubts.emplace_back("the residual is too small for its shape to be tested");
    }
    if (answer.spread.pValue <= otherSpread && !explainsSpread(best.simulations, measured, inputs, random))
    {
        doubts.emplace_back("repeats of the measurement scatter in a way of their own");
    }
    return doubts;
}

} // namespace clepsydra::identification
