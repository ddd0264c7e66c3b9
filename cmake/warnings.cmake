# clepsydra_warnings: link our own targets with it (PRIVATE). The engines' headers are system headers and stay silent.

add_library(clepsydra_warnings INTERFACE)
target_compile_options(clepsydra_warnings INTERFACE
    -Wall -Wextra -Wpedantic
    -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wsuggest-override
    -Wold-style-cast -Wcast-qual -Wfloat-conversion
    -Wunused -Wformat=2
    $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond;-Wduplicated-branches;-Wlogical-op>
    # Not -Wconversion: OpenFOAM's label is an int and every size() of the standard library is not.
    # Nothing is lost in the direction that hurts: -Wfloat-conversion catches a number cut to a whole one.
)
if(CLEPSYDRA_WERROR)
    target_compile_options(clepsydra_warnings INTERFACE -Werror)
endif()
