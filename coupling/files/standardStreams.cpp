#include "files/standardStreams.h"

#include <fcntl.h>
#include <unistd.h>

#include <initializer_list>

namespace clepsydra
{

void openClosedStandardStreams()
{
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    {
        if (fcntl(stream, F_GETFD) < 0)
        {
            // The lowest free descriptor, which is the closed one.
            static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_RDONLY : O_WRONLY));
        }
    }
}

} // namespace clepsydra
