#pragma once

#include "Ostream.H"
#include "Time.H"
#include "fileName.H"
#include "scalar.H"

namespace clepsydra
{

/// In time steps: their rounding must neither add nor drop a row.
constexpr double roundingOfTime = 1e-6;

/// Whether a row is due now: waiting for the next step would make the gap since the last one too long.
bool isRowDue(const Foam::Time& time, Foam::scalar lastRow, Foam::scalar sampleInterval);

/// Whether the last row is of this very time. Then makeRoomFrom() has dropped it from its table, and it is to be written
/// again.
bool isRowOfNow(const Foam::Time& time, Foam::scalar lastRow);

/// Makes room for an observable's rows from the start time on: postProcessing/<name>/<startTime>/<name>.dat. Rows that
/// a run wrote after the checkpoint from which it is resumed are dropped from the tables of earlier start times, since
/// they will be written again; a table of this or a later start time is renamed to <name>.dat.bak*. So no row is lost
/// or doubled, whenever the run was killed. Done by the master rank only.
/// \param folder  postProcessing/<name>
/// \param table  <name>.dat
/// \return how many rows stay; 0 on other ranks.
Foam::label makeRoomFrom(Foam::scalar startTime, const Foam::fileName& folder, const Foam::word& table);

/// Says so where other than the rows that were written have stayed: somebody has cut, edited or removed a table.
void warnOfLostRows(Foam::label stayed, Foam::label written, const Foam::word& table);

/// FatalIOError where rows have not reached their table.
void requireWritten(const Foam::Ostream& table);

} // namespace clepsydra
