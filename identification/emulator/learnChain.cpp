#include "emulator/emulator.h"
#include "emulator/settings.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

/// Applies the effect of the measuring chain to the curves of runs without effects, at each amplitude of the grid.
void Emulator::learnChain(
    std::size_t e, std::size_t c, const StudySimulator& studySimulator, const std::vector<const Simulation*>& runs)
{
    const Effect& effect = study_->effects[e];
    const auto& kept = conditions_[c]->features;
    const Eigen::Index q = study_->parameters.size();
    std::vector<const Curve*> curves;
    std::vector<Setting> settings;
    std::vector<Eigen::VectorXd> features;
    for (const auto* run : runs)
    {
        const auto [setting, all] = beforeChain(*study_, studySimulator, *run);
        if (setting.amplitudes.isZero() && all(kept).array().isFinite().all())
        {
            curves.push_back(&run->plain);
            settings.push_back(setting);
            features.emplace_back(all(kept));
        }
    }
    const Eigen::Index rows = curves.size();
    Eigen::MatrixXd before(rows, kept.size());
    Eigen::MatrixXd terms = Eigen::MatrixXd::Ones(rows, 1 + q);
    for (Eigen::Index row = 0; row < rows; ++row)
    {
        before.row(row) = features[row].transpose();
        terms.row(row).tail(q) = inSds(*study_, settings[row].parameters).transpose();
    }
    const auto groups = repeatsOf(settings);
    const auto squares = [&](const Eigen::MatrixXd& values, const std::vector<Eigen::Index>& some) {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(values.cols());
        for (const auto& group : groups)
        {
            std::vector<Eigen::Index> own;
            std::set_intersection(group.begin(), group.end(), some.begin(), some.end(), std::back_inserter(own));
            if (own.size() > 1)
            {
                const Eigen::MatrixXd chosen = values(own, Eigen::all);
                sum += (chosen.rowwise() - Eigen::RowVectorXd(chosen.colwise().mean()))
                           .colwise()
                           .squaredNorm()
                           .transpose();
            }
        }
        return sum;
    };

    ConditionEmulator::Chain chain;
    chain.amplitudes = Grid(effect);
    const Eigen::VectorXd& amplitudes = chain.amplitudes.amplitudes();
    chain.changes = Eigen::MatrixXd::Zero(before.cols(), amplitudes.size());
    chain.logScatter = chain.changes;
    chain.slopes.assign(q, chain.changes);
    for (Eigen::Index node = 0; node < amplitudes.size(); ++node)
    {
        Setting setting = studySimulator.plainSetting();
        setting.amplitudes(e) = amplitudes(node);
        Eigen::MatrixXd after(rows, before.cols());
        std::vector<Eigen::Index> good;
        for (Eigen::Index row = 0; row < rows; ++row)
        {
            const Curve& curve = *curves[row];
            after.row(row) =
                studySimulator.featuresOf(studySimulator.throughChain(curve, c, setting))(kept).transpose();
            if (after.row(row).array().isFinite().all())
            {
                good.push_back(row);
            }
        }
        if (good.empty())
        {
            known_[e] = false;
            remarks_.push_back("effect " + effect.name
                               + " is not judged: with it no curve has the features of condition "
                               + study_->conditions[c].name);
            return;
        }
        const Eigen::MatrixXd solution = Eigen::MatrixXd(terms(good, Eigen::all))
                                             .completeOrthogonalDecomposition()
                                             .solve(Eigen::MatrixXd((after - before)(good, Eigen::all)));
        chain.changes.col(node) = solution.row(0).transpose();
        for (Eigen::Index i = 0; i < q; ++i)
        {
            chain.slopes[i].col(node) = solution.row(1 + i).transpose();
        }
        const Eigen::ArrayXd ratio = squares(after, good).array() / squares(before, good).array();
        chain.logScatter.col(node) = (ratio.isFinite() && ratio > 0.0).select(0.5 * ratio.log(), 0.0);
    }
    conditions_[c]->chain[e] = std::move(chain);
}

} // namespace clepsydra::identification
