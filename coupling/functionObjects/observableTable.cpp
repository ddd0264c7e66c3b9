#include "functionObjects/observableTable.h"

#include "files/timeFolders.h"
#include "files/wholeFile.h"

#include "IFstream.H"
#include "OSspecific.H"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// Tolerance in comparisons of times; the times of rows differ by more.
constexpr scalar sameTime = 1e-9;

/// Truncates the table before its first row of the given time or later. Earlier rows are not rewritten, so a full disk
/// cannot damage them.
/// \return number of remaining rows
label dropRowsFrom(scalar time, const fileName& table)
{
    std::ifstream lines(table);
    std::uintmax_t bytesKept = 0;
    label rows = 0;
    // A FatalIOError, because OpenFOAM turns a FatalError of a function object into a warning and continues without it.
    const auto requireReadable = [&] {
        if (!lines.is_open() || lines.bad())
        {
            FatalIOErrorInFunction(IFstream(table)) << "Cannot read the table" << exit(FatalIOError);
        }
    };
    requireReadable();
    std::string line;
    // A line without its end was being written when the run was killed.
    while (std::getline(lines, line) && !lines.eof())
    {
        std::istringstream columns(line);
        scalar rowTime = 0;
        if (columns >> rowTime)
        {
            if (rowTime >= time - sameTime)
            {
                break;
            }
            ++rows;
        }
        bytesKept += line.size() + 1;
    }
    requireReadable();
    lines.close();
    std::error_code problem;
    std::filesystem::resize_file(table.c_str(), bytesKept, problem);
    if (problem)
    {
        FatalIOErrorInFunction(IFstream(table))
            << "Cannot remove rows from the table: " << problem.message() << exit(FatalIOError);
    }
    return rows;
}

} // namespace

bool isRowDue(const Time& time, scalar lastRow, scalar sampleInterval)
{
    const scalar nextTime = time.value() + time.deltaTValue();
    return nextTime > lastRow + sampleInterval + roundingOfTime * time.deltaTValue();
}

bool isRowOfNow(const Time& time, scalar lastRow)
{
    return lastRow > time.value() - roundingOfTime * time.deltaTValue();
}

label makeRoomFrom(scalar startTime, const fileName& folder, const word& table)
{
    label stayed = 0;
    if (!Pstream::master())
    {
        return stayed;
    }
    std::vector<TimeFolder> starts;
    try
    {
        starts = timeFolders(std::string(folder));
    }
    catch (const FileError& error)
    {
        FatalIOErrorInFunction(IFstream(folder)) << error.what() << exit(FatalIOError);
    }
    for (const TimeFolder& start : starts)
    {
        const fileName file = folder / start.name / table;
        if (!isFile(file))
        {
            continue;
        }
        if (start.time < startTime - sameTime)
        {
            stayed += dropRowsFrom(startTime, file);
        }
        else
        {
            mvBak(file, "bak");
        }
    }
    return stayed;
}

void warnOfLostRows(label stayed, label written, const word& table)
{
    if (Pstream::master() && stayed != written)
    {
        Info << "WARNING: " << table << " has " << stayed << " rows from before this checkpoint, but " << written
             << " were written: was it edited, truncated or removed since then?" << nl << endl;
    }
}

void requireWritten(const Ostream& table)
{
    if (!table.good())
    {
        FatalIOErrorInFunction(table) << "Cannot write a row: is the disk full?" << exit(FatalIOError);
    }
}

} // namespace clepsydra
