#pragma once

#include "decision/visibility.h"

#include <ostream>

namespace clepsydra::identification
{

/// What a plan tells, as text.
void writePlan(const Study& study, const Emulator& emulator, const Layout& layout, const Measured& planned,
    const Evidence& evidence, const Calibration& calibration, const Visibility& visibility, std::ostream& out);

} // namespace clepsydra::identification
