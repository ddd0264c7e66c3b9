#pragma once

// Before OpenFOAM, whose macro Log means something else.
#include <gmock/gmock.h>

#include "conservation/stream.h"
#include "support/errorOf.h"

#include <gtest/gtest.h>

namespace clepsydra::tests
{

/// An error must name `tolerance`, an entry of `conservationCheck`.
template<class Action>
void expectFound(const Action& action, const std::string& tolerance)
{
    EXPECT_THAT(errorOf(action), testing::HasSubstr(tolerance));
}

/// Water with a particle in each cell and a `smoothingModel` that smooths nothing, but multiplies what is in a cell by a
/// factor, or in all cells.
/// \param rowCount, row  of what is smoothed together the row that is meant, among so many
/// \param cells  "one" or "all"
inline StreamSetup faultyStream(int rowCount, int row, double factor, const std::string& cells)
{
    StreamSetup setup;
    setup.cells = setup.particles;
    setup.momentumModel = "explicitCouple";
    setup.smoothing = "faulty; faultyProps { rowCount " + std::to_string(rowCount) + "; row " + std::to_string(row)
                      + "; factor " + std::to_string(factor) + "; cells " + cells + "; }";
    return setup;
}

} // namespace clepsydra::tests
