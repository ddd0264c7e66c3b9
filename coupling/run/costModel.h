#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace clepsydra
{

/// What a run, or a part of it, consists of.
struct RunWork
{
    double beads;
    double cells; ///< of the fluid; 0 in a dry run
    double demSteps;
    double intervals; ///< of coupling; each is one time step of the fluid
};

/// Wall time of a run, estimated before it begins: on one rank
///
///     seconds = perBeadStep n_beads n_steps + (perBead n_beads + perCell n_cells + perCell43 n_cells^(4/3)) n_intervals
///
/// The last term is the pressure's: conjugate gradients need iterations in proportion to the cells along one side. On
/// more ranks Amdahl's law, with a part `serialFraction` that does not get faster.
///
/// The coefficients are measured and fitted by scripts/benchmark on one machine; elsewhere the estimate is off by the
/// ratio of the two machines.
class CostModel
{
public:
    double perBeadStep; // [s], as all of them
    double perBead;
    double perCell;
    double perCell43;
    double serialFraction;
    std::string machine; ///< where and when they were measured

    /// \return nothing where there is no such file.
    /// \throws std::runtime_error  naming file and entry that is missing or no number.
    static std::optional<CostModel> read(const std::filesystem::path& file);

    /// Estimated wall time [s].
    double seconds(const RunWork& work, int ranks) const;
};

} // namespace clepsydra
