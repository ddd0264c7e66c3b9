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

    /// The image of a particle's position that lies in the engine's box [m].
    Vector3d positionInBox(Eigen::Index particle) const
    {
        return engine_.periodicBox().wrapped(engine_.particles().position.col(particle));
    }

    /// See DemEngine::unwrappedPosition().
    Vector3d unwrappedPosition(Eigen::Index particle) const
    {
        return engine_.unwrappedPosition(particle);
    }

    bool writeData(Foam::Ostream&) const override
    {
        return true;
    }

private:
    DemEngine& engine_;
};

} // namespace clepsydra
