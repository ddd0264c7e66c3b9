# Headers that most files of a kind include, compiled once: OpenFOAM's fields alone take two seconds a file.
#
#   clepsydra_precompile(<target> [OPENFOAM] [EIGEN] [JSON] [GTEST])
#
# Files must include what they use all the same: -D CLEPSYDRA_PRECOMPILE=OFF compiles them without.
option(CLEPSYDRA_PRECOMPILE "Precompile the headers of OpenFOAM and other libraries" ON)

if(CLEPSYDRA_PRECOMPILE)
    set(_regex "${PROJECT_SOURCE_DIR}/cmake/precompiled")
    try_compile(CLEPSYDRA_COMPILED_REGEX "${PROJECT_BINARY_DIR}/CMakeFiles/compiledRegex" "${_regex}/tryRegex.cpp"
        CMAKE_FLAGS "-DINCLUDE_DIRECTORIES=${_regex}"
        CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON)
    if(CLEPSYDRA_COMPILED_REGEX)
        add_library(compiledRegex STATIC "${_regex}/compiledRegex.cpp")
        target_include_directories(compiledRegex SYSTEM PUBLIC "${_regex}")
    endif()
endif()

function(clepsydra_precompile target)
    if(NOT CLEPSYDRA_PRECOMPILE)
        return()
    endif()
    cmake_parse_arguments(PARSE_ARGV 1 arg "OPENFOAM;EIGEN;JSON;GTEST" "" "")
    set(headers algorithm cmath filesystem functional map memory sstream string vector)
    if(TARGET compiledRegex)
        list(PREPEND headers compiledRegex.h)
        target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:compiledRegex>)
    endif()
    if(arg_GTEST)
        list(APPEND headers gmock/gmock.h gtest/gtest.h) # before OpenFOAM, whose macros (Info, ...) are gmock's names
    endif()
    if(arg_OPENFOAM)
        list(APPEND headers IOdictionary.H fvMatrices.H fvMesh.H surfaceFields.H volFields.H)
    endif()
    if(arg_EIGEN)
        list(APPEND headers Eigen/Dense)
    endif()
    if(arg_JSON)
        list(APPEND headers nlohmann/json.hpp)
    endif()
    list(TRANSFORM headers REPLACE "^(.+)$" "<\\1>")
    target_precompile_headers(${target} PRIVATE ${headers})
endfunction()

# Reuses the precompiled headers of another target, which must be compiled with the same options.
function(clepsydra_reuse_precompiled target other)
    if(CLEPSYDRA_PRECOMPILE)
        target_precompile_headers(${target} REUSE_FROM ${other})
        if(TARGET compiledRegex)
            target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:compiledRegex>)
        endif()
    endif()
endfunction()
