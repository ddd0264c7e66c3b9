#pragma once

#include "fileName.H"

namespace clepsydra
{

/// OpenFOAM's parser never returns, or dies, on some texts that a slip of the hand or a damaged disk can make: control
/// characters, an #ifeq without its #endif, brackets thousands deep, a list of billions, a file that includes itself, a key
/// that is a regular expression such as "(a*)*b". This looks at the text before it is parsed.
///
/// FatalIOError with file and line where the file is not plain text, a bracket, a comment, a string or an #ifeq is not
/// closed, something is nested deeper or published longer than anybody means, or a key's pattern may take for ever to be
/// compared. Files that this one includes are not looked at.
void checkDictionaryText(const Foam::fileName& file);

} // namespace clepsydra
