# FindOpenFOAM: OpenFOAM's headers and libraries.
#
# Uses the environment that is sourced (ESI: WM_PROJECT_DIR, FOAM_LIBBIN), or else the distribution's libraries with the
# headers that scripts/setup has fetched for them.
#
#   OpenFOAM_FOUND, OpenFOAM_VERSION (the API number, such as 2312), OpenFOAM_ROOT (the folder that holds src/ and etc/)
#
#   OpenFOAM::core            libOpenFOAM, libPstream
#   OpenFOAM::surfaces        libfileFormats, libsurfMesh
#   OpenFOAM::finiteVolume    libfiniteVolume, libmeshTools, and all above: enough for fvCFD.H
#   OpenFOAM::incompressible  transport and turbulence models
#   OpenFOAM::sampling        libsampling: sampled sets and surfaces
#   OpenFOAM::dynamicMesh     libdynamicMesh, libdynamicFvMesh
#   OpenFOAM::lagrangian      liblagrangian (basic particles)
#   OpenFOAM::fvOptions       libfvOptions
#   OpenFOAM::decomposition   libdecompositionMethods

include(FindPackageHandleStandardArgs)
include(FindPackageMessage)

#--- Where it is -------------------------------------------------------------------------------------------------------

# The version of the distribution's package, by which scripts/setup names the folder of its headers.
file(STRINGS "${CMAKE_CURRENT_LIST_DIR}/../scripts/openfoamVersion" clepsydra_openfoam_version LIMIT_COUNT 1)
if(DEFINED ENV{CLEPSYDRA_DEPENDENCIES})
    set(_fetched "$ENV{CLEPSYDRA_DEPENDENCIES}/openfoam-${clepsydra_openfoam_version}")
else()
    set(_fetched "${PROJECT_SOURCE_DIR}/.dependencies/openfoam-${clepsydra_openfoam_version}")
endif()

set(_sourced "$ENV{WM_PROJECT_DIR}")
if(_sourced AND EXISTS "${_sourced}/src/finiteVolume/lnInclude/fvCFD.H")
    set(_root "${_sourced}")
else()
    set(_root "${_fetched}")
endif()

find_path(OpenFOAM_ROOT src/finiteVolume/lnInclude/fvCFD.H
    PATHS "${_root}" NO_DEFAULT_PATH
    DOC "OpenFOAM's folder with src/ and etc/"
)
# FOAM_LIBBIN is set by a sourced environment only; the packaged libraries lie where the linker looks anyway.
set(OpenFOAM_LIBRARY_HINTS "$ENV{FOAM_LIBBIN}/$ENV{FOAM_MPI}" "$ENV{FOAM_LIBBIN}")
find_library(OpenFOAM_LIBRARY OpenFOAM HINTS ${OpenFOAM_LIBRARY_HINTS})
find_library(OpenFOAM_PSTREAM_LIBRARY Pstream HINTS ${OpenFOAM_LIBRARY_HINTS})
mark_as_advanced(OpenFOAM_ROOT OpenFOAM_LIBRARY OpenFOAM_PSTREAM_LIBRARY)

if(OpenFOAM_ROOT AND EXISTS "${OpenFOAM_ROOT}/META-INFO/api-info")
    file(STRINGS "${OpenFOAM_ROOT}/META-INFO/api-info" _api REGEX "^api=[0-9]+")
    string(REGEX REPLACE "^api=" "" OpenFOAM_VERSION "${_api}")
endif()

find_package_handle_standard_args(OpenFOAM
    REQUIRED_VARS OpenFOAM_ROOT OpenFOAM_LIBRARY OpenFOAM_PSTREAM_LIBRARY
    VERSION_VAR OpenFOAM_VERSION
    REASON_FAILURE_MESSAGE "Looked for src/finiteVolume/lnInclude/fvCFD.H in ${_root}. Run scripts/setup, or source an OpenFOAM environment first."
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
        find_library(OpenFOAM_${library}_LIBRARY ${library} HINTS ${OpenFOAM_LIBRARY_HINTS} REQUIRED)
        mark_as_advanced(OpenFOAM_${library}_LIBRARY)
        target_link_libraries(OpenFOAM::${name} INTERFACE "${OpenFOAM_${library}_LIBRARY}")
    endforeach()
    list(TRANSFORM arg_DEPENDS PREPEND OpenFOAM::)
    target_link_libraries(OpenFOAM::${name} INTERFACE ${arg_DEPENDS})
endfunction()

function(_openfoam_environment variable default result)
    if(DEFINED ENV{${variable}})
        set(${result} "$ENV{${variable}}" PARENT_SCOPE)
    else()
        set(${result} "${default}" PARENT_SCOPE)
    endif()
endfunction()

if(OpenFOAM_FOUND)
    _openfoam_target(core LIBRARIES OpenFOAM Pstream FOLDERS OpenFOAM OSspecific/POSIX Pstream/mpi)

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
    _openfoam_target(sampling DEPENDS finiteVolume LIBRARIES sampling FOLDERS sampling)
    _openfoam_target(dynamicMesh DEPENDS finiteVolume
        LIBRARIES dynamicMesh dynamicFvMesh FOLDERS dynamicMesh dynamicFvMesh)
    _openfoam_target(lagrangian DEPENDS finiteVolume LIBRARIES lagrangian FOLDERS lagrangian/basic)
    _openfoam_target(fvOptions DEPENDS incompressible LIBRARIES fvOptions FOLDERS fvOptions)
    _openfoam_target(decomposition DEPENDS finiteVolume
        LIBRARIES decompositionMethods FOLDERS parallel/decompose/decompositionMethods)
endif()
