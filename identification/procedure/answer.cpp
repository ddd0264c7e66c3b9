#include "procedure/answer.h"

namespace clepsydra::identification
{

std::string nameOf(Decision decision)
{
    switch (decision)
    {
        case Decision::noResidual:
            return "noResidual";
        case Decision::named:
            return "named";
        case Decision::set:
            return "set";
        case Decision::unknown:
            break;
    }
    return "unknown";
}

} // namespace clepsydra::identification
