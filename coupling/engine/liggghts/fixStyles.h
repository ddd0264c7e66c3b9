#pragma once

#include "engine/liggghts/liggghtsProgram.h"

#include <string>

namespace LAMMPS_NS
{
class Fix;
class LAMMPS;
} // namespace LAMMPS_NS

namespace clepsydra
{

/// Creates a fix from the tokens of its command.
using FixCreator = LAMMPS_NS::Fix* (*)(LAMMPS_NS::LAMMPS* program, int count, char** tokens);

/// Adds a style of fix that scripts can have, or takes the place of LIGGGHTS' fix of this style.
void setFixStyle(LiggghtsProgram& program, const std::string& style, FixCreator creator);

} // namespace clepsydra
