#pragma once

#include "engine/particles.h"

#include <string>

namespace clepsydra
{

/// A rank's part of a file of the particles for ParaView (.vtp, binary): VTK reads as many pieces as there are in it. The
/// parts of all ranks, one after the other, are the file. Each but the last ends at a multiple of `pageSize`, for file
/// systems of networks keep files by pages, and two ranks that write to the same page may each undo what the other wrote.
///
/// A piece has the particles as vertices, sorted by id, with point data id, radius, velocity, angularVelocity, voidFraction
/// (of the fluid at the particle; 1 without fluid) and speed. \throws std::runtime_error where VTK cannot make it.
std::string partOfVtp(const ParticlesView& particles, bool first, bool last);

constexpr std::size_t pageSize = 4096;

} // namespace clepsydra
