#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace clepsydra::identification
{

/// How many terms a polynomial of second order in the parameters has: 1, t_i, t_i t_j.
Eigen::Index parameterTerms(Eigen::Index parameters);

/// Where t_i t_j stands among them.
Eigen::Index parameterTerm(Eigen::Index parameters, Eigen::Index i, Eigen::Index j);

/// Their values.
Eigen::VectorXd parameterTermsAt(const Eigen::VectorXd& parameters);

/// A smooth function of any shape, as a sum of waves with random frequencies: in the limit of many a Gaussian process with a
/// squared exponential covariance (Rahimi & Recht, Adv. Neural Inf. Process. Syst. 20 (2007)).
struct Waves
{
    Eigen::MatrixXd frequencies; // waves x (parameters, then amplitudes)
    Eigen::VectorXd phases;

    Waves() = default;
    /// \param moves  by parameter: whether the function depends on it
    Waves(Eigen::Index count, const std::vector<bool>& moves, Eigen::Index effects);

    Eigen::Index size() const
    {
        return phases.size();
    }
    Eigen::VectorXd at(const Eigen::VectorXd& t, const Eigen::VectorXd& amplitudes) const;
    /// waves x (1, t_i): near some parameters, as 1, t_i
    Eigen::MatrixXd linearAt(const Eigen::VectorXd& t, const Eigen::VectorXd& amplitudes) const;

private:
    Eigen::VectorXd anglesAt(const Eigen::VectorXd& t, const Eigen::VectorXd& amplitudes) const;
};

/// Terms of the regression: those of the parameters t; for each effect a, a^2, a t_i; for each pair of effects a b; waves.
struct Basis
{
    enum Kind
    {
        constant,
        linear,
        square,      // and products of parameters
        mixed,       // parameter times effect
        interaction, // effect times effect
        wave
    };
    static constexpr std::size_t kinds = 6;

    Eigen::Index parameters = 0;
    std::vector<std::size_t> effects; // of the study
    Waves waves;                      // of what is no polynomial of second order

    Eigen::Index size() const;
    Kind kind(Eigen::Index term) const;
    /// Its place among `effects`, or their number.
    std::size_t placeOf(std::size_t effect) const;

    Eigen::Index effectTerm(std::size_t place) const; // a; then a^2, then a t_i
    Eigen::Index pairTerm(std::size_t one, std::size_t other) const;
    Eigen::Index firstWave() const;
    /// 1 in runs of the design, where many effects are on, else 0: what terms of second order miss far from the base must
    /// not move the base.
    Eigen::Index designTerm() const;

    /// \param amplitudes  by place
    Eigen::VectorXd at(const Eigen::VectorXd& t, const Eigen::VectorXd& amplitudes) const;
};

} // namespace clepsydra::identification
