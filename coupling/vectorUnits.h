/// \file
/// Functions with this attribute are compiled several times, for processors with and without wide vector units. The
/// program selects the best version for its machine at start. It is meant for the few loops over all particles or cells
/// that dominate the run time.
#pragma once

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__)
#define CLEPSYDRA_FOR_VECTOR_UNITS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define CLEPSYDRA_FOR_VECTOR_UNITS
#endif
