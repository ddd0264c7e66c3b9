# At the time of cpack: the Debian packages that hold the libraries which our programs are linked with join the package's Depends.
# CPACK_DEBIAN_PACKAGE_SHLIBDEPS would say the same, but looks first, one after the other, at all the 2,400 files whether they are programs.

if(NOT CPACK_GENERATOR STREQUAL "DEB")
    return()
endif()

set(_folder "${CPACK_PACKAGE_DIRECTORY}/_CPack_Packages/libraries")
file(WRITE "${_folder}/debian/control" "")    # dpkg-shlibdeps asks for one
set(_programs bin/pimpleDemFoam bin/traceResidual bin/closures lib/libcoupling.so lib/openfoam/libscotchDecomp.so)
list(TRANSFORM _programs PREPEND "${CPACK_CLEPSYDRA_BUILT}/")
execute_process(
    COMMAND dpkg-shlibdeps --ignore-missing-info -O "-l${CPACK_CLEPSYDRA_BUILT}/lib" ${_programs}
    WORKING_DIRECTORY "${_folder}"
    OUTPUT_VARIABLE _found ERROR_VARIABLE _said RESULT_VARIABLE _failed OUTPUT_STRIP_TRAILING_WHITESPACE)
if(_failed OR NOT _found MATCHES "^shlibs:Depends=(.+)$")
    message(FATAL_ERROR "dpkg-shlibdeps: ${_said}")
endif()
string(PREPEND CPACK_DEBIAN_PACKAGE_DEPENDS "${CMAKE_MATCH_1}, ")
