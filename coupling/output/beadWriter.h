#pragma once

#include "engine/beads.h"

#include "Time.H"

#include <memory>

namespace clepsydra
{

class VtkSeries;

/// Writes the beads for ParaView: <case>/VTK/beads_<time>.vtp and the time series <case>/VTK/beads.pvd, which opens
/// beside OpenFOAM's fields. A restart goes on with the series; see VtkSeries.
///
/// FatalError naming the file where one cannot be written.
class BeadWriter
{
public:
    /// Local. Touches no file before the first write, apart from reading the series.
    explicit BeadWriter(const Foam::Time& time);
    ~BeadWriter();

    /// Collective: gathers the beads of all ranks, sorted by id, and the master writes them. \param time  [s]
    void write(const BeadsView& beads, double time);

private:
    Foam::fileName folder_;
    /// On the master only.
    std::unique_ptr<VtkSeries> series_;
};

} // namespace clepsydra
