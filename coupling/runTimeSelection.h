#pragma once

#include "FlatOutput.H"
#include "autoPtr.H"
#include "dictionary.H"
#include "knownEntries.h"
#include "modelLines.h"
#include "runTimeSelectionTables.H"
#include "wordList.H"

#include <cmath>

namespace clepsydra
{

// OpenFOAM's macros for run-time selection are written for code inside its namespace.
using namespace Foam;

/// FatalIOError with the file, the entry and the known names for the name of a model that is none of them.
inline void requireKnownName(const dictionary& dict, const word& entry, const word& name, const wordList& known)
{
    if (!known.found(name))
    {
        FatalIOErrorInFunction(dict) << "Unknown " << entry << " '" << name << "'" << didYouMean(name, known).c_str()
                                     << "; allowed: " << flatOutput(known) << exit(FatalIOError);
    }
}

/// The model that an entry of a dictionary names, one of those known.
inline word selectedModel(const dictionary& dict, const word& entry, const wordList& known)
{
    word name = dict.get<word>(entry);
    requireKnownName(dict, entry, name, known);
    return name;
}

/// Whether a quantity in SI units may have this size: with one that is larger, or smaller and not zero, products of a
/// few leave the range of numbers. Not so NaN and infinity.
inline bool isOfUsableSize(double value)
{
    constexpr double largest = 1e60;
    return value == 0 || (std::abs(value) <= largest && std::abs(value) >= 1 / largest);
}

/// FatalIOError with file and entry for a number that is not positive (or negative, with `zeroAllowed`), or of no
/// usable size.
inline void requirePositive(const dictionary& dict, const word& entry, double value, bool zeroAllowed = false)
{
    if (!(value > 0 || (zeroAllowed && value == 0)) || !isOfUsableSize(value))
    {
        FatalIOErrorInFunction(dict) << "Entry '" << entry << "' is " << value << "; allowed: a number "
                                     << (zeroAllowed ? ">= 0" : "> 0") << (value > 1 ? ", at most 1e60" : "")
                                     << exit(FatalIOError);
    }
}

/// A number that requirePositive() lets pass.
inline double positiveEntry(const dictionary& dict, const word& entry, bool zeroAllowed = false)
{
    const double value = dict.get<double>(entry);
    requirePositive(dict, entry, value, zeroAllowed);
    return value;
}

} // namespace clepsydra
