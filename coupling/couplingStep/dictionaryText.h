#pragma once

#include "fileName.H"

namespace clepsydra
{

/// Checks the text of a dictionary before OpenFOAM parses it. OpenFOAM's parser never returns, or crashes, on some
/// texts that a typing error or a damaged disk can produce: control characters, an #ifeq without its #endif, brackets
/// nested thousands deep, a list of billions of entries, a file that includes itself, or a key that is a regular
/// expression such as "(a*)*b".
///
/// FatalIOError with file and line where the file is not plain text, where a bracket, a comment, a string or an #ifeq
/// is not closed, where brackets are nested too deep, where a list's stated length is too large, or where matching a
/// key's pattern may take unbounded time. Files that this one includes are not checked.
void checkDictionaryText(const Foam::fileName& file);

} // namespace clepsydra
