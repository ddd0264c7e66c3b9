#include "tokens/renamed.h"

#include <map>

namespace clepsydra
{

const Renamed* renamed(const std::string& word)
{
    static const std::map<std::string, Renamed> table = {
        // constant/couplingProperties
        {"couplingInterval",
            {"couplingTimeStep",
                "In CFDEMcoupling couplingInterval counts DEM steps; couplingTimeStep is a time [s], equal to deltaT"}},
        {"smoothingLength",
            {"bandwidth",
                "In CFDEMcoupling smoothingLength is half of the bandwidth b [m] of the kernel exp(-r^2/b^2)"}},
        {"adjustableInterval", {"adjustableCouplingTimeStep", ""}},
        {"minInterval", {"minCouplingTimeStep", ""}},
        {"maxInterval", {"maxCouplingTimeStep", ""}},
        {"selfDisturbance", {"selfInducedVelocityCorrection", ""}},
        {"beadOutlets", {"particleOutlets", ""}},
        {"beadOutput", {"particleOutput", ""}},
        {"ledger", {"conservationCheck", ""}},
        // function objects and their entries
        {"beadHeight", {"particleHeight", ""}},
        {"beadFlux", {"particleFlux", ""}},
        {"bead", {"particle", ""}},
        // study files
        {"rig", {"simulator", ""}},
        // the DEM script
        {"forget_parted", {"tangential_reset", ""}},
        // the program closures
        {"--beadDiameter", {"--particleDiameter", ""}},
        {"--beadDensity", {"--particleDensity", ""}},
    };
    const auto found = table.find(word);
    return found == table.end() ? nullptr : &found->second;
}

} // namespace clepsydra
