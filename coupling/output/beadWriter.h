#pragma once

#include "engine/beads.h"

#include "Time.H"

#include <filesystem>
#include <memory>

namespace clepsydra
{

class VtkSeries;

/// Writes the beads for ParaView: <case>/VTK/beads_<time>.vtp and the time series <case>/VTK/beads.pvd, which opens
/// beside OpenFOAM's fields. A restart goes on with the series; see VtkSeries.
///
/// FatalError on all ranks, naming the file, where one cannot be written.
class BeadWriter
{
public:
    /// Collective. Touches no file before the first write, apart from reading the series.
    explicit BeadWriter(const Foam::Time& time);
    ~BeadWriter();

    /// Collective: each rank writes its own beads into the one file. No rank has those of another. \param time  [s]
    void write(const BeadsView& beads, double time);

private:
    std::filesystem::path folder_;
    /// On the master only.
    std::unique_ptr<VtkSeries> series_;
};

} // namespace clepsydra
