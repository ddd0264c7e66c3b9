#include "curves/curve.h"

#include <algorithm>
#include <limits>

namespace clepsydra::identification
{

double timeAtLevel(const Curve& curve, double level)
{
    const auto& value = curve.value;
    for (std::size_t i = 1; i < value.size(); ++i)
    {
        const double before = value[i - 1] - level;
        const double after = value[i] - level;
        if (before == 0.0)
        {
            return curve.time[i - 1];
        }
        if (before * after <= 0.0)
        {
            return curve.time[i - 1] + before / (before - after) * (curve.time[i] - curve.time[i - 1]);
        }
    }
    return std::numeric_limits<double>::quiet_NaN();
}

double valueAt(const Curve& curve, double time)
{
    const std::size_t i = std::lower_bound(curve.time.begin(), curve.time.end(), time) - curve.time.begin();
    if (i == 0 || i == curve.time.size())
    {
        return i == 0 ? curve.value.front() : curve.value.back();
    }
    const double share = (time - curve.time[i - 1]) / (curve.time[i] - curve.time[i - 1]);
    return curve.value[i - 1] + share * (curve.value[i] - curve.value[i - 1]);
}

} // namespace clepsydra::identification
