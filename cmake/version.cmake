# clepsydra_version: provides <clepsydra/version.h>, which names the git commit that the program was built from.
#
# The header is looked at in every build and rewritten only where the commit has changed, so a new commit recompiles
# the files that include it and no others.

set(_version_directory "${PROJECT_BINARY_DIR}/generated")
set(_version_command "${CMAKE_COMMAND}"
    -D SOURCE_DIR=${PROJECT_SOURCE_DIR}
    -D TEMPLATE=${CMAKE_CURRENT_LIST_DIR}/version.h.in
    -D HEADER=${_version_directory}/clepsydra/version.h
    -D VERSION=${PROJECT_VERSION}
    -P ${CMAKE_CURRENT_LIST_DIR}/write_version.cmake
)

execute_process(COMMAND ${_version_command} COMMAND_ERROR_IS_FATAL ANY)
add_custom_target(clepsydra_version_header
    COMMAND ${_version_command}
    BYPRODUCTS "${_version_directory}/clepsydra/version.h"
    COMMENT "Looking up the git commit"
    VERBATIM
)

add_library(clepsydra_version INTERFACE)
target_include_directories(clepsydra_version INTERFACE "${_version_directory}")
add_dependencies(clepsydra_version clepsydra_version_header)
