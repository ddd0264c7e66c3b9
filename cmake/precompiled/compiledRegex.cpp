#include "compiledRegex.h"

namespace std::__detail
{

template class _Compiler<regex_traits<char>>;
template class _Scanner<char>;
template bool __regex_algo_impl(string::const_iterator, string::const_iterator, smatch&, const regex&,
    regex_constants::match_flag_type, _RegexExecutorPolicy, bool);

} // namespace std::__detail
