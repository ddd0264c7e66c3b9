#include "emulator/plackettBurman.h"

#include <algorithm>
#include <string>

namespace clepsydra::identification
{

namespace
{

constexpr Eigen::Index largest = 32;

/// Each row but the last is the generator, rotated by one more column than the row above.
Eigen::MatrixXd cyclic(const std::string& generator)
{
    const Eigen::Index factors = generator.size();
    Eigen::MatrixXd design = Eigen::MatrixXd::Constant(factors + 1, factors, -1.0);
    for (Eigen::Index row = 0; row < factors; ++row)
    {
        for (Eigen::Index column = 0; column < factors; ++column)
        {
            const std::size_t place = (column - row + factors) % factors;
            design(row, column) = generator[place] == '+' ? 1.0 : -1.0;
        }
    }
    return design;
}

/// Hadamard matrix whose order is a power of two, without its column of +1.
Eigen::MatrixXd sylvester(Eigen::Index runs)
{
    Eigen::MatrixXd hadamard = Eigen::MatrixXd::Ones(1, 1);
    while (hadamard.rows() < runs)
    {
        const Eigen::Index n = hadamard.rows();
        Eigen::MatrixXd next(2 * n, 2 * n);
        next << hadamard, hadamard, hadamard, -hadamard;
        hadamard = next;
    }
    // Reversed, so that the last row has all factors at -1, as in the cyclic designs.
    return -hadamard.rightCols(runs - 1).colwise().reverse();
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

Eigen::Index runsFor(Eigen::Index factors)
{
    for (const Eigen::Index runs : {4, 8, 12, 16, 20, 24, 32})
    {
        if (factors < runs)
        {
            return runs;
        }
    }
    return largest;
}

} // namespace

Eigen::Index plackettBurmanRuns(Eigen::Index factors)
{
    Eigen::Index runs = 0;
    for (; factors > 0; factors -= largest - 1)
    {
        runs += runsFor(std::min(factors, largest - 1));
    }
    return runs;
}

Eigen::MatrixXd plackettBurman(Eigen::Index factors)
{
    Eigen::MatrixXd design = Eigen::MatrixXd::Constant(plackettBurmanRuns(factors), factors, -1.0);
    Eigen::Index row = 0;
    for (Eigen::Index first = 0; first < factors; first += largest - 1)
    {
        const Eigen::Index count = std::min(factors - first, largest - 1);
        const Eigen::MatrixXd part = designOf(runsFor(count));
        design.block(row, first, part.rows(), count) = part.leftCols(count);
        row += part.rows();
    }
    return design;
}

} // namespace clepsydra::identification
