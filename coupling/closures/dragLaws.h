/// \file
/// All drag laws by name. A case's forceModels and the program `closures` can select every law in DragLaws.
#pragma once

#include "closures/beetstraDrag.h"
#include "closures/brownLawlerDrag.h"
#include "closures/diFeliceDrag.h"
#include "closures/gidaspowDrag.h"
#include "closures/kochHillDrag.h"
#include "closures/morrisonDrag.h"
#include "closures/rongDrag.h"
#include "closures/schillerNaumannDrag.h"
#include "closures/stokesDrag.h"
#include "closures/tangDrag.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace clepsydra::closures
{

// A drag law is added to the programs by one line here.
// clang-format off
using DragLaws = std::tuple<
    BeetstraDrag,
    BrownLawlerDrag,
    DiFeliceDrag,
    ErgunDrag,
    GidaspowDrag,
    KochHillDrag,
    MorrisonDrag,
    RongDrag,
    SchillerNaumannDrag,
    StokesDrag,
    TangDrag,
    WenYuDrag
>;
// clang-format on

/// Calls function(law) for each drag law.
template<class Function>
void forEachDragLaw(Function function)
{
    std::apply([&](const auto&... law) { (function(law), ...); }, DragLaws{});
}

inline std::vector<std::string> dragLawNames()
{
    std::vector<std::string> names;
    forEachDragLaw([&](const auto& law) { names.emplace_back(law.name); });
    return names;
}

/// A law whose name is known only at run time. The indirect call makes it too slow for the time loop.
using AnyDragLaw = std::function<double(const ParticleInFluid&)>;

/// \throws std::invalid_argument where there is no law of that name
inline AnyDragLaw dragLaw(const std::string& name)
{
    AnyDragLaw found;
    forEachDragLaw([&](const auto& law) {
        if (name == law.name)
        {
            found = law;
        }
    });
    if (!found)
    {
        throw std::invalid_argument("no drag law '" + name + "'");
    }
    return found;
}

} // namespace clepsydra::closures
