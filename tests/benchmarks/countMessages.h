#pragma once

/// Bytes that this rank has sent, or handed to collective calls, so far: for a test that links countMessages.
extern "C" double bytesSentSoFar();
