// A measured file and a run's own table: read as a study reads them, every feature and every operation of the measuring
// chain applied. Either refused with std::runtime_error, or times increase and all numbers are finite.
#include "inputFile.h"

#include "curves/table.h"
#include "effects/measuringChain.h"
#include "study/measurements.h"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <stdexcept>

using namespace clepsydra::identification;

namespace
{

/// Amplitudes of the effects of chains are of this order.
constexpr double operationSize = 0.05;

/// The parameters of those kinds that have no default: a share, a level or a time.
constexpr double anyParameter = 0.5;

Study studyOf(const std::filesystem::path& file)
{
    Study study;
    for (const auto& [name, kind] : featureKinds())
    {
        Feature feature{name, &kind, {}};
        for (const auto& parameter : kind.parameters)
        {
            feature.parameters[parameter.name] = std::isnan(parameter.byDefault) ? anyParameter : parameter.byDefault;
        }
        study.features.push_back(feature);
    }
    Condition condition;
    condition.measured.files = {file};
    condition.measured.time.column = "time";
    condition.measured.value.column = "2";
    study.conditions = {condition};
    return study;
}

void mustBeACurve(const Curve& curve)
{
    for (std::size_t i = 0; i < curve.time.size(); ++i)
    {
        if (!std::isfinite(curve.time[i]) || !std::isfinite(curve.value[i])
            || (i > 0 && curve.time[i] < curve.time[i - 1]))
        {
            std::cerr << "row " << i << " is no row of a curve\n";
            std::abort();
        }
    }
}

void read(const std::filesystem::path& file)
{
    static const Study study = studyOf(file);
    const MeasuredCondition measured = readMeasurements(study, 0);
    const Curve& curve = measured.curves.front();
    mustBeACurve(curve);
    for (const auto& [name, operation] : chainOperations())
    {
        const Curve changed = operation.apply(curve, operationSize);
        for (const auto& feature : study.features)
        {
            feature(changed);
        }
    }
    mustBeACurve(readCurve(file, "1", "2"));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto file = clepsydra::inputFile("input.csv", data, size);
    try
    {
        read(file);
    }
    catch (const std::runtime_error&) // the user's error, reported
    {
        return 0;
    }
    return 0;
}
