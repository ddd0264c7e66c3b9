#pragma once

#include "decision/visibility.h"

#include <ostream>

namespace clepsydra::identification
{

/// Writes the result of a plan as text: the effects that can be detected, named and distinguished.
void writePlan(const Study& study, const Emulator& emulator, const Layout& layout, const Measured& planned,
    const Evidence& evidence, const Calibration& calibration, const Visibility& visibility, std::ostream& out);

} // namespace clepsydra::identification
