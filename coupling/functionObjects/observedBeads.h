#pragma once

#include "engine/demEngine.h"

#include "objectRegistry.H"
#include "regIOobject.H"

namespace clepsydra
{

/// Lets function objects see the beads: registered with the mesh's database under the name "beads".
/// A function object of one's own finds them by
///     mesh_.lookupObject<clepsydra::ObservedBeads>(clepsydra::ObservedBeads::registryName).beads()
class ObservedBeads : public Foam::regIOobject
{
public:
    static constexpr const char* registryName = "beads";

    ObservedBeads(const Foam::objectRegistry& database, DemEngine& engine)
        : regIOobject(Foam::IOobject(registryName, database.time().timeName(), database)),
          engine_(engine)
    {}

    /// The beads of this rank, at the end of the last coupling interval.
    BeadsView beads() const
    {
        return engine_.beads();
    }

    bool writeData(Foam::Ostream&) const override
    {
        return true;
    }

private:
    DemEngine& engine_;
};

} // namespace clepsydra
