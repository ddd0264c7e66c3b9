# Headers that most files of a kind include, compiled once: OpenFOAM's fields alone take two seconds a file.
#
#   clepsydra_precompile(<target> [OPENFOAM] [EIGEN] [JSON] [GTEST])
#
# Files must include what they use all the same: -D CLEPSYDRA_PRECOMPILE=OFF compiles them without.
option(CLEPSYDRA_PRECOMPILE "Precompile the headers of OpenFOAM and other libraries" ON)

function(clepsydra_precompile target)
    if(NOT CLEPSYDRA_PRECOMPILE)
        return()
    endif()
    cmake_parse_arguments(PARSE_ARGV 1 arg "OPENFOAM;EIGEN;JSON;GTEST" "" "")
    set(headers algorithm cmath filesystem functional map memory sstream string vector)
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

# Those of another target, which must be compiled with the same options.
function(clepsydra_reuse_precompiled target other)
    if(CLEPSYDRA_PRECOMPILE)
        target_precompile_headers(${target} REUSE_FROM ${other})
    endif()
endfunction()
