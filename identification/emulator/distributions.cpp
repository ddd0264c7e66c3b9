#include "emulator/distributions.h"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/special_functions/digamma.hpp>

namespace clepsydra::identification
{

namespace
{

using boost::math::complement;
using boost::math::fisher_f;
using boost::math::normal;

} // namespace

double normalQuantile(double probability)
{
    return boost::math::quantile(normal(), probability);
}

double probabilityBeyondNormal(double value)
{
    return boost::math::cdf(complement(normal(), value));
}

double probabilityBeyondFisher(double value, double freedom, double freedomOfNoise)
{
    return boost::math::cdf(complement(fisher_f(freedom, freedomOfNoise), value));
}

double fisherValueBeyond(double probability, double freedom, double freedomOfNoise)
{
    return boost::math::quantile(complement(fisher_f(freedom, freedomOfNoise), probability));
}

double digamma(double value)
{
    return boost::math::digamma(value);
}

} // namespace clepsydra::identification
