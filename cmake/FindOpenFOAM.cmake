# FindOpenFOAM: OpenFOAM's headers and libraries.
#
# Uses the environment that is sourced (ESI: WM_PROJECT_DIR, FOAM_LIBBIN), or else the distribution's libraries with the
# headers that scripts/setup has fetched for them.
#
#   OpenFOAM_FOUND, OpenFOAM_VERSION (the API number, such as 2312), OpenFOAM_ROOT (the folder that holds src/ and etc/)
#   OpenFOAM_IS_PACKAGED      true where it is the distribution's, with what scripts/setup has fetched
#
# It says which versions Clepsydra is known to compile with and was tested with, where this is another, and refuses what
# is not ESI's.
#
#   OpenFOAM::core            libOpenFOAM, libPstream
#   OpenFOAM::surfaces        libfileFormats, libsurfMesh
#   OpenFOAM::finiteVolume    libfiniteVolume, libmeshTools, and all above: enough for fvCFD.H
#   OpenFOAM::incompressible  transport and turbulence models
#   OpenFOAM::dynamicMesh     libdynamicMesh, libdynamicFvMesh
#   OpenFOAM::decomposition   libdecompositionMethods

include(FindPackageHandleStandardArgs)
include(FindPackageMessage)

# Clepsydra compiles with the oldest and the newest of these, and its test suite has passed with those that are listed as
# tested. scripts/setup reads the numbers here.
set(OpenFOAM_OLDEST_COMPILED 1912)
set(OpenFOAM_NEWEST_COMPILED 2312)
set(OpenFOAM_TESTED 1912)

#--- Where it is -------------------------------------------------------------------------------------------------------

# The version of the distribution's package, by which scripts/setup names the folder of its headers.
file(STRINGS "${CMAKE_CURRENT_LIST_DIR}/../scripts/openfoamVersion" clepsydra_openfoam_version LIMIT_COUNT 1)
if(DEFINED ENV{CLEPSYDRA_DEPENDENCIES})
    set(_fetched "$ENV{CLEPSYDRA_DEPENDENCIES}/openfoam-${clepsydra_openfoam_version}")
else()
    set(_fetched "${PROJECT_SOURCE_DIR}/.dependencies/openfoam-${clepsydra_openfoam_version}")
endif()

set(_sourced "$ENV{WM_PROJECT_DIR}")
# What another copy of Clepsydra has set up gives way to this copy's own, where it has one.
if(_sourced MATCHES "/\\.dependencies/openfoam-[0-9]" AND IS_DIRECTORY "${_fetched}")
    set(_root "${_fetched}")
elseif(_sourced AND EXISTS "${_sourced}/src/finiteVolume/lnInclude/fvCFD.H")
    set(_root "${_sourced}")
else()
    set(_root "${_fetched}")
endif()

# Libraries of one version behind headers of another corrupt memory in silence. FOAM_LIBBIN is set by a sourced
# environment only; the packaged libraries lie where the linker looks anyway.
if(DEFINED ENV{FOAM_LIBBIN} AND OpenFOAM_ROOT)
    file(REAL_PATH "${OpenFOAM_ROOT}" _configured)
    file(REAL_PATH "${_root}" _wanted)
    if(NOT _configured STREQUAL _wanted)
        message(FATAL_ERROR "${CMAKE_BINARY_DIR} was configured with the OpenFOAM in ${_configured}; the environment that is "
            "sourced has the one in ${_wanted}. Configure another build folder, or source the environment of this one.")
    endif()
endif()

find_path(OpenFOAM_ROOT src/finiteVolume/lnInclude/fvCFD.H
    PATHS "${_root}" NO_DEFAULT_PATH
    DOC "OpenFOAM's folder with src/ and etc/"
)
if(DEFINED ENV{FOAM_LIBBIN})
    find_library(OpenFOAM_LIBRARY OpenFOAM PATHS "$ENV{FOAM_LIBBIN}" NO_DEFAULT_PATH)
