# For tests that use OpenFOAM in the test program itself.
#
#   clepsydra_openfoam_test(<target> RANKS <n> ... [TIMEOUT <seconds>])
#
# gives <target> a main() (support/main.cpp) and declares it to ctest, once for each number of ranks: the whole
# program, not single tests, for starting OpenFOAM and MPI costs more than most of them.
include_guard(GLOBAL)

add_library(openfoamTestMain STATIC ${CMAKE_CURRENT_LIST_DIR}/main.cpp)
target_include_directories(openfoamTestMain PUBLIC ${CMAKE_CURRENT_LIST_DIR}/..)
target_link_libraries(openfoamTestMain
    PUBLIC clepsydra::coupling GTest::gtest GTest::gmock OpenFOAM::finiteVolume MPI::MPI_CXX
    PRIVATE clepsydra_warnings)
# Compiled as executables are, which take its precompiled headers.
set_target_properties(openfoamTestMain PROPERTIES POSITION_INDEPENDENT_CODE OFF)
target_compile_options(openfoamTestMain PRIVATE -fPIE)
clepsydra_precompile(openfoamTestMain OPENFOAM EIGEN GTEST)

function(clepsydra_openfoam_test target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "TIMEOUT" "RANKS")
    if(NOT DEFINED arg_TIMEOUT)
        set(arg_TIMEOUT 300)
    endif()
    target_link_libraries(${target} PRIVATE openfoamTestMain clepsydra_warnings)
    clepsydra_reuse_precompiled(${target} openfoamTestMain)
    set(environment ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/inEnvironment ${OpenFOAM_ROOT})
    foreach(ranks IN LISTS arg_RANKS)
        if(ranks EQUAL 1)
            set(name ${target})
            add_test(NAME ${name} COMMAND ${environment} $<TARGET_FILE:${target}>)
        else()
            set(name ${target}.${ranks}ranks)
            # By its name: with its path, Open MPI puts its own prefix (/usr/lib) before the libraries of another OpenFOAM.
            get_filename_component(mpiexec ${MPIEXEC_EXECUTABLE} NAME)
            add_test(NAME ${name} COMMAND ${environment}
                ${mpiexec} ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:${target}> -parallel)
        endif()
        set_tests_properties(${name} PROPERTIES PROCESSORS ${ranks} TIMEOUT ${arg_TIMEOUT})
    endforeach()
endfunction()
