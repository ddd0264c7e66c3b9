#pragma once

#include <string>
#include <vector>

namespace clepsydra
{

/// File of the shared library, or of the program, that contains an address.
/// \throws DemEngineError where the dynamic linker knows none
std::string fileOfObjectAt(const void* address);

/// Makes a shared library call this program's functions in place of its own functions of the same name.
///
/// The dynamic linker does this by itself, unless the library's calls were already bound when it was linked
/// (-Bsymbolic, or -Bsymbolic-functions, the default of Ubuntu's packages). In such a library the functions are
/// overwritten by a jump to this program's functions, in the memory of this process; the library's file is not changed.
/// \param symbols  names as the linker knows them
/// \param inLibrary, inReplacement  any address in the library, and in the object that contains the replacements
/// \throws DemEngineError that names the library and the function, why neither way works, and what is allowed
void replaceFunctions(const std::vector<std::string>& symbols, const void* inLibrary, const void* inReplacement);

} // namespace clepsydra
