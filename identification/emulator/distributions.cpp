#include "emulator/distributions.h"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/special_functions/digamma.hpp>

namespace clepsydra::identification
{

namespace math = boost::math;

double normalQuantile(double probability)
{
    return math::quantile(math::normal(), probability);
}

double probabilityBeyondNormal(double value)
{
    return math::cdf(math::complement(math::normal(), value));
}

double probabilityBeyondFisher(double value, double freedom, double freedomOfNoise)
{
    return math::cdf(math::complement(math::fisher_f(freedom, freedomOfNoise), value));
}

double fisherValueBeyond(double probability, double freedom, double freedomOfNoise)
{
    return math::quantile(math::complement(math::fisher_f(freedom, freedomOfNoise), probability));
}

double digamma(double value)
{
    return math::digamma(value);
}

} // namespace clepsydra::identification
