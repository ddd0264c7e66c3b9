# `cmake --install` and `cpack -G DEB`: the programs with all that a copied case needs, so that it runs without this folder.
#
#   bin/                      pimpleDemFoam, traceResidual, closures: each sets up its environment and starts the one below
#   lib/clepsydra/            the programs themselves and their libraries
#   include/clepsydra/        headers of the coupling, for find_package(Clepsydra)
#   share/man, share/bash-completion
#   share/clepsydra/          what $CLEPSYDRA is then: scripts, cases, meshes, pages; build/ leads to lib/clepsydra
#
# The tree may be moved as a whole.

set(_programs lib/clepsydra)
set(_shared share/clepsydra)

set_target_properties(pimpleDemFoam traceResidual closuresProgram PROPERTIES INSTALL_RPATH "$ORIGIN/../lib")
install(TARGETS pimpleDemFoam traceResidual closuresProgram RUNTIME DESTINATION ${_programs}/bin)
set_target_properties(clepsydraTurbulence PROPERTIES INSTALL_RPATH "$ORIGIN")
install(TARGETS clepsydraTurbulence LIBRARY DESTINATION ${_programs}/lib)
install(TARGETS coupling EXPORT ClepsydraTargets LIBRARY DESTINATION ${_programs}/lib INCLUDES DESTINATION include/clepsydra)
if(TARGET sha1Overflow)
    install(TARGETS sha1Overflow LIBRARY DESTINATION ${_programs}/lib)
endif()
if(TARGET scotchDecomp)
    install(TARGETS scotchDecomp LIBRARY DESTINATION ${_programs}/lib/openfoam)
endif()
# Manual pages, made of the programs' own help texts; completion for bash.
set(_manual_of_pimpleDemFoam "unresolved CFD-DEM: OpenFOAM's PIMPLE algorithm with LIGGGHTS particles" -help)
set(_manual_of_traceResidual "finds the physical effect that explains why a simulation differs from a measurement" --help)
set(_manual_of_closures "values of drag laws and correlations for particles in a fluid" --help)
set(_more_of_pimpleDemFoam -listModels Models)
set(_target_of_closures closuresProgram)
foreach(_program IN ITEMS pimpleDemFoam traceResidual closures)
    install(PROGRAMS "${PROJECT_SOURCE_DIR}/cmake/startInstalled" DESTINATION bin RENAME ${_program})
    install(FILES "${PROJECT_SOURCE_DIR}/scripts/completion" DESTINATION share/bash-completion/completions RENAME ${_program})
    set(_target ${_program})
    if(DEFINED _target_of_${_program})
        set(_target ${_target_of_${_program}})
    endif()
    set(_page "${PROJECT_BINARY_DIR}/man/${_program}.1")
    add_custom_command(OUTPUT "${_page}"
        COMMAND ${CMAKE_COMMAND} -E make_directory "${PROJECT_BINARY_DIR}/man"
        COMMAND "${PROJECT_SOURCE_DIR}/tests/support/inEnvironment" "${OpenFOAM_ROOT}" "${PROJECT_SOURCE_DIR}/cmake/man_page.py"
            "$<TARGET_FILE:${_target}>" ${_manual_of_${_program}} "${_page}" ${_more_of_${_program}}
        DEPENDS ${_target} "${PROJECT_SOURCE_DIR}/cmake/man_page.py"
        VERBATIM)
    list(APPEND _pages "${_page}")
endforeach()
add_custom_target(manPages ALL DEPENDS ${_pages})
# All that is installed: what `scripts/setup --programs` builds.
add_custom_target(programs DEPENDS pimpleDemFoam traceResidual closuresProgram manPages)
if(TARGET scotchDecomp)
    add_dependencies(programs scotchDecomp)
endif()
install(FILES ${_pages} DESTINATION share/man/man1)

# What git tracks, since cases leave the results of runs beside their files; not the record of the blind test, which no case needs.
install(CODE "
    execute_process(COMMAND git -C \"${PROJECT_SOURCE_DIR}\" ls-files -- cases cmake scripts meshes identification/effects \"*.md\" LICENSE CITATION.cff
            \":(exclude,glob)cases/**/blindHopper/**\"
        OUTPUT_VARIABLE files OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    string(REPLACE \"\\n\" \";\" files \"\${files}\")
    set(shared \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${_shared}\")
    foreach(file IN LISTS files)
        if(EXISTS \"${PROJECT_SOURCE_DIR}/\${file}\")
            get_filename_component(folder \"\${file}\" DIRECTORY)
            file(COPY \"${PROJECT_SOURCE_DIR}/\${file}\" DESTINATION \"\${shared}/\${folder}\")
        endif()
    endforeach()
    file(WRITE \"\${shared}/.installed\" \"scripts/setup has nothing to do here\\n\")
    file(CREATE_LINK ../../lib/clepsydra \"\${shared}/build\" SYMBOLIC)
")
# Debian's OpenFOAM has no etc/, without which none of its programs starts.
if(OpenFOAM_IS_PACKAGED)
    set(_openfoam ${_shared}/.dependencies/openfoam-${clepsydra_openfoam_version})
    install(DIRECTORY "${OpenFOAM_ROOT}/etc" DESTINATION ${_openfoam})
    # Nor has it RunFunctions, which the tutorials' Allrun use.
    install(FILES "${OpenFOAM_ROOT}/bin/tools/RunFunctions" DESTINATION ${_openfoam}/bin/tools)
endif()

include(CMakePackageConfigHelpers)
set(modules ${_shared}/cmake)
get_filename_component(OpenFOAM_dependencies "${OpenFOAM_ROOT}" DIRECTORY)
set(_config "${PROJECT_BINARY_DIR}/generated/ClepsydraConfig")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/ClepsydraConfig.cmake.in" ${_config}.cmake
    INSTALL_DESTINATION lib/cmake/Clepsydra PATH_VARS modules)
write_basic_package_version_file(${_config}Version.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${_config}.cmake ${_config}Version.cmake DESTINATION lib/cmake/Clepsydra)
install(EXPORT ClepsydraTargets NAMESPACE Clepsydra:: DESTINATION lib/cmake/Clepsydra)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/coupling/" DESTINATION include/clepsydra FILES_MATCHING PATTERN "*.h" PATTERN liggghts EXCLUDE)

set(CPACK_PACKAGE_NAME clepsydra)
set(CPACK_PACKAGE_CONTACT "The Clepsydra authors <clepsydra@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# Packages of the libraries: cmake/packages.cmake. What the scripts start: the groups of scripts/setup that are not for building
set(CPACK_PROJECT_CONFIG_FILE "${PROJECT_SOURCE_DIR}/cmake/packages.cmake")
set(CPACK_CLEPSYDRA_BUILT "${PROJECT_BINARY_DIR}")
set(CPACK_DEBIAN_PACKAGE_DEPENDS
    "openfoam, libopenfoam, liggghts, openmpi-bin, make, python3, python3-numpy, python3-scipy, python3-matplotlib, python3-vtk9, python3-yaml, xvfb, xauth, ffmpeg")
# liggghts recommends ParaView, whose Python conflicts with VTK's: apt looks no further where we do not say so, too.
set(CPACK_DEBIAN_PACKAGE_CONFLICTS "python3-paraview")
include(CPack)
