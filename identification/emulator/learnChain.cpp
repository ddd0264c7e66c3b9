#include "emulator/emulator.h"
#include "emulator/settings.h"

#include "lists.h"

#include <Eigen/QR>

namespace clepsydra::identification
{

/// Applies the effect of the measuring chain to the curves of runs without effects, at each amplitude of the grid.
/// \param curves  of the condition's rows, before the chain
void Emulator::learnChain(
    std::size_t e, std::size_t c, const StudySimulator& studySimulator, const std::vector<const Curve*>& curves)
{
    const Effect& effect = study_->effects[e];
    const Rows& rows = rows_[c];
    const auto& kept = conditions_[c]->features;
    const Eigen::Index q = study_->parameters.size();
    const auto plain = numbersWhere<Eigen::Index>(
        curves.size(), [&](Eigen::Index row) { return rows.settings[row].amplitudes.isZero(); });
    ConditionEmulator::Chain chain;
    chain.grid = Grid(effect);
    const Eigen::VectorXd& amplitudes = chain.grid.amplitudes;
    chain.changes = Eigen::MatrixXd::Zero(rows.values.cols(), amplitudes.size());
    chain.logScatter = chain.changes;
    chain.slopes.assign(q, chain.changes);
    for (Eigen::Index node = 0; node < amplitudes.size(); ++node)
    {
        Setting setting = studySimulator.plainSetting();
        setting.amplitudes(e) = amplitudes(node);
        std::vector<Eigen::Index> good; // rows that still have all features
        Eigen::MatrixXd after(plain.size(), kept.size());
        for (const auto row : plain)
        {
            const Eigen::VectorXd all =
                studySimulator.featuresOf(studySimulator.throughChain(*curves[row], c, setting));
            if (all(kept).array().isFinite().all())
            {
                after.row(good.size()) = all(kept).transpose();
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
        after.conservativeResize(good.size(), Eigen::NoChange);
        const Eigen::MatrixXd before = rows.values(good, Eigen::all);
        const auto settings = mapped(good, [&](Eigen::Index row) { return rows.settings[row]; });
        Eigen::MatrixXd terms = Eigen::MatrixXd::Ones(after.rows(), 1 + q);
        for (Eigen::Index row = 0; row < terms.rows(); ++row)
        {
            terms.row(row).tail(q) = inSds(*study_, settings[row].parameters).transpose();
        }
        const Eigen::MatrixXd solution = terms.completeOrthogonalDecomposition().solve(Eigen::MatrixXd(after - before));
        chain.changes.col(node) = solution.row(0).transpose();
        for (Eigen::Index i = 0; i < q; ++i)
        {
            chain.slopes[i].col(node) = solution.row(1 + i).transpose();
        }
        const auto groups = repeatsOf(settings);
        const auto squares = [&](const Eigen::MatrixXd& values) {
            Eigen::VectorXd sum = Eigen::VectorXd::Zero(values.cols());
            for (const auto& group : groups)
            {
                const Eigen::MatrixXd own = values(group, Eigen::all);
                sum += (own.rowwise() - Eigen::RowVectorXd(own.colwise().mean())).colwise().squaredNorm().transpose();
            }
            return sum;
        };
        const Eigen::ArrayXd ratio = squares(after).array() / squares(before).array();
        chain.logScatter.col(node) = (ratio.isFinite() && ratio > 0.0).select(0.5 * ratio.log(), 0.0);
    }
    conditions_[c]->chain[e] = std::move(chain);
}

} // namespace clepsydra::identification
