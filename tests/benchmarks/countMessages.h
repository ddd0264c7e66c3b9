#pragma once

/// Bytes that this rank has sent, or handed to collective calls, so far: for a test that links countMessages.
extern "C" double bytesSentSoFar();

/// Collective calls of MPI by this rank so far, for such a test. OpenFOAM's own reductions over a few ranks are no
/// collective calls, but messages.
extern "C" double collectiveCallsSoFar();
