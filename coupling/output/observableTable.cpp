#include "output/observableTable.h"

#include "OSspecific.H"
#include "Time.H"

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

void dropRowsFrom(scalar time, const fileName& table)
{
    std::ostringstream kept;
    {
        std::ifstream lines(table);
        std::string line;
        // A line without its end is the one that the run was killed in.
        while (std::getline(lines, line) && !lines.eof())
        {
            std::istringstream columns(line);
            scalar rowTime = 0;
            const bool isRow = static_cast<bool>(columns >> rowTime);
            if (!isRow || rowTime < time - sameTime)
            {
                kept << line << '\n';
            }
        }
    }
    const fileName unfinished = table + ".unfinished";
    std::ofstream(unfinished) << kept.str();
    mv(unfinished, table);
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

} // namespace clepsydra
