#pragma once

#include <mpi.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace clepsydra
{

/// Numbers of this rank, or their totals over all ranks.
struct RankNumbers
{
    /// Their total is the sum over the ranks.
    std::vector<double> sums;
    /// Their total is the largest of the ranks; not a number where one of them is none.
    std::vector<double> maxima;

    /// Appends the components of a vector to the sums.
    template<class Vector>
    void addVector(const Vector& vector)
    {
        for (int component = 0; component < 3; ++component)
        {
            sums.push_back(vector[component]);
        }
    }

    /// The vector whose components are the sums from `first` on.
    template<class Vector>
    Vector vectorAt(std::size_t first) const
    {
        return Vector(sums[first], sums[first + 1], sums[first + 2]);
    }
};

/// Sums and maxima over the ranks, packed into one reduction. Where each number is reduced by itself, every rank waits
/// for the slowest one as often as there are numbers, and on many ranks this wait is what a coupling step costs. Each
/// part of the coupling therefore adds its numbers and what is to be done with the totals, and reduce() sends them all:
///
///     RankTotals totals;
///     totals.add({{volumeHere}, {speedHere}}, [&](const RankNumbers& all) { check(all.sums[0], all.maxima[0]); });
///     totals.reduce();
///
/// On one rank the totals are the numbers themselves, to the last bit. Integers up to 2^53 are exact. On several ranks
/// all ranks receive the same totals, so that all of them find the same errors.
///
/// An object holds what has been added since it was made or last reduced, and a copy holds the same. All ranks must add
/// the same numbers of sums and maxima in the same order.
class RankTotals
{
public:
    using Use = std::function<void(const RankNumbers& totals)>;
    using Condition = std::function<bool(const RankNumbers& totals)>;

    explicit RankTotals(MPI_Comm communicator = MPI_COMM_WORLD)
        : communicator_(communicator)
    {}

    /// Adds numbers of this rank. Local.
    /// \param use  called in reduce() with the totals of these numbers, in the order in which they were added
    void add(const RankNumbers& ofRank, Use use);

    /// Adds numbers on which it depends whether all other totals may be used, because they were computed on an
    /// assumption about the other ranks. Local.
    /// \param holds  called in reduce() with the totals, before any use; the answer must be the same on all ranks
    void require(const RankNumbers& ofRank, Condition holds);

    /// Reduces all numbers at once and passes on the totals. The object is empty afterwards, also where a use throws.
    /// Collective; local where nothing was added.
    /// \return false where a condition does not hold: no total has been used then, and what led to the numbers must be
    /// repeated on all ranks
    bool reduce();

    /// The totals of some numbers that are needed at once, in a reduction of their own. Collective.
    static RankNumbers of(const RankNumbers& ofRank, MPI_Comm communicator = MPI_COMM_WORLD);

    /// Number of reductions of this process so far. Local.
    static long reductions();

private:
    struct Entry
    {
        std::size_t sums;
        std::size_t maxima;
        /// One of the two is empty.
        Use use;
        Condition holds;
    };

    void append(const RankNumbers& ofRank, Entry entry);

    MPI_Comm communicator_;
    RankNumbers numbers_;
    std::vector<Entry> entries_;
};

} // namespace clepsydra
