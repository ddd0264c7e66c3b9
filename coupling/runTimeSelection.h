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

// OpenFOAM's macros for run-time selection only work inside its namespace.
using namespace Foam;

/// FatalIOError that names the file, the entry and the known names where `name` is none of the known names.
inline void requireKnownName(const dictionary& dict, const word& entry, const word& name, const wordList& known)
{
    if (!known.found(name))
    {
        FatalIOErrorInFunction(dict) << "Entry '" << entry << "' names the unknown model '" << name << "'"
                                     << didYouMean(name, known).c_str() << "; allowed: " << flatOutput(known)
                                     << exit(FatalIOError);
    }
}

/// Name of the model that an entry of a dictionary selects. FatalIOError where it is none of the known names.
inline word selectedModel(const dictionary& dict, const word& entry, const wordList& known)
{
    word name = dict.get<word>(entry);
    requireKnownName(dict, entry, name, known);
    return name;
}

/// Whether a quantity in SI units has a magnitude that the program can compute with. Products of a few larger or
/// smaller values would leave the range of floating-point numbers. False for NaN and infinity.
inline bool isOfUsableSize(double value)
{
    constexpr double largest = 1e60;
    return value == 0 || (std::abs(value) <= largest && std::abs(value) >= 1 / largest);
}

/// FatalIOError that names file and entry where a number is not positive (not negative, with `zeroAllowed`) or
/// isOfUsableSize() is false.
inline void requirePositive(const dictionary& dict, const word& entry, double value, bool zeroAllowed = false)
{
    if (!(value > 0 || (zeroAllowed && value == 0)) || !isOfUsableSize(value))
    {
        FatalIOErrorInFunction(dict) << "Entry '" << entry << "' is " << value << "; allowed: a number "
                                     << (zeroAllowed ? ">= 0" : "> 0") << (value > 1 ? ", at most 1e60" : "")
                                     << exit(FatalIOError);
    }
}

/// Value of an entry that has passed requirePositive().
inline double positiveEntry(const dictionary& dict, const word& entry, bool zeroAllowed = false)
{
    const double value = dict.get<double>(entry);
    requirePositive(dict, entry, value, zeroAllowed);
    return value;
}

} // namespace clepsydra
