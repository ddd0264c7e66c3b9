#pragma once

#include "engine/particles.h"

#include "Time.H"

#include <filesystem>
#include <memory>

namespace clepsydra
{

class VtkSeries;

/// Writes the particles for ParaView: <case>/VTK/particles_<time>.vtp and the time series <case>/VTK/particles.pvd,
/// which can be opened together with OpenFOAM's fields. A resumed run continues the series; see VtkSeries.
///
/// FatalError on all ranks, which names the file, where one cannot be written.
class ParticleWriter
{
public:
    /// Reads the series and writes no file before the first write(). Collective.
    explicit ParticleWriter(const Foam::Time& time);
    ~ParticleWriter();

    /// Writes the particles of all ranks into one file. Each rank writes its own part; no rank receives the particles
    /// of others. Collective. \param time  [s]
    void write(const ParticlesView& particles, double time, const double* temperatures = nullptr);

private:
    std::filesystem::path folder_;
    /// Null except on the master rank.
    std::unique_ptr<VtkSeries> series_;
};

} // namespace clepsydra
