// The `parameters` of a case as traceResidual reads and changes them: what is set is what is read again, and all other
// entries keep their values. (scripts/clepsydra/parameter_file.py reads the same files: parameters.py.)
#include "inputFile.h"

#include "study/entries.h"

#include <cstdlib>
#include <iostream>
#include <stdexcept>

using namespace clepsydra::identification;

namespace
{

void changeAndReadAgain(const std::filesystem::path& file)
{
    Entries entries = readEntries(file);
    numbersOf(entries);
    if (entries.empty())
    {
        return;
    }
    entries.begin()->second = "42";
    replaceEntries(file, {*entries.begin()});
    if (readEntries(file) != entries)
    {
        std::cerr << "other entries after '" << entries.begin()->first << "' was set\n";
        std::abort();
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto file = clepsydra::inputFile("parameters", data, size);
    try
    {
        changeAndReadAgain(file);
    }
    catch (const std::runtime_error&) // the user's error, reported
    {
        return 0;
    }
    return 0;
}
