#pragma once

#include "FlatOutput.H"
#include "autoPtr.H"
#include "dictionary.H"
#include "runTimeSelectionTables.H"
#include "wordList.H"

namespace clepsydra
{

// OpenFOAM's macros for run-time selection are written for code inside its namespace.
using namespace Foam;

/// The model that an entry of a dictionary names; FatalIOError with the file, the entry and the known names where it
/// names none of them.
inline word selectedModel(const dictionary& dict, const word& entry, const wordList& known)
{
    word name = dict.get<word>(entry);
    if (!known.found(name))
    {
        FatalIOErrorInFunction(dict) << "Unknown " << entry << " '" << name << "'; allowed: " << flatOutput(known)
                                     << exit(FatalIOError);
    }
    return name;
}

/// A number that must be positive (or not negative, with `zeroAllowed`); FatalIOError with file and entry otherwise.
inline double positiveEntry(const dictionary& dict, const word& entry, bool zeroAllowed = false)
{
    const double value = dict.get<double>(entry);
    if (!(value > 0 || (zeroAllowed && value == 0)))
    {
        FatalIOErrorInFunction(dict) << "Entry '" << entry << "' is " << value << "; allowed: a number "
                                     << (zeroAllowed ? ">= 0" : "> 0") << exit(FatalIOError);
    }
    return value;
}

} // namespace clepsydra
