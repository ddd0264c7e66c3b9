#include "emulator/library.h"

#include <bitset>
#include <string>

namespace clepsydra::identification
{

namespace
{

/// Each row but the last is the generator, rotated by one more column than the row above.
Eigen::MatrixXd cyclic(const std::string& generator)
{
    const Eigen::Index factors = generator.size();
    return Eigen::MatrixXd::NullaryExpr(factors + 1, factors, [&](Eigen::Index row, Eigen::Index column) {
        return row < factors && generator[(column - row + factors) % factors] == '+' ? 1.0 : -1.0;
    });
}

/// Hadamard matrix whose order is a power of two, without its column of +1. It is reversed, so that the last row has all
/// factors at -1, as in the cyclic designs.
Eigen::MatrixXd sylvester(Eigen::Index runs)
{
    return Eigen::MatrixXd::NullaryExpr(runs, runs - 1, [&](Eigen::Index row, Eigen::Index column) {
        const std::bitset<8> common((runs - 1 - row) & (column + 1));
        return common.count() % 2 == 0 ? -1.0 : 1.0;
    });
}

Eigen::MatrixXd designOf(Eigen::Index runs)
{
    switch (runs)
    {
        case 12:
            return cyclic("++-+++---+-");
        case 20:
            return cyclic("++--++++-+-+----++-");
        case 24:
            return cyclic("+++++-+-++--++--+-+----");
        default:
            return sylvester(runs);
    }
}

} // namespace

Eigen::MatrixXd plackettBurman(Eigen::Index factors)
{
    for (const Eigen::Index runs : {4, 8, 12, 16, 20, 24, 32})
    {
        if (factors < runs)
        {
            return designOf(runs).leftCols(factors);
        }
    }
    constexpr Eigen::Index most = 31;
    const Eigen::MatrixXd first = plackettBurman(most);
    const Eigen::MatrixXd others = plackettBurman(factors - most);
    Eigen::MatrixXd both = Eigen::MatrixXd::Constant(first.rows() + others.rows(), factors, -1.0);
    both.topLeftCorner(first.rows(), most) = first;
    both.bottomRightCorner(others.rows(), others.cols()) = others;
    return both;
}

} // namespace clepsydra::identification
