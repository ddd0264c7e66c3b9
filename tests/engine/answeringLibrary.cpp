/// \file
/// A library that calls a function of its own, which replacedFunctions.cpp has, too.

extern "C" int answer()
{
    return 1;
}

extern "C" int ASK()
{
    return answer();
}
