#pragma once

namespace clepsydra
{

/// Opens /dev/null in place of standard input, output and error where they are closed, as a daemon's may be. Otherwise
/// the next files that the program opens would get their descriptors, and messages would be written into these files.
/// Call before anything is opened.
void openClosedStandardStreams();

} // namespace clepsydra
