#include "emulator/basis.h"

#include <algorithm>

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

Eigen::Index Basis::size() const
{
    const auto count = static_cast<Eigen::Index>(effects.size());
    return parameterTerms(parameters) + count * (2 + parameters) + count * (count - 1) / 2 + 1;
}

Basis::Kind Basis::kind(Eigen::Index term) const
{
    if (term <= parameters)
    {
        return term == 0 ? constant : linear;
    }
    if (term == designTerm())
    {
        return constant;
    }
    const Eigen::Index first = parameterTerms(parameters);
    if (term < first)
    {
        return square;
    }
    const Eigen::Index perEffect = 2 + parameters;
    if (term >= first + static_cast<Eigen::Index>(effects.size()) * perEffect)
    {
        return interaction;
    }
    const Eigen::Index place = (term - first) % perEffect;
    return place == 0 ? linear : place == 1 ? square : mixed;
}

std::size_t Basis::placeOf(std::size_t effect) const
{
    return static_cast<std::size_t>(std::find(effects.begin(), effects.end(), effect) - effects.begin());
}

Eigen::Index Basis::effectTerm(std::size_t place) const
{
    return parameterTerms(parameters) + static_cast<Eigen::Index>(place) * (2 + parameters);
}

Eigen::Index Basis::pairTerm(std::size_t one, std::size_t other) const
{
    const auto count = static_cast<Eigen::Index>(effects.size());
    const auto low = static_cast<Eigen::Index>(std::min(one, other));
    const auto high = static_cast<Eigen::Index>(std::max(one, other));
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
        const double a = amplitudes(static_cast<Eigen::Index>(k));
        const Eigen::Index first = effectTerm(k);
        terms(first) = a;
        terms(first + 1) = a * a;
        terms.segment(first + 2, parameters) = a * t;
        for (std::size_t other = 0; other < k; ++other)
        {
            terms(pairTerm(other, k)) = a * amplitudes(static_cast<Eigen::Index>(other));
        }
    }
    terms(designTerm()) = 0.0;
    return terms;
}

} // namespace clepsydra::identification
