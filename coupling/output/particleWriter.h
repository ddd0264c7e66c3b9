#pragma once

#include "engine/particles.h"

#include "Time.H"

#include <filesystem>
#include <memory>

namespace clepsydra
{

class VtkSeries;

/// Writes the particles for ParaView: <case>/VTK/particles_<time>.vtp and the time series <case>/VTK/particles.pvd, which opens
/// beside OpenFOAM's fields. A restart goes on with the series; see VtkSeries.
///
/// FatalError on all ranks, naming the file, where one cannot be written.
class ParticleWriter
{
public:
    /// Collective. Touches no file before the first write, apart from reading the series.
    explicit ParticleWriter(const Foam::Time& time);
    ~ParticleWriter();

    /// Collective: each rank writes its own particles into the one file. No rank has those of another. \param time  [s]
    void write(const ParticlesView& particles, double time);

private:
    std::filesystem::path folder_;
    /// On the master only.
    std::unique_ptr<VtkSeries> series_;
};

} // namespace clepsydra
