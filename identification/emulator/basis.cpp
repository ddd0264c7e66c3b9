#include "emulator/basis.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace clepsydra::identification
{

Eigen::Index parameterTerms(Eigen::Index parameters)
{
    return 1 + parameters + parameters * (parameters + 1) / 2;
}

Eigen::Index parameterTerm(Eigen::Index parameters, Eigen::Index i, Eigen::Index j)
{
    const auto [low, high] = std::minmax(i, j);
    return 1 + parameters + low * parameters - low * (low - 1) / 2 + (high - low);
}

Eigen::VectorXd parameterTermsAt(const Eigen::VectorXd& parameters)
{
    const Eigen::Index q = parameters.size();
    Eigen::VectorXd terms(parameterTerms(q));
    terms(0) = 1.0;
    terms.segment(1, q) = parameters;
    for (Eigen::Index i = 0; i < q; ++i)
    {
        for (Eigen::Index j = i; j < q; ++j)
        {
            terms(parameterTerm(q, i, j)) = parameters(i) * parameters(j);
        }
    }
    return terms;
}

Waves::Waves(Eigen::Index count, const std::vector<bool>& moves, Eigen::Index effects)
    : frequencies(count, static_cast<Eigen::Index>(moves.size()) + effects),
      phases(count)
{
    const Eigen::Index parameters = moves.size();
    // Correlation lengths of the function, in prior standard deviations of parameters and in units of amplitude
    constexpr double ofParameters = 3.0;
    constexpr double ofAmplitudes = 1.0;
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> anywhere(0.0, 2.0 * std::acos(-1.0));
    for (Eigen::Index k = 0; k < count; ++k)
    {
        for (Eigen::Index i = 0; i < parameters + effects; ++i)
        {
            const bool isIn = i >= parameters || moves[i];
            frequencies(k, i) = isIn ? normal(random) / (i < parameters ? ofParameters : ofAmplitudes) : 0.0;
        }
        phases(k) = anywhere(random);
    }
}

Eigen::VectorXd Waves::anglesAt(const Eigen::VectorXd& t, const Eigen::VectorXd& amplitudes) const
{
    return frequencies.leftCols(t.size()) * t + frequencies.rightCols(amplitudes.size()) * amplitudes + phases;
}

Eigen::VectorXd Waves::at(const Eigen::VectorXd& t, const Eigen::VectorXd& amplitudes) const
{
    return std::sqrt(2.0 / static_cast<double>(phases.size())) * anglesAt(t, amplitudes).array().cos();
}

Eigen::MatrixXd Waves::linearAt(const Eigen::VectorXd& t, const Eigen::VectorXd& amplitudes) const
{
    const Eigen::VectorXd angles = anglesAt(t, amplitudes);
    const double scale = std::sqrt(2.0 / static_cast<double>(phases.size()));
    Eigen::MatrixXd both(phases.size(), 1 + t.size());
    both.rightCols(t.size()) = (-scale * angles.array().sin()).matrix().asDiagonal() * frequencies.leftCols(t.size());
    both.col(0) = (scale * angles.array().cos()).matrix() - both.rightCols(t.size()) * t;
    return both;
}

Eigen::Index Basis::firstWave() const
{
    const Eigen::Index count = effects.size();
    return effectTerm(effects.size()) + count * (count - 1) / 2;
}

Eigen::Index Basis::size() const
{
    return firstWave() + waves.phases.size() + 1;
}

Basis::Kind Basis::kind(Eigen::Index term) const
{
    const Eigen::Index ofEffect = (term - effectTerm(0)) % (2 + parameters);
    return term == 0 || term == designTerm()    ? constant
           : term <= parameters                 ? linear
           : term < effectTerm(0)               ? square
           : term >= firstWave()                ? wave
           : term >= effectTerm(effects.size()) ? interaction
           : ofEffect == 0                      ? linear
           : ofEffect == 1                      ? square
                                                : mixed;
}

std::size_t Basis::placeOf(std::size_t effect) const
{
    return static_cast<std::size_t>(std::find(effects.begin(), effects.end(), effect) - effects.begin());
}

Eigen::Index Basis::effectTerm(std::size_t place) const
{
    return parameterTerms(parameters) + static_cast<Eigen::Index>(place) * (2 + parameters);
}

Eigen::Index Basis::pairTerm(Eigen::Index one, Eigen::Index other) const
{
    const Eigen::Index count = effects.size();
    const auto [low, high] = std::minmax(one, other);
    return effectTerm(effects.size()) + low * count - low * (low + 1) / 2 + (high - low - 1);
}

Eigen::Index Basis::designTerm() const
{
    return size() - 1;
}

Eigen::VectorXd Basis::at(const Eigen::VectorXd& t, const Eigen::VectorXd& amplitudes) const
{
    Eigen::VectorXd terms(size());
    terms.head(parameterTerms(parameters)) = parameterTermsAt(t);
    for (std::size_t k = 0; k < effects.size(); ++k)
    {
        const double a = amplitudes(k);
        const Eigen::Index first = effectTerm(k);
        terms(first) = a;
        terms(first + 1) = a * a;
        terms.segment(first + 2, parameters) = a * t;
        for (std::size_t other = 0; other < k; ++other)
        {
            terms(pairTerm(other, k)) = a * amplitudes(other);
        }
    }
    if (waves.phases.size() > 0)
    {
        terms.segment(firstWave(), waves.phases.size()) = waves.at(t, amplitudes);
    }
    terms(designTerm()) = 0.0;
    return terms;
}

} // namespace clepsydra::identification
