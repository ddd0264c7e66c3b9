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

/// Terms of the regression: those of the parameters t; for each effect a, a^2, a t_i; for each pair of effects a b.
struct Basis
{
    enum Kind
    {
        constant,
        linear,
        square,     // and products of parameters
        mixed,      // parameter times effect
        interaction // effect times effect
    };
    static constexpr std::size_t kinds = 5;

    Eigen::Index parameters = 0;
    std::vector<std::size_t> effects; // of the study

    Eigen::Index size() const;
    Kind kind(Eigen::Index term) const;
    /// Its place among `effects`, or their number.
    std::size_t placeOf(std::size_t effect) const;

    Eigen::Index effectTerm(std::size_t place) const; // a; then a^2, then a t_i
    Eigen::Index pairTerm(std::size_t one, std::size_t other) const;
    /// 1 in runs of the design, where many effects are on, else 0: what terms of second order miss far from the base must
    /// not move the base.
    Eigen::Index designTerm() const;

    /// \param amplitudes  by place
    Eigen::VectorXd at(const Eigen::VectorXd& t, const Eigen::VectorXd& amplitudes) const;
};

} // namespace clepsydra::identification
