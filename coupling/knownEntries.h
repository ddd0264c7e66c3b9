#pragma once

#include "dictionary.H"
#include "wordList.H"

namespace clepsydra
{

/// Checks that a dictionary has known entries only. An unknown entry is a misspelling, or its effect would be missing
/// without a message.
///
/// Any other entry is a FatalIOError that names the file, the entry, the nearest known entry and all that are allowed.
/// So is a value in place of a dictionary and a dictionary in place of a value. Two kinds of entries are accepted
/// because they only help to write the file: those that the file refers to as `$name` and, at the top level of a file,
/// those that come from a file that it `#include`s.
///
/// In a parallel run the master rank checks, since it has read the file.
///
/// \param values  names of the entries that are values
/// \param dictionaries  names of the entries that are dictionaries
void requireKnownEntries(
    const Foam::dictionary& dict, const Foam::wordList& values, const Foam::wordList& dictionaries = {});

/// The given entries, and those that every function object of OpenFOAM with a mesh and a file reads.
Foam::wordList functionObjectEntries(const Foam::wordList& own);

/// " (did you mean 'divided'?)" where a known word is near, otherwise an empty string.
std::string didYouMean(const std::string& word, const Foam::wordList& known);

} // namespace clepsydra
