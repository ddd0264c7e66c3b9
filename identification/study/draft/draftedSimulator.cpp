#include "study/draft/draftedSimulator.h"

#include "study/entriesOfRuns.h"
#include "study/readStudy.h"

#include <cstdlib>
#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

namespace fs = std::filesystem;

bool holds(const fs::path& file, const std::string& word)
{
    std::ifstream in(file);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    return text.find(word) != std::string::npos;
}

/// The observable that the case writes. Its function object is named in the case's own files or in those of system/.
std::string observableOf(const fs::path& folder)
{
    for (const char* observable : {"massInHopper", "particleHeight"})
    {
        for (const auto& place : {folder, folder / "system"})
        {
            if (!fs::is_directory(place))
            {
                continue;
            }
            for (const auto& entry : fs::directory_iterator(place))
            {
                if (entry.is_regular_file() && holds(entry.path(), observable))
                {
                    return observable;
                }
            }
        }
    }
    return "";
}

/// Folder identification/effects of the checkout that contains the case; without one, of that whose scripts/environment
/// was sourced, or that contains the program.
fs::path effectsFolder(const fs::path& caseFolder)
{
    const char* const sourced = std::getenv("CLEPSYDRA");
    for (fs::path folder :
        {caseFolder, fs::path(sourced == nullptr ? "" : sourced), fs::read_symlink("/proc/self/exe")})
    {
        for (; folder.has_relative_path(); folder = folder.parent_path())
        {
            if (fs::is_directory(folder / "identification/effects"))
            {
                return folder / "identification/effects";
            }
        }
    }
    return {};
}

void chooseLibrary(DraftedSimulator& simulator)
{
    const fs::path folder = effectsFolder(simulator.folder);
    if (folder.empty())
    {
        return;
    }
    std::set<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
    {
        files.insert(entry.path());
    }
    double best = 0.0;
    for (const auto& file : files)
    {
        const auto effects =
            file.extension() == ".yaml" ? readEffects(YamlPlace::fileAt(file).at("effects")) : std::vector<Effect>();
        const auto isOfSimulator = [](const Effect& effect) { return !effect.isOfChain(); };
        const auto fits = [&](const Effect& effect) {
            return isOfSimulator(effect) && missingEntries(effect, simulator.entries).empty();
        };
        const auto all = std::count_if(effects.begin(), effects.end(), isOfSimulator);
        const auto fitting = std::count_if(effects.begin(), effects.end(), fits);
        if (fitting > best * static_cast<double>(all))
        {
            best = static_cast<double>(fitting) / static_cast<double>(all);
            simulator.library = file;
            simulator.effects = effects.size();
            simulator.fitting = effects.size() - static_cast<std::size_t>(all - fitting);
            std::set<std::string> values;
            for (const auto& effect : effects)
            {
                if (const auto asked = effect.actsIn.find("medium"); asked != effect.actsIn.end())
                {
                    values.insert(asked->second.begin(), asked->second.end());
                }
            }
            simulator.tagValues.assign(values.begin(), values.end());
        }
    }
}

} // namespace

DraftedSimulator draftSimulator(const fs::path& folder)
{
    DraftedSimulator simulator;
    simulator.folder = fs::canonical(folder);
    if (!fs::is_regular_file(simulator.folder / "parameters") || !fs::is_regular_file(simulator.folder / "Allrun"))
    {
        throw std::runtime_error(folder.string()
                                 + " is not a case, which needs a file 'parameters' of lines 'name value;' and "
                                   "a program 'Allrun' that reads it");
    }
    simulator.entries = readEntries(simulator.folder / "parameters");
    simulator.observable = observableOf(simulator.folder);
    simulator.hasSteps = fs::exists(simulator.folder / "step.dry") && fs::exists(simulator.folder / "step.submerged");
    chooseLibrary(simulator);
    return simulator;
}

} // namespace clepsydra::identification
