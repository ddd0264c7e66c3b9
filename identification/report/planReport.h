#pragma once

#include "design/effectLibrary.h"
#include "identifiability/identifiability.h"

#include <ostream>

namespace clepsydra::identification
{

/// What a plan tells, as text.
void writePlan(const Study& study, const EffectLibrary& library, const Noise& noise, const Identifiability& table,
    std::ostream& out);

} // namespace clepsydra::identification
