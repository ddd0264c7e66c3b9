export CLEPSYDRA_DEPENDENCIES=/work/main/.dependencies; cd /work/wt/loop; . scripts/environment
CMD=$(ninja -C build -t commands checkIdentification | grep 'checkIdentification.cpp.o' | sed 's/.*&& //' )
CMD=$(echo "$CMD" | sed "s#-o [^ ]*checkIdentification.cpp.o#-o /tmp/diag/$1.o#; s#-c [^ ]*checkIdentification.cpp#-c /tmp/diag/$1.cpp#; s#-MF [^ ]*#-MF /tmp/diag/$1.d#; s#-MT [^ ]*#-MT x#; s#-Werror[^ ]*##g; s#-Wall##; s#-Wextra##; s#-Wconversion##;s#-Wsign-conversion##;s#-Wpedantic##;s#-Wshadow##")
(cd build && eval "$CMD") && LINK=$(ninja -C build -t commands checkIdentification | tail -1 | sed "s#[^ ]*checkIdentification.cpp.o#/tmp/diag/$1.o#; s#-o bin/checkIdentification#-o /tmp/diag/$1#; s#^: && ##; s# && :##")
(cd build && eval "$LINK")
