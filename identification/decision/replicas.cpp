#include "decision/replicas.h"

namespace clepsydra::identification
{

Replicas::Replica::Replica(const Emulator& emulator, const Evidence& evidence, std::mt19937_64& random)
    : truth(emulator.posteriorDraw(random)),
      learnt(emulator.regenerated(truth, random)),
      judge(evidence, learnt)
{}

Replicas::Replicas(const Emulator& emulator, const Layout& layout, const Evidence& evidence, std::mt19937_64& random)
    : emulator_(emulator),
      layout_(layout),
      evidence_(evidence)
{
    constexpr int posteriorDraws = 40;
    for (int i = 0; i < (emulator.scatters() ? posteriorDraws : 0); ++i)
    {
        all_.emplace_back(emulator, evidence, random);
    }
}

Replicas::Trial Replicas::draw(
    const std::vector<Present>& present, const Eigen::VectorXd& parameters, std::mt19937_64& random)
{
    const Eigen::VectorXd& around = evidence_.placeOf(present);
    const Eigen::VectorXd allowed = evidence_.inRanges(parameters);
    if (all_.empty())
    {
        return {identification::draw(layout_, emulator_, present, allowed, around, true, random), evidence_};
    }
    const Replica& one = all_[turn_++ % all_.size()];
    return {identification::draw(layout_, one.truth, present, allowed, around, false, random), one.judge};
}

Replicas::Trial Replicas::drawOther(double size, const Eigen::VectorXd& parameters, std::mt19937_64& random)
{
    Trial trial = draw({}, parameters, random);
    trial.data.mean += evidence_.drawOther(size, random);
    return trial;
}

} // namespace clepsydra::identification
