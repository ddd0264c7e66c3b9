#include "runner/studySimulator.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace clepsydra::identification
{

namespace
{

// The hash counts from here: another number would change the seeds of all committed runs.
constexpr long smallest = 10007;
// The particle templates of cases/tutorials/hopperQuick have primes below this.
constexpr long smallestOfCases = 11003;
constexpr long range = 99000000; // primes below 1e8: nine digits fit into any integer

std::uint64_t hashed(std::uint64_t state, const std::string& text)
{
    // FNV-1a: fast, evenly spread, and equal on all machines.
    for (const char c : text)
    {
        state = (state ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
    }
    return (state ^ 0xffULL) * 0x100000001b3ULL;
}

/// Finaliser of SplitMix64, which makes every bit of the result depend on every bit of the argument.
std::uint64_t mixed(std::uint64_t x)
{
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31U);
}

/// Effects that were renamed keep the seeds of their former names, from which the runs of committed results were made.
std::string withFormerNames(std::string purpose)
{
    constexpr std::array<std::pair<const char*, const char*>, 3> renamed = {{{"particleDiameter", "beadDiameter"},
        {"particleDensity", "beadDensity"}, {"momentumOfLeavingParticles", "momentumOfLeavingBeads"}}};
    for (const auto& [name, former] : renamed)
    {
        const std::string current = name;
        for (auto at = purpose.find(current); at != std::string::npos; at = purpose.find(current, at))
        {
            purpose.replace(at, current.size(), former);
        }
    }
    return purpose;
}

bool isPrime(long number)
{
    long divisor = 2;
    while (divisor * divisor <= number && number % divisor != 0)
    {
        ++divisor;
    }
    return divisor * divisor > number;
}

} // namespace

long seedOf(unsigned studySeed, const std::string& purpose, const std::string& condition, int number)
{
    std::uint64_t state = hashed(0xcbf29ce484222325ULL, std::to_string(studySeed));
    state = hashed(hashed(hashed(state, withFormerNames(purpose)), condition), std::to_string(number));
    long seed =
        std::max(smallestOfCases, smallest + static_cast<long>(mixed(state) % static_cast<std::uint64_t>(range)));
    while (!isPrime(seed))
    {
        ++seed;
    }
    return seed;
}

} // namespace clepsydra::identification
