#pragma once

// Before OpenFOAM, whose macro Log means something else.
#include <gmock/gmock.h>

#include "ledger/stream.h"

#include <gtest/gtest.h>

namespace clepsydra::tests
{

/// Lets a test go on where the program would end.
class ThrowingErrors : public testing::Test
{
protected:
    void SetUp() override
    {
        FatalError.throwExceptions();
        FatalIOError.throwExceptions();
    }

    void TearDown() override
    {
        FatalError.dontThrowExceptions();
        FatalIOError.dontThrowExceptions();
    }
};

/// \param tolerance  the entry of `ledger` that the error must name
template<class Action>
void expectFound(const Action& action, const std::string& tolerance)
{
    try
    {
        action();
        ADD_FAILURE() << "the books balance";
    }
    catch (const Foam::error& error)
    {
        EXPECT_THAT(std::string(error.message()), testing::HasSubstr(tolerance));
    }
}

/// Water with a bead in each cell and a `smoothingModel` that smooths nothing, but multiplies what is in a cell by a
/// factor, or in all cells.
/// \param rowCount, row  of what is smoothed together the row that is meant, among so many
/// \param cells  "one" or "all"
inline StreamSetup faultyStream(int rowCount, int row, double factor, const std::string& cells)
{
    StreamSetup setup;
    setup.cells = setup.beads;
    setup.momentumModel = "explicitCouple";
    setup.smoothing = "faulty; faultyProps { rowCount " + std::to_string(rowCount) + "; row " + std::to_string(row)
                      + "; factor " + std::to_string(factor) + "; cells " + cells + "; }";
    return setup;
}

} // namespace clepsydra::tests
