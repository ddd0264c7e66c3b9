#pragma once

#include <string>
#include <vector>

namespace clepsydra
{

/// The file of the shared library, or of the program, that has this address.
/// \throws DemEngineError where the dynamic linker knows none
std::string fileOfObjectAt(const void* address);

/// Makes a shared library call this program's functions in the place of its own ones of the same name.
///
/// That is the dynamic linker's rule, unless the library was linked so that its calls are bound already (-Bsymbolic, or
/// -Bsymbolic-functions, the default of Ubuntu's packages). The functions of such a library get a jump to this
/// program's as their first instructions, in the memory of this process; its file stays as it is.
/// \param symbols  as the linker knows them
/// \param inLibrary, inReplacement  any address in the library, and in the object that has the replacements
/// \throws DemEngineError naming library and function, why neither way works, and what is allowed
void replaceFunctions(const std::vector<std::string>& symbols, const void* inLibrary, const void* inReplacement);

} // namespace clepsydra
