#pragma once

#include "error.H"

#include <string>

namespace clepsydra::tests
{

/// The text of the OpenFOAM error that an action raises; empty where it raises none.
/// support/main.cpp makes exceptions of errors.
template<class Action>
std::string errorOf(const Action& action)
{
    try
    {
        action();
    }
    catch (const Foam::error& error)
    {
        return error.message();
    }
    return {};
}

} // namespace clepsydra::tests
