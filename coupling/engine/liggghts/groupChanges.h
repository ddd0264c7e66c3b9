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

/// Particles that have sunk below a height change from one group of the LIGGGHTS script to another, for good.
///
/// The script says what a group is good for, and so what a run can be spared: a wall that only particles above it can touch
/// acts on their group alone; particles that lie still for the rest of the run need no integration and no contacts with
/// each other (`neigh_modify exclude group resting resting`). They keep their volume, their drag and their contacts
/// with particles that move.
struct GroupChange
{
    /// What it rests on: a particle that has been slow for a while.
    struct Rest
    {
        double speed;    // [m/s], of its centre and, by rotation, of its surface
        double duration; // [s]
    };

    std::string name;
    std::string from;
    std::string to;
    double below; // height of the centre, z [m]
    /// Where given, only particles at rest change, and they are stopped.
    std::optional<Rest> rest;
};

/// Carries out one GroupChange in a running LIGGGHTS.
class GroupChanger
{
public:
    /// \throws DemEngineError where the script has no such group.
    GroupChanger(LAMMPS_NS::LAMMPS& program, const GroupChange& change);

    /// The command that makes the property in which particles carry the time that they have been at rest, from rank to rank
    /// and through checkpoints; empty where none is needed. To be given to LIGGGHTS before the first apply().
    std::string propertyCommand() const;

    /// To be called between two runs of LIGGGHTS, `elapsed` seconds after the last call. Local.
    /// \throws DemEngineError if a particle is in both groups or in none: the script's fixes would act twice, or not at all.
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
