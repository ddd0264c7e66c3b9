# Our own code with sanitizers; the engines' libraries stay as they are. What these leak, and what their headers do, is
# named in scripts/developers/sanitizers.
#
#   CLEPSYDRA_SANITIZE   everything, with address, leak and undefined-behaviour sanitizers: scripts/sanitize
#   CLEPSYDRA_FUZZ       the same for the fuzzers of tests/fuzz, which need clang: scripts/fuzz

option(CLEPSYDRA_SANITIZE "Compile with address, leak and undefined-behaviour sanitizers" OFF)
option(CLEPSYDRA_FUZZ "Compile for the fuzzers, with the same sanitizers (clang only)" OFF)

if(CLEPSYDRA_SANITIZE OR CLEPSYDRA_FUZZ)
    # One level of optimisation: several times quicker to run than none, and the reports still name the right lines.
    string(REPLACE "-O3" "-O1" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
    # With the assertions of Eigen and of the standard library, which see an index or a size that is wrong within one
    # allocation, where no sanitizer does. A release leaves them out.
    string(REPLACE "-DNDEBUG" "-D_GLIBCXX_ASSERTIONS" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
    add_compile_options(-fsanitize=address,undefined -fno-omit-frame-pointer -g1)
    add_link_options(-fsanitize=address,undefined)
endif()
if(CLEPSYDRA_SANITIZE)
    add_library(keepLoaded OBJECT scripts/developers/sanitizers/keepLoaded.cpp)
    link_libraries($<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:$<TARGET_OBJECTS:keepLoaded>>)
endif()
if(CLEPSYDRA_FUZZ)
    add_compile_options(-fsanitize=fuzzer-no-link)
endif()
