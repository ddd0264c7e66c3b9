/// \file
/// A library with functions of the same names as in replacedFunctions.cpp, which it calls itself.

#include <cstdio>

/// As long as LIGGGHTS' functions are at least.
extern "C" int answer()
{
    char text[24];
    std::snprintf(text, sizeof text, "%d %d %d", 1, 2, 3);
    return text[0] - '0';
}

/// Too short for a jump to another one to fit in.
extern "C" int short_answer()
{
    return 1;
}

extern "C" int ASK()
{
    return answer();
}

extern "C" int ASK_SHORT()
{
    return short_answer();
}
