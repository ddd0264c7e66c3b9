#pragma once

#include "dictionary.H"
#include "wordList.H"

namespace clepsydra
{

/// What a reader of a dictionary says first: which entries it reads. An entry that is unknown is a misspelt one, or
/// one whose effect the user waits for in vain.
///
/// FatalIOError naming file, entry, the nearest known word and what is allowed for every other entry, and for a value
/// where a dictionary belongs or the reverse. Left alone is what helps to write the file: an entry that the file refers
/// to as `$name`, and at the top level of a file what stands in a file that it `#include`s.
///
/// In a parallel run the master, which has read the file, looks.
///
/// \param values  names of the entries that are no dictionaries
void requireKnownEntries(
    const Foam::dictionary& dict, const Foam::wordList& values, const Foam::wordList& dictionaries = {});

/// The names, and those that every function object of OpenFOAM with a mesh and a file reads.
Foam::wordList functionObjectEntries(const Foam::wordList& own);

/// " (did you mean 'divided'?)" where a known word is near, else nothing.
std::string didYouMean(const std::string& word, const Foam::wordList& known);

} // namespace clepsydra
