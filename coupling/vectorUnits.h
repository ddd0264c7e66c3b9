/// \file
/// A function so marked is compiled several times, for processors with and without wide vector units; the program takes
/// the best one that the machine has when it starts. For the few loops over all particles or cells that cost the time.
#pragma once

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__)
#define CLEPSYDRA_FOR_VECTOR_UNITS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define CLEPSYDRA_FOR_VECTOR_UNITS
#endif
