#pragma once

#include <string>
#include <vector>

namespace clepsydra
{

/// Makes sure that a shared library, where it calls functions which it has itself and this program has, too, gets the
/// program's. That is the dynamic linker's rule, unless the library was linked so that its calls are bound already
/// (-Bsymbolic, -Bsymbolic-functions: some distributions' default) or the functions are in an object that is looked at
/// after the library.
/// \param symbols  as the linker knows them
/// \param inLibrary, inReplacement  any address in the library, and in the object that has the replacements
/// \throws DemEngineError naming library and function, with what is allowed
void requireReplaced(const std::vector<std::string>& symbols, const void* inLibrary, const void* inReplacement);

} // namespace clepsydra
