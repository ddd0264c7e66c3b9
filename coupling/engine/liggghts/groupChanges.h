#pragma once

#include <optional>
#include <string>
#include <vector>

namespace LAMMPS_NS
{
class FixPropertyAtom;
class LAMMPS;
} // namespace LAMMPS_NS

namespace clepsydra
{

/// A rule by which particles that have sunk below a height change from one group of the LIGGGHTS script to another,
/// permanently.
///
/// The script defines what the groups are used for, and thus what a run can save. A wall that only particles above it
/// can touch acts on their group alone. Particles that rest until the end of the run need neither integration nor
/// contacts with each other (`neigh_modify exclude group resting resting`); they keep their volume, their drag and
/// their contacts with particles that move.
struct GroupChange
{
    /// Definition of rest: the particle has been slow for some time.
    struct Rest
    {
        double speed;    // upper limit for its centre and, by rotation, for its surface [m/s]
        double duration; // [s]
    };

    std::string name;
    std::string from;
    std::string to;
    double below; // upper limit for the height z of its centre [m]
    /// Where it is given, only particles at rest change their group, and they are stopped.
    std::optional<Rest> rest;
};

/// Applies one GroupChange to a running LIGGGHTS.
class GroupChanger
{
public:
    /// \throws DemEngineError where the script has no such group
    GroupChanger(LAMMPS_NS::LAMMPS& program, const GroupChange& change);

    /// Command that creates the property with the time for which each particle has been at rest; it travels with the
    /// particle and is part of checkpoints. Empty where none is needed. Pass it to LIGGGHTS before the first apply().
    std::string propertyCommand() const;

    /// Call between two runs of LIGGGHTS. Local.
    /// \param elapsed  time since the last call [s]
    /// \throws DemEngineError where a particle is in both groups or in neither, because the script's fixes would act on
    /// it twice or not at all
    void apply(double elapsed);

private:
    int groupBit(const std::string& group) const;
    bool isSlow(int particle) const;
    void stop(int particle) const;

    LAMMPS_NS::LAMMPS& program_;
    GroupChange change_;
    int fromBit_;
    int toBit_;
    LAMMPS_NS::FixPropertyAtom* restTime_ = nullptr;
};

} // namespace clepsydra
