#pragma once

#include <string>

namespace clepsydra
{

/// The first write to a file of this process that the system has refused, as "Cannot write <file>: <cause>"; empty
/// where there was none.
///
/// OpenFOAM's function objects and VTK write tables and pictures by C++ streams and do not look whether that succeeded.
/// The functions write() and writev(), through which these streams write, are therefore replaced by ones that take
/// note. C streams do not use them, nor do writes by pwrite(). Pipes, sockets and terminals are not considered, and
/// neither are standard output and standard error.
std::string firstWriteFailure();

} // namespace clepsydra
