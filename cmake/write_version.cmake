# Run in every build by version.cmake: SOURCE_DIR, TEMPLATE, HEADER, VERSION -> HEADER.

find_program(GIT git)
if(GIT)
    execute_process(
        # Somebody else's folder (root building in a user's checkout) is safe to ask for its commit.
        COMMAND "${GIT}" -c "safe.directory=*" describe --always --dirty --abbrev=12 --exclude=*
        WORKING_DIRECTORY "${SOURCE_DIR}"
        OUTPUT_VARIABLE GIT_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE
        ERROR_QUIET
    )
endif()
if(NOT GIT_COMMIT)
    set(GIT_COMMIT unknown)
endif()

configure_file("${TEMPLATE}" "${HEADER}" @ONLY)
