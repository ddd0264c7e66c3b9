// A study file, beside a case and a measured file: either refused with StudyError, or every formula in it has a value
// (or is refused for a name that the case does not have) and its measurements are read.
#include "inputFile.h"

#include "effects/measuringChain.h"
#include "study/measurements.h"
#include "study/readStudy.h"
#include "study/yaml.h"

#include <stdexcept>

using namespace clepsydra::identification;

namespace
{

void use(const Study& study)
{
    const auto numbers = numbersOf(readEntries(study.simulator.caseFolder / entriesFile));
    for (const auto& parameter : study.parameters)
    {
        for (const auto& [entry, formula] : parameter.entries)
        {
            formula({{parameter.name, parameter.mean}});
        }
    }
    for (const auto& effect : study.effects)
    {
        auto variables = numbers;
        variables["a"] = effect.bounds.upper;
        for (const auto& [entry, formula] : effect.entries)
        {
            formula(variables);
        }
        for (const auto& condition : study.conditions)
        {
            acts(effect, condition);
        }
    }
    for (std::size_t condition = 0; condition < study.conditions.size(); ++condition)
    {
        readMeasurements(study, condition);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto file = clepsydra::inputFile("study.yaml", data, size);
    std::optional<Study> study;
    try
    {
        study = readStudy(file);
    }
    catch (const StudyError&) // the user's error, reported with its place
    {
        return 0;
    }
    try
    {
        use(*study);
    }
    catch (const std::invalid_argument&) // a name in a formula
    {
        return 0;
    }
    catch (const std::runtime_error&) // a measured file
    {
        return 0;
    }
    return 0;
}
