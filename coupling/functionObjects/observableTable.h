#pragma once

#include "Ostream.H"
#include "Time.H"
#include "fileName.H"
#include "scalar.H"

namespace clepsydra
{

/// Tolerance in time steps, so that rounding neither adds nor drops a row.
constexpr double roundingOfTime = 1e-6;

/// Whether a row is due now because the time since the last one would exceed sampleInterval in the next step.
bool isRowDue(const Foam::Time& time, Foam::scalar lastRow, Foam::scalar sampleInterval);

/// Whether the last row has the present time. Then makeRoomFrom() has dropped it from its table, and it must be written
/// again.
bool isRowOfNow(const Foam::Time& time, Foam::scalar lastRow);

/// Prepares the tables of an observable for rows from the start time on: postProcessing/<name>/<startTime>/<name>.dat.
/// Rows that a run wrote after the checkpoint from which it is resumed are removed from the tables of earlier start
/// times, because they will be written again. A table of this or a later start time is renamed to <name>.dat.bak*. No
/// row is therefore lost or duplicated, at whatever time the run was killed. Only the master rank does this.
/// \param startTime  [s]
/// \param folder  postProcessing/<name>
/// \param table  <name>.dat
/// \return number of rows that remain; 0 on other ranks
Foam::label makeRoomFrom(Foam::scalar startTime, const Foam::fileName& folder, const Foam::word& table);

/// Warns where the number of remaining rows differs from that of the rows that were written, because a table was
/// edited, truncated or removed.
void warnOfLostRows(Foam::label stayed, Foam::label written, const Foam::word& table);

/// FatalIOError where rows could not be written to their table.
void requireWritten(const Foam::Ostream& table);

} // namespace clepsydra
