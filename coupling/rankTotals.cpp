#include "rankTotals.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clepsydra
{

namespace
{

long reductionCount = 0;

/// OpenFOAM traps comparisons of what is not a number, and a maximum that left it out would hide it.
double larger(double a, double b)
{
    return std::isnan(a) || std::isgreater(a, b) ? a : b;
}

/// Combines messages of two ranks. A message is one element of its type, so that MPI does not divide it: the number of
/// sums, the sums, and the maxima.
void combine(void* others, void* own, int* count, MPI_Datatype* type)
{
    int bytes = 0;
    MPI_Type_size(*type, &bytes);
    const std::size_t size = static_cast<std::size_t>(bytes) / sizeof(double);
    const auto* from = static_cast<const double*>(others);
    auto* to = static_cast<double*>(own);
    for (int message = 0; message < *count; ++message, from += size, to += size)
    {
        const std::size_t sumsEnd = 1 + static_cast<std::size_t>(to[0]);
        for (std::size_t i = 1; i < sumsEnd; ++i)
        {
            to[i] += from[i];
        }
        for (std::size_t i = sumsEnd; i < size; ++i)
        {
            to[i] = larger(from[i], to[i]);
        }
    }
}

MPI_Op combination()
{
    static const MPI_Op made = [] {
        constexpr int commutes = 1;
        MPI_Op operation;
        MPI_Op_create(&combine, commutes, &operation);
        return operation;
    }();
    return made;
}

int rankCount(MPI_Comm communicator)
{
    int isInitialised = 0;
    MPI_Initialized(&isInitialised);
    int count = 1;
    if (isInitialised != 0)
    {
        MPI_Comm_size(communicator, &count);
    }
    return count;
}

} // namespace

void RankTotals::add(const RankNumbers& ofRank, Use use)
{
    append(ofRank, {ofRank.sums.size(), ofRank.maxima.size(), std::move(use), {}});
}

void RankTotals::require(const RankNumbers& ofRank, Condition holds)
{
    append(ofRank, {ofRank.sums.size(), ofRank.maxima.size(), {}, std::move(holds)});
}

void RankTotals::append(const RankNumbers& ofRank, Entry entry)
{
    numbers_.sums.insert(numbers_.sums.end(), ofRank.sums.begin(), ofRank.sums.end());
    numbers_.maxima.insert(numbers_.maxima.end(), ofRank.maxima.begin(), ofRank.maxima.end());
    entries_.push_back(std::move(entry));
}

bool RankTotals::reduce()
{
    if (entries_.empty())
    {
        return true;
    }
    const RankNumbers totals = of(std::exchange(numbers_, {}), communicator_);
    const std::vector<Entry> entries = std::exchange(entries_, {});
    // All conditions are asked, because each notes what it finds for the repetition.
    bool hold = true;
    for (const bool asksConditions : {true, false})
    {
        auto sum = totals.sums.begin();
        auto maximum = totals.maxima.begin();
        for (const Entry& entry : entries)
        {
            const auto sumsEnd = sum + static_cast<std::ptrdiff_t>(entry.sums);
            const auto maximaEnd = maximum + static_cast<std::ptrdiff_t>(entry.maxima);
            if (asksConditions && entry.holds)
            {
                hold = entry.holds({{sum, sumsEnd}, {maximum, maximaEnd}}) && hold;
            }
            if (!asksConditions && entry.use && hold)
            {
                entry.use({{sum, sumsEnd}, {maximum, maximaEnd}});
            }
            sum = sumsEnd;
            maximum = maximaEnd;
        }
    }
    return hold;
}

RankNumbers RankTotals::of(const RankNumbers& ofRank, MPI_Comm communicator)
{
    ++reductionCount;
    if (rankCount(communicator) == 1)
    {
        return ofRank;
    }
    std::vector<double> message = {static_cast<double>(ofRank.sums.size())};
    message.insert(message.end(), ofRank.sums.begin(), ofRank.sums.end());
    message.insert(message.end(), ofRank.maxima.begin(), ofRank.maxima.end());
    MPI_Datatype type;
    MPI_Type_contiguous(static_cast<int>(message.size()), MPI_DOUBLE, &type);
    MPI_Type_commit(&type);
    MPI_Allreduce(MPI_IN_PLACE, message.data(), 1, type, combination(), communicator);
    MPI_Type_free(&type);
    const auto sumsEnd = message.begin() + 1 + static_cast<std::ptrdiff_t>(ofRank.sums.size());
    return {{message.begin() + 1, sumsEnd}, {sumsEnd, message.end()}};
}

long RankTotals::reductions()
{
    return reductionCount;
}

} // namespace clepsydra
