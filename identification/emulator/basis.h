#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace clepsydra::identification
{

/// Number of terms of a quadratic polynomial in the parameters: 1, t_i, t_i t_j.
Eigen::Index parameterTerms(Eigen::Index parameters);

/// Index of the term t_i t_j.
Eigen::Index parameterTerm(Eigen::Index parameters, Eigen::Index i, Eigen::Index j);

/// Values of the terms 1, t_i, t_i t_j.
Eigen::VectorXd parameterTermsAt(const Eigen::VectorXd& parameters);

/// A smooth function as a sum of cosines with random frequencies. For many cosines it approaches a Gaussian process
/// with a squared exponential covariance (Rahimi & Recht, Adv. Neural Inf. Process. Syst. 20 (2007)).
struct Waves
{
    Eigen::MatrixXd frequencies; // waves x (parameters, then amplitudes)
    Eigen::VectorXd phases;

    Waves() = default;
    /// \param moves  for each parameter, whether the function depends on it
    Waves(Eigen::Index count, const std::vector<bool>& moves, Eigen::Index effects);

    Eigen::VectorXd at(const Eigen::VectorXd& t, const Eigen::VectorXd& amplitudes) const;
    /// Linearised in the parameters around t: waves x (1, t_i)
    Eigen::MatrixXd linearAt(const Eigen::VectorXd& t, const Eigen::VectorXd& amplitudes) const;

private:
    Eigen::VectorXd anglesAt(const Eigen::VectorXd& t, const Eigen::VectorXd& amplitudes) const;
};

/// Terms of the regression: the quadratic polynomial in the parameters t; a, a^2 and a t_i for each effect of amplitude
/// a; the product a b for each pair of effects; waves; one term for the runs of the design.
struct Basis
{
    enum Kind
    {
        constant,
        linear,
        square,      // squares, and products of two parameters
        mixed,       // products of a parameter and an effect
        interaction, // products of two effects
        wave
    };
    static constexpr std::size_t kinds = 6;

    Eigen::Index parameters = 0;
    std::vector<std::size_t> effects; // indices in the study
    Waves waves;                      // for deviations from the quadratic polynomial

    Eigen::Index size() const;
    Kind kind(Eigen::Index term) const;
    /// Position of an effect in `effects`; their number if it is not among them.
    std::size_t placeOf(std::size_t effect) const;

    Eigen::Index effectTerm(std::size_t place) const; // term a, followed by a^2 and all a t_i
    Eigen::Index pairTerm(Eigen::Index one, Eigen::Index other) const;
    Eigen::Index firstWave() const;
    /// Term that is 1 in runs with several effects and 0 in all others. It takes up what the quadratic terms miss far
    /// from the base setting, which would otherwise shift the prediction at the base setting.
    Eigen::Index designTerm() const;

    /// Values of all terms. \param t  parameters \param amplitudes  in the sequence of `effects`
    Eigen::VectorXd at(const Eigen::VectorXd& t, const Eigen::VectorXd& amplitudes) const;
};

} // namespace clepsydra::identification
