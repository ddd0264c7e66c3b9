#include "emulator/conditionEmulator.h"

#include "lists.h"

#include <Eigen/Cholesky>

#include <cmath>

namespace clepsydra::identification
{

Eigen::VectorXd ConditionEmulator::terms(const Eigen::VectorXd& parameters, const std::vector<Present>& present) const
{
    return basis.at(parameters.cwiseProduct(reach(present)), amplitudes(present));
}

Eigen::VectorXd ConditionEmulator::amplitudes(const std::vector<Present>& present) const
{
    Eigen::VectorXd all = Eigen::VectorXd::Zero(basis.effects.size());
    for (const auto& [effect, amplitude] : present)
    {
        const std::size_t place = basis.placeOf(effect);
        if (place < basis.effects.size())
        {
            all(place) = amplitude;
        }
    }
    return all;
}

Eigen::VectorXd ConditionEmulator::at(const Eigen::VectorXd& parameters, const std::vector<Present>& present) const
{
    return mean(present, parameters) * parameterTermsAt(parameters);
}

Eigen::VectorXd ConditionEmulator::reach(const std::vector<Present>& present) const
{
    const Eigen::VectorXd here = amplitudes(present);
    return Eigen::VectorXd::NullaryExpr(basis.parameters, [&](Eigen::Index p) {
        const std::size_t place = basis.placeOf(owners[p].value_or(0));
        return !owners[p] ? 1.0 : place < basis.effects.size() ? here(place) : 0.0;
    });
}

Eigen::MatrixXd ConditionEmulator::mean(const std::vector<Present>& present, const Eigen::VectorXd& around) const
{
    const Eigen::Index q = basis.parameters;
    Eigen::MatrixXd whitened = coefficients.topRows(parameterTerms(q)).transpose();
    for (std::size_t k = 0; k < present.size(); ++k)
    {
        const std::size_t place = basis.placeOf(present[k].effect);
        if (place == basis.effects.size())
        {
            continue;
        }
        const double a = present[k].amplitude;
        const Eigen::Index first = basis.effectTerm(place);
        whitened.col(0) += (a * coefficients.row(first) + a * a * coefficients.row(first + 1)).transpose();
        whitened.middleCols(1, q) += a * coefficients.middleRows(first + 2, q).transpose();
        for (std::size_t other = 0; other < k; ++other)
        {
            const std::size_t second = basis.placeOf(present[other].effect);
            if (second < basis.effects.size())
            {
                whitened.col(0) +=
                    a * present[other].amplitude * coefficients.row(basis.pairTerm(place, second)).transpose();
            }
        }
    }
    if (basis.waves.phases.size() > 0)
    {
        whitened.leftCols(1 + q) += coefficients.middleRows(basis.firstWave(), basis.waves.phases.size()).transpose()
                                    * basis.waves.linearAt(around.cwiseProduct(reach(present)), amplitudes(present));
    }
    Eigen::MatrixXd polynomial = root * whitened * parameterTermsAt(reach(present)).asDiagonal();
    polynomial.col(0) += centre;
    for (const auto& [effect, a] : present)
    {
        if (const auto found = chain.find(effect); found != chain.end())
        {
            const Chain& one = found->second;
            const Eigen::VectorXd weights = one.grid.weightsAt(a).transpose();
            polynomial.col(0) += one.changes * weights;
            for (Eigen::Index i = 0; i < q; ++i)
            {
                polynomial.col(1 + i) += one.slopes[i] * weights;
            }
        }
    }
    return polynomial;
}

Eigen::MatrixXd ConditionEmulator::uncertainty(
    const Eigen::VectorXd& parameters, const std::vector<Present>& present) const
{
    // Most terms are zero and are left out of the products.
    const Eigen::VectorXd all = terms(parameters, present);
    const auto used = numbersWhere(all.size(), [&](Eigen::Index i) { return all(i) != 0.0; });
    const Eigen::VectorXd x = all(used);
    Eigen::VectorXd variances(covariances.size());
    for (Eigen::Index f = 0; f < variances.size(); ++f)
    {
        const Eigen::MatrixXd& covariance = covariances[f];
        variances(f) = x.dot(covariance(used, used) * x);
    }
    return root * variances.cwiseMax(0.0).asDiagonal() * root.transpose();
}

Eigen::MatrixXd ConditionEmulator::noiseOf(const std::vector<Present>& present) const
{
    Eigen::VectorXd factor = Eigen::VectorXd::Zero(noise.rows());
    for (const auto& [effect, amplitude] : present)
    {
        if (const auto found = logScatter.find(effect); found != logScatter.end())
        {
            factor += std::abs(amplitude) * found->second;
        }
        if (const auto found = chain.find(effect); found != chain.end())
        {
            factor += found->second.logScatter * found->second.grid.weightsAt(amplitude).transpose();
        }
    }
    factor = factor.array().exp();
    return factor.asDiagonal() * noise * factor.asDiagonal();
}

std::vector<Present> ConditionEmulator::scatteringIn(const Setting& setting) const
{
    std::vector<Present> scattering;
    for (const auto& [e, logs] : logScatter)
    {
        if (setting.amplitudes(e) != 0.0)
        {
            scattering.push_back({e, setting.amplitudes(e)});
        }
    }
    return scattering;
}

} // namespace clepsydra::identification
