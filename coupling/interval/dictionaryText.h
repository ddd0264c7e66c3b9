#pragma once

#include "fileName.H"

namespace clepsydra
{

/// OpenFOAM's parser never returns, or dies, on some texts that a slip of the hand or a damaged disk can make: control
/// characters, an #ifeq without its #endif, brackets thousands deep, a list of billions, a file that includes itself.
/// This looks at the text before it is parsed.
///
/// FatalIOError with file and line where the file is not plain text, a bracket, a comment, a string or an #ifeq is not
/// closed, or something is nested deeper or announced longer than anybody means. Files that this one includes are not
/// looked at.
void checkDictionaryText(const Foam::fileName& file);

} // namespace clepsydra
