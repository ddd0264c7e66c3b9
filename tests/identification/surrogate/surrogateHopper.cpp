/// The surrogate as the program of a case: it reads `parameters` in the current directory and writes
/// postProcessing/massInHopper/0/massInHopper.dat. It fails if `failWithSeed` equals its seed.
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
