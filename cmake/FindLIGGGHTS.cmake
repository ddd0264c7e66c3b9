# FindLIGGGHTS: the discrete-element engine as a library.
#
#   LIGGGHTS_FOUND, LIGGGHTS_VERSION (3.8.0)
#   LIGGGHTS::liggghts   its headers are included by their plain names, as they include each other: #include <lammps.h>
#
# Set LIGGGHTS_ROOT for a copy of your own, with include/liggghts/ and lib/.

include(FindPackageHandleStandardArgs)
include(FindPackageMessage)
find_package(MPI REQUIRED COMPONENTS CXX)

find_path(LIGGGHTS_INCLUDE_DIR lammps.h PATH_SUFFIXES liggghts)
find_library(LIGGGHTS_LIBRARY liggghts)
mark_as_advanced(LIGGGHTS_INCLUDE_DIR LIGGGHTS_LIBRARY)

if(LIGGGHTS_LIBRARY)
    # No header states the version; the library's own file name does (libliggghts.so.3.8.0).
    file(REAL_PATH "${LIGGGHTS_LIBRARY}" _file)
    string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+$" LIGGGHTS_VERSION "${_file}")
endif()

find_package_handle_standard_args(LIGGGHTS
    REQUIRED_VARS LIGGGHTS_INCLUDE_DIR LIGGGHTS_LIBRARY
    VERSION_VAR LIGGGHTS_VERSION
    REASON_FAILURE_MESSAGE "Run scripts/setup, or set LIGGGHTS_ROOT."
)
# The line above names the folder of the headers.
if(LIGGGHTS_FOUND)
    find_package_message(LIGGGHTS_library
        "LIGGGHTS ${LIGGGHTS_VERSION}: headers in ${LIGGGHTS_INCLUDE_DIR}, library ${LIGGGHTS_LIBRARY}"
        "[${LIGGGHTS_VERSION}][${LIGGGHTS_INCLUDE_DIR}][${LIGGGHTS_LIBRARY}]")
endif()

if(LIGGGHTS_FOUND AND NOT TARGET LIGGGHTS::liggghts)
    add_library(LIGGGHTS::liggghts UNKNOWN IMPORTED)
    set_target_properties(LIGGGHTS::liggghts PROPERTIES
        IMPORTED_LOCATION "${LIGGGHTS_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${LIGGGHTS_INCLUDE_DIR}"
    )
    target_link_libraries(LIGGGHTS::liggghts INTERFACE MPI::MPI_CXX)
endif()