else()
    find_library(OpenFOAM_LIBRARY OpenFOAM)
endif()
get_filename_component(_libraries "${OpenFOAM_LIBRARY}" DIRECTORY)
# That of MPI before the one in dummy/, which only a program without MPI links.
find_library(OpenFOAM_PSTREAM_LIBRARY Pstream PATHS "${_libraries}/$ENV{FOAM_MPI}" "${_libraries}" NO_DEFAULT_PATH)
mark_as_advanced(OpenFOAM_ROOT OpenFOAM_LIBRARY OpenFOAM_PSTREAM_LIBRARY)

if(OpenFOAM_ROOT)
    if(NOT EXISTS "${OpenFOAM_ROOT}/META-INFO/api-info")
        message(FATAL_ERROR "The OpenFOAM in ${OpenFOAM_ROOT} has no META-INFO/api-info, so it is not ESI's (openfoam.com), "
            "which Clepsydra needs: v${OpenFOAM_OLDEST_COMPILED} or later.")
    endif()
    file(STRINGS "${OpenFOAM_ROOT}/META-INFO/api-info" _api REGEX "^api=[0-9]+")
    string(REGEX REPLACE "^api=" "" OpenFOAM_VERSION "${_api}")
    if(NOT OpenFOAM_VERSION IN_LIST OpenFOAM_TESTED)
        set(_severity STATUS)
        if(OpenFOAM_VERSION LESS OpenFOAM_OLDEST_COMPILED OR OpenFOAM_VERSION GREATER OpenFOAM_NEWEST_COMPILED)
            set(_severity WARNING)
        endif()
        list(JOIN OpenFOAM_TESTED ", v" _tested)
        message(${_severity} "Clepsydra compiles with OpenFOAM v${OpenFOAM_OLDEST_COMPILED} to v${OpenFOAM_NEWEST_COMPILED}, and "
            "its tests have passed with v${_tested}. Run the tests (ctest) with this v${OpenFOAM_VERSION} before you trust a result.")
    endif()
endif()

set(OpenFOAM_IS_PACKAGED FALSE)
if(EXISTS "${OpenFOAM_ROOT}/.complete")     # the last that scripts/setup writes there
    set(OpenFOAM_IS_PACKAGED TRUE)
endif()

find_package_handle_standard_args(OpenFOAM
    REQUIRED_VARS OpenFOAM_ROOT OpenFOAM_LIBRARY OpenFOAM_PSTREAM_LIBRARY
    VERSION_VAR OpenFOAM_VERSION
    REASON_FAILURE_MESSAGE "Run scripts/setup, or source the environment (etc/bashrc) of a compiled OpenFOAM first."
)
# The line above names the folder of the headers. The libraries lie elsewhere where they are the distribution's.
if(OpenFOAM_FOUND)
    find_package_message(OpenFOAM_libraries
        "OpenFOAM ${OpenFOAM_VERSION}: headers in ${OpenFOAM_ROOT}/src, libraries as ${OpenFOAM_LIBRARY}, ${OpenFOAM_PSTREAM_LIBRARY}"
        "[${OpenFOAM_VERSION}][${OpenFOAM_ROOT}][${OpenFOAM_LIBRARY}][${OpenFOAM_PSTREAM_LIBRARY}]")
endif()

#--- What to compile and link with -------------------------------------------------------------------------------------

