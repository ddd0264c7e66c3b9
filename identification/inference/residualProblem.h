#pragma once

#include "noise/noise.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <vector>

namespace clepsydra::identification
{

/// Measured minus simulated features of all training conditions at one setting of the simulator (the anchor), and what
/// a small change of a parameter or an effect would add to the simulation there.
///
/// Parameters are counted in standard deviations of their prior, which is one more measurement: of the parameter itself.
struct ResidualProblem
{
    /// The rows of one condition.
    struct Block
    {
        std::size_t condition = 0; // of the study
        Eigen::Index firstRow = 0;
        std::vector<Eigen::Index> features; // those that this condition has
        Eigen::MatrixXd dataShare;          // covariance of the data's mean over that of one measurement, by element
        double simulationShare = 0.0;       // 1/number of seeds
        Eigen::VectorXd knownVariance;      // of declared standard errors
    };

    std::vector<Block> blocks;
    Eigen::VectorXd residual;         // n
    Eigen::MatrixXd parameterColumns; // n x q, per prior sd
    Eigen::MatrixXd effectColumns;    // n x E, per unit amplitude
    Eigen::MatrixXd columnShare;      // blocks x E: variance of a column over that of one run
    Eigen::VectorXd parameterOffset;  // q: anchor minus prior mean, in prior sd

    /// Covariance of a block's residual. \param steps  of all effects from the anchor, or none: adds the uncertainty of
    /// the effects' columns times these steps
    Eigen::MatrixXd covariance(std::size_t block, const Noise& noise, const Eigen::VectorXd& steps = {}) const;

    /// The same with these effects alone, in this order.
    ResidualProblem withEffects(const std::vector<Eigen::Index>& effects) const;
};

/// Of the matrix that was factorised.
double logDeterminant(const Eigen::LLT<Eigen::MatrixXd>& root);

/// The problem in coordinates in which the noise is white; the parameters' priors are its last rows.
struct WhiteProblem
{
    Eigen::VectorXd residual;
    Eigen::MatrixXd parameters;
    Eigen::MatrixXd effects;
    double logDeterminant = 0.0; // of the covariance that was made white
};

/// \param steps  as for ResidualProblem::covariance
WhiteProblem whitened(const ResidualProblem& problem, const Noise& noise, const Eigen::VectorXd& steps = {});

/// Generalised least squares for the parameters alone, and for the parameters with one effect each.
class Fits
{
public:
    explicit Fits(WhiteProblem problem);

    /// Sum of squares that the parameters leave.
    double nullMisfit() const
    {
        return nullMisfit_;
    }

    /// Shift of the parameters from the anchor, in prior sd. \param amplitude, effect  with this effect taken off
    Eigen::VectorXd parameterShift(Eigen::Index effect = -1, double amplitude = 0.0) const;

    Eigen::MatrixXd parameterCovariance() const
    {
        return inverse_;
    }

    struct Effect
    {
        double amplitude; // within bounds
        double free;      // without bounds
        double sd;        // infinite where the parameters can do all that the effect does
        double misfit;    // at `amplitude`
        double freeMisfit;
    };

    Effect effect(Eigen::Index index, double lower, double upper) const;

    /// What the parameters cannot imitate of residual and effects.
    const Eigen::VectorXd& residualLeft() const
    {
        return residualLeft_;
    }
    const Eigen::MatrixXd& effectsLeft() const
    {
        return effectsLeft_;
    }

private:
    WhiteProblem problem_;
    Eigen::MatrixXd inverse_;
    Eigen::VectorXd residualLeft_;
    Eigen::MatrixXd effectsLeft_;
    double nullMisfit_ = 0.0;
};

} // namespace clepsydra::identification
