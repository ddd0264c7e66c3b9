#include "output/observableTable.h"

#include "OSspecific.H"
#include "Time.H"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// Half the last digit of a time's name would do; times of rows are that far apart at least.
constexpr scalar sameTime = 1e-9;

/// Cuts the table where they begin. Rows before are not touched, so a full disk cannot harm them.
void dropRowsFrom(scalar time, const fileName& table)
{
    std::ifstream lines(table);
    std::uintmax_t kept = 0;
    std::string line;
    // A line without its end is the one that the run was killed in.
    while (std::getline(lines, line) && !lines.eof())
    {
        std::istringstream columns(line);
        scalar rowTime = 0;
        if (columns >> rowTime && rowTime >= time - sameTime)
        {
            break;
        }
        kept += line.size() + 1;
    }
    if (lines.bad())
    {
        FatalErrorInFunction << "Cannot read " << table << exit(FatalError);
    }
    lines.close();
    std::filesystem::resize_file(table.c_str(), kept);
}

} // namespace

void makeRoomFrom(scalar startTime, const fileName& folder, const word& table)
{
    if (!Pstream::master())
    {
        return;
    }
    for (const instant& start : Time::findTimes(folder))
    {
        const fileName file = folder / start.name() / table;
        if (!isFile(file))
        {
            continue;
        }
        if (start.value() < startTime - sameTime)
        {
            dropRowsFrom(startTime, file);
        }
        else
        {
            mvBak(file, "bak");
        }
    }
}

void requireWritten(const Ostream& table)
{
    // FatalIOError: OpenFOAM takes a FatalError from a function object for a warning and goes on without it.
    if (!table.good())
    {
        FatalIOErrorInFunction(table) << "Cannot write a row: is the disk full?" << exit(FatalIOError);
    }
}

} // namespace clepsydra
