#pragma once

#include <dlfcn.h>

namespace clepsydra
{

/// The function of the system that one of the same name in this program hides.
template<class Function>
Function* hiddenFunction(const char* name)
{
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

} // namespace clepsydra
