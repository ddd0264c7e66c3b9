/// The surrogate as a program that obeys the contract of a case: reads `parameters` in the folder it is started in and
/// writes postProcessing/massInHopper/0/massInHopper.dat. With `failWithSeed` equal to its seed it fails.
#include "surrogate/surrogate.h"

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>

int main()
{
    using namespace clepsydra::identification;
    try
    {
        const Entries entries = readEntries("parameters");
        const auto failing = entries.find("failWithSeed");
        if (failing != entries.end() && failing->second == entries.at("seed"))
        {
            std::cerr << "asked to fail with seed " << failing->second << '\n';
            return 3;
        }
        const Curve curve = tests::discharge(entries);
        const std::filesystem::path folder = "postProcessing/massInHopper/0";
        std::filesystem::create_directories(folder);
        std::ofstream table(folder / "massInHopper.dat");
        table << "# time [s]\tmass [kg]\n";
        for (std::size_t i = 0; i < curve.time.size(); ++i)
        {
            table << curve.time[i] << '\t' << textOf(curve.value[i]) << '\n';
        }
        return 0;
    }
    catch (const std::exception& error)
    {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
