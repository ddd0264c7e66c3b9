# Compiles files of one folder together, so that the templates of OpenFOAM and Eigen that they share are instantiated once.
#
#   clepsydra_unite(<target> [EXCEPT <folder>...])
#
# Not for folders of models that register themselves under like names, one a file.
# Each file still has to include what it uses: -D CLEPSYDRA_UNITY=OFF compiles one by one, which is faster after a change.
option(CLEPSYDRA_UNITY "Compile files of one folder together" ON)
set(CLEPSYDRA_UNITY_SIZE 6 CACHE STRING "Largest number of files that are compiled together")

function(clepsydra_unite target)
    if(NOT CLEPSYDRA_UNITY)
        return()
    endif()
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "EXCEPT")
    get_target_property(files ${target} SOURCES)
    foreach(file IN LISTS files)
        get_source_file_property(alone ${file} SKIP_PRECOMPILE_HEADERS)
        get_filename_component(folder ${file} DIRECTORY)
        if(alone OR folder IN_LIST arg_EXCEPT)
            continue() # SKIP_PRECOMPILE_HEADERS: it has options or macros of its own
        endif()
        string(MAKE_C_IDENTIFIER "in_${folder}" folder)
        math(EXPR part "0${_count_${folder}} / ${CLEPSYDRA_UNITY_SIZE}")
        math(EXPR _count_${folder} "0${_count_${folder}} + 1")
        set_source_files_properties(${file} PROPERTIES UNITY_GROUP "${folder}_${part}")
    endforeach()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