function(_openfoam_target name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LIBRARIES;FOLDERS;DEPENDS")
    if(TARGET OpenFOAM::${name})
        return()
    endif()
    add_library(OpenFOAM::${name} INTERFACE IMPORTED)
    foreach(folder IN LISTS arg_FOLDERS)
        # Imported targets' includes are system includes: OpenFOAM's headers are full of what our warnings forbid.
        target_include_directories(OpenFOAM::${name} SYSTEM INTERFACE "${OpenFOAM_ROOT}/src/${folder}/lnInclude")
    endforeach()
    foreach(library IN LISTS arg_LIBRARIES)
        find_library(OpenFOAM_${library}_LIBRARY ${library} PATHS "${_libraries}" NO_DEFAULT_PATH REQUIRED)
        mark_as_advanced(OpenFOAM_${library}_LIBRARY)
        target_link_libraries(OpenFOAM::${name} INTERFACE "${OpenFOAM_${library}_LIBRARY}")
    endforeach()
    list(TRANSFORM arg_DEPENDS PREPEND OpenFOAM::)
    target_link_libraries(OpenFOAM::${name} INTERFACE ${arg_DEPENDS})
endfunction()

# Kept in the cache: CMake may run again where the environment is not sourced.
function(_openfoam_environment variable default result)
    if(DEFINED ENV{${variable}})
        set(OpenFOAM_${variable} "$ENV{${variable}}" CACHE INTERNAL "${variable} of the environment that was sourced")
    elseif(NOT DEFINED OpenFOAM_${variable})
        set(OpenFOAM_${variable} "${default}" CACHE INTERNAL "${variable}, since no environment was sourced")
    endif()
    set(${result} "${OpenFOAM_${variable}}" PARENT_SCOPE)
endfunction()

if(OpenFOAM_FOUND)
    if(NOT OpenFOAM_FIND_QUIETLY)
        message(STATUS "OpenFOAM v${OpenFOAM_VERSION}: headers in ${OpenFOAM_ROOT}, libraries in ${_libraries}")
    endif()
    _openfoam_target(core FOLDERS OpenFOAM OSspecific/POSIX Pstream/mpi)
    target_link_libraries(OpenFOAM::core INTERFACE "${OpenFOAM_LIBRARY}" "${OpenFOAM_PSTREAM_LIBRARY}")

    _openfoam_environment(WM_ARCH linux64 _architecture)
    _openfoam_environment(WM_PRECISION_OPTION DP _precision)
    _openfoam_environment(WM_LABEL_SIZE 32 _label_size)
    target_compile_definitions(OpenFOAM::core INTERFACE
        ${_architecture} WM_ARCH_OPTION=64 WM_${_precision} WM_LABEL_SIZE=${_label_size}
        NoRepository        # template bodies are included, not compiled apart
        OPENFOAM=${OpenFOAM_VERSION}
    )
    # Run-time selection tables are filled by libraries that no symbol of ours refers to: the linker must keep them.
    target_link_options(OpenFOAM::core INTERFACE "LINKER:--no-as-needed")
    target_link_libraries(OpenFOAM::core INTERFACE ${CMAKE_DL_LIBS} m)

    _openfoam_target(surfaces DEPENDS core LIBRARIES fileFormats surfMesh FOLDERS fileFormats surfMesh)
    _openfoam_target(finiteVolume DEPENDS core surfaces LIBRARIES finiteVolume meshTools FOLDERS finiteVolume meshTools)
    _openfoam_target(incompressible DEPENDS finiteVolume
        LIBRARIES incompressibleTransportModels turbulenceModels incompressibleTurbulenceModels
        FOLDERS transportModels/incompressible TurbulenceModels/turbulenceModels
            TurbulenceModels/incompressible
    )
    # Its headers include each other as <incompressible/...>, seen from src/transportModels.
    target_include_directories(OpenFOAM::incompressible SYSTEM INTERFACE "${OpenFOAM_ROOT}/src/transportModels")
    _openfoam_target(dynamicMesh DEPENDS finiteVolume
        LIBRARIES dynamicMesh dynamicFvMesh FOLDERS dynamicMesh dynamicFvMesh)
    _openfoam_target(decomposition DEPENDS finiteVolume
        LIBRARIES decompositionMethods FOLDERS parallel/decompose/decompositionMethods)
endif()
