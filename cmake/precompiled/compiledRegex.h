#pragma once

// First of the precompiled headers: what std::regex consists of is compiled in compiledRegex.cpp, once. OpenFOAM's inline
// functions use std::regex, and GCC instantiates in each file all templates that inline functions of a precompiled header
// use, whether that file calls them or not. Without this a file of five lines takes 0.7 s longer.
//
// These are names of libstdc++, not of the standard: precompiled.cmake tries whether they are known, and does without
// where they are not.

#include <memory>
#include <regex>
#include <string>

namespace std::__detail
{

extern template class _Compiler<regex_traits<char>>;
extern template class _Scanner<char>;
extern template bool __regex_algo_impl(string::const_iterator, string::const_iterator, smatch&, const regex&,
    regex_constants::match_flag_type, _RegexExecutorPolicy, bool);

} // namespace std::__detail
