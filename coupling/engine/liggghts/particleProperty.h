#pragma once

#include <string>
#include <vector>

namespace LAMMPS_NS
{
class FixPropertyAtom;
}

namespace clepsydra
{

class LiggghtsProgram;

/// Numbers that LIGGGHTS stores with each particle and that travel with it from rank to rank (`fix property/atom`).
class ParticleProperty
{
public:
    enum class InRestartFiles
    {
        no,
        yes
    };

    /// Whether the copies of particles on other ranks and across periodic boundaries have the numbers.
    enum class OnCopies
    {
        no,
        yes
    };

    /// Adds the property to LIGGGHTS. \pre the script has run
    /// \param ofNewParticle  the numbers of a particle that is created, inserted, or read from a file without them
    ParticleProperty(LiggghtsProgram& program, const std::string& name, const std::vector<double>& ofNewParticle,
        InRestartFiles inRestartFiles, OnCopies onCopies = OnCopies::no);

    /// A number that the script has given each particle. \pre the script has run and has it
    ParticleProperty(LiggghtsProgram& program, const std::string& name);

    /// The numbers of this rank's particles, one particle after another.
    double* values() const;

    /// Gives the copies, which follow the own particles in values(), the numbers of their particles. Collective.
    /// \pre OnCopies::yes
    void sendToCopies() const;

private:
    bool isScalar_;
    LAMMPS_NS::FixPropertyAtom* fix_;
};

} // namespace clepsydra
