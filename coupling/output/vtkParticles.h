#pragma once

#include "engine/particles.h"

#include <string>

namespace clepsydra
{

/// A rank's part of a file of the particles for ParaView (.vtp, binary); VTK reads any number of pieces in a file. The
/// parts of all ranks, one after the other, form the file. Each part but the last ends at a multiple of `pageSize`,
/// because network file systems cache files by pages, and two ranks that write to the same page could overwrite each
/// other's data.
///
/// A piece holds the particles as vertices, sorted by id, with the point data id, radius, velocity, angularVelocity,
/// voidFraction (of the fluid at the particle; 1 without fluid) and speed.
/// \throws std::runtime_error where VTK cannot create it
/// \param temperatures  of the particles [K], which then are point data, too; null where they have none
std::string partOfVtp(const ParticlesView& particles, bool first, bool last, const double* temperatures = nullptr);

constexpr std::size_t pageSize = 4096;

} // namespace clepsydra
