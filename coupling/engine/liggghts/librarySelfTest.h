#pragma once

namespace clepsydra
{

/// Checks that the LIGGGHTS library of this process is version 3.8 and that its classes are those of the headers with
/// which this program was compiled. A library that was built with other flags has other sizes and members, and would
/// corrupt memory without a message.
///
/// The test places two particles in contact for one step, in a second instance of LIGGGHTS on this rank alone and
/// without files. It takes about 2 ms.
/// \throws DemEngineError that names the library's file, the difference and what is allowed
void testLiggghtsLibrary();

} // namespace clepsydra
