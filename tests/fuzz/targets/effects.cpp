// A library of effects: either refused with StudyError, or each formula in it has a value or names what it lacks.
#include "inputFile.h"

#include "study/readStudy.h"
#include "study/yaml.h"

#include <stdexcept>

using namespace clepsydra::identification;

namespace
{

void use(const Expression& formula)
{
    try
    {
        formula({{"a", 1.0}, {"particleDiameter", 2e-3}});
    }
    catch (const std::invalid_argument&) // a name that the case does not have
    {
        return;
    }
}

void read(const std::filesystem::path& file)
{
    const auto library = YamlPlace::fileAt(file);
    library.allow({"about", "effects"});
    for (const auto& effect : readEffects(library.at("effects")))
    {
        for (const auto& [entry, formula] : effect.entries)
        {
            use(formula);
        }
        if (effect.chainSize)
        {
            use(*effect.chainSize);
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto file = clepsydra::inputFile("effects.yaml", data, size);
    try
    {
        read(file);
    }
    catch (const StudyError&) // the user's error, reported with its place
    {
        return 0;
    }
    return 0;
}
