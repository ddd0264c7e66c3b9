#include "run/costModel.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <stdexcept>

namespace clepsydra
{

std::optional<CostModel> CostModel::read(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    if (!stream)
    {
        return std::nullopt;
    }
    try
    {
        const nlohmann::json entries = nlohmann::json::parse(stream);
        CostModel model;
        model.perBeadStep = entries.at("perBeadStep");
        model.perBead = entries.at("perBead");
        model.perCell = entries.at("perCell");
        model.perCell43 = entries.at("perCell43");
        model.serialFraction = entries.at("serialFraction");
        model.machine = entries.at("machine");
        return model;
    }
    catch (const nlohmann::json::exception& error)
    {
        throw std::runtime_error(file.string() + ": " + error.what()
                                 + "; allowed: numbers perBeadStep, perBead, perCell, perCell43, serialFraction and a "
                                   "text machine, as scripts/benchmark writes them");
    }
}

double CostModel::seconds(const RunWork& work, int ranks) const
{
    const double perInterval = perBead * work.beads + perCell * work.cells + perCell43 * std::pow(work.cells, 4. / 3);
    const double oneRank = perBeadStep * work.beads * work.demSteps + perInterval * work.intervals;
    return oneRank * (serialFraction + (1 - serialFraction) / ranks);
}

} // namespace clepsydra
