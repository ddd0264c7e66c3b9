#pragma once

#include "engine/demEngine.h"

#include "objectRegistry.H"
#include "regIOobject.H"

namespace clepsydra
{

/// Gives function objects access to the particles. The object is registered with the mesh's database under the name
/// "particles". A user's function object obtains them by
///
///     mesh_.lookupObject<clepsydra::ObservedParticles>(clepsydra::ObservedParticles::registryName).particles()
class ObservedParticles : public Foam::regIOobject
{
public:
    static constexpr const char* registryName = "particles";

    ObservedParticles(const Foam::objectRegistry& database, DemEngine& engine)
        : regIOobject(Foam::IOobject(registryName, database.time().timeName(), database)),
          engine_(engine)
    {}

    /// The particles of this rank at the end of the last coupling step.
    ParticlesView particles() const
    {
        return engine_.particles();
    }

    bool writeData(Foam::Ostream&) const override
    {
        return true;
    }

private:
    DemEngine& engine_;
};

} // namespace clepsydra
