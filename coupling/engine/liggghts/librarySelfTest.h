#pragma once

namespace clepsydra
{

/// Checks that the LIGGGHTS library of this process is version 3.8 and has the classes of the headers which this program was
/// compiled with. A library that was built with other flags has other sizes and members, and would corrupt memory without
/// a message.
///
/// Two particles are made in a second instance of LIGGGHTS, on this rank alone and without files, and touch for one step.
/// That takes about 2 ms.
/// \throws DemEngineError naming the library's file, what differs, and what is allowed
void testLiggghtsLibrary();

} // namespace clepsydra
