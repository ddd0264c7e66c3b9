# How everything is compiled, and where it goes.

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)   # for clang-tidy

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, RelWithDebInfo or Debug" FORCE)
endif()

# No -ffast-math: it lets the compiler assume that NaN does not occur, and our checks look for NaN.
# No -march=native: loops that gain by wide vectors are compiled for several processors (vectorUnits.h), the rest gains little
# (docs/benchmarks/costs.md, "Contacts"). Release is CMake's -O3 -DNDEBUG.

# Messages name our sources from the repository's root on (OpenFOAM's errors quote __FILE__), wherever it was built. Debug
# information keeps whole paths, by which a debugger finds the sources. The second one is for ccache, which names sources
# relative to the build folder.
file(RELATIVE_PATH _sources_from_build "${PROJECT_BINARY_DIR}" "${PROJECT_SOURCE_DIR}")
add_compile_options("-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=" "-fmacro-prefix-map=${_sources_from_build}=")

# MPI's C interface only: Open MPI and MPICH would add C++ classes, which nobody uses, to every file.
add_compile_definitions(OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")

find_program(CCACHE_PROGRAM ccache)
mark_as_advanced(CCACHE_PROGRAM)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    # Paths relative to the repository, and options with its path left out of what is compared, so that another clone of it
    # finds what this one has compiled. The two words of sloppiness are what precompiled headers need (ccache's manual,
    # "Precompiled headers").
    set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}
        "CCACHE_IGNOREOPTIONS=-fmacro-prefix-map=*"
        CCACHE_SLOPPINESS=pch_defines,time_macros "${CCACHE_PROGRAM}")
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)
endif()
