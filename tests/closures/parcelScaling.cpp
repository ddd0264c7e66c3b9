/// \file
/// Coarse graining: what a parcel must have in common with the particles that it represents.

#include "closures/parcelScaling.h"

#include "relative.h"

#include "closures/stokesDrag.h"

namespace
{

using namespace clepsydra::closures;

/// Parcels of 3 times the size, .1 mm glass in water: 27 particles with the drag 27*3 pi*1e-3*1e-4 = 2.544690e-5 kg/s
/// and the mass 27*2500*5.235988e-13 kg; the parcel relaxes in 2500*1e-8/.018 = 1.388889e-3 s like the real particle.
/// The drag law with the parcel's diameter has nine times that time.
TEST(ParcelScaling, KeepsTheRelaxationTime)
{
    const ParticleInFluid real = makeParticleInFluid(1e-4, 1.0, 0.0, 1000.0, 1e-3);
    EXPECT_DOUBLE_EQ(particlesPerParcel(3.0), 27.0);
    const double drag = parcelDrag(StokesDrag{}, real, 3.0);
    EXPECT_RELATIVE(drag, 2.544690049e-5, 1e-9);
    const double parcelMass = 2500.0 * pi / 6.0 * 27e-12;
    EXPECT_RELATIVE(parcelMass / drag, 1.388888889e-3, 1e-9);
    const ParticleInFluid parcel = makeParticleInFluid(3e-4, 1.0, 0.0, 1000.0, 1e-3);
    EXPECT_RELATIVE(parcelMass / StokesDrag{}(parcel), 9.0 * 1.388888889e-3, 1e-9);
}

/// Duration and restitution of a collision of parcels by integrating m x'' = -k x - c x' from a contact of real
/// particles with m = k = 1, c = .3: a half-period of pi/sqrt(1 - .0225) = 3.177552 and the coefficient of restitution
/// exp(-.15*3.177552) = .620865, times the factors that the rules say. Spring and dashpot that are scaled otherwise
/// change one of the two.
TEST(ParcelScaling, KeepsTheRestitution)
{
    const double a = 2.0;
    for (const ParcelContact& contact : {bierwischContact(a), sakaiContact(a)})
    {
        const double mass = 8.0;
        double x = 0.0;
        double v = 1.0;
        double time = 0.0;
        const double step = 1e-5;
        while (time == 0.0 || x > 0.0)
        {
            v -= step / mass * (contact.springStiffness * x + 0.3 * contact.damping * v);
            x += step * v;
            time += step;
        }
        EXPECT_NEAR(-v, 0.620865, 1e-4);
        EXPECT_NEAR(time, 3.177552 * contact.collisionTime, 1e-3);
    }
    EXPECT_DOUBLE_EQ(bierwischContact(a).collisionTime, 2.0);
    EXPECT_DOUBLE_EQ(sakaiContact(a).collisionTime, 1.0);
}

/// Hertz' force is E sqrt(R) x^(3/2). With Bierwisch's rule twice the overlap of twice the radius gives four times the
/// force, i.e. the same stress; with Sakai's the same overlap gives eight times the force.
TEST(ParcelScaling, OfHertzContacts)
{
    EXPECT_DOUBLE_EQ(bierwischContact(2.0).hertzModulus * std::sqrt(2.0) * std::pow(2.0, 1.5), 4.0);
    EXPECT_DOUBLE_EQ(sakaiContact(2.0).hertzModulus * std::sqrt(2.0), 8.0);
}

/// A parcel of one particle is that particle.
TEST(ParcelScaling, OfOneParticleChangesNothing)
{
    for (const ParcelContact& contact : {bierwischContact(1.0), sakaiContact(1.0)})
    {
        EXPECT_EQ(contact.springStiffness, 1.0);
        EXPECT_EQ(contact.damping, 1.0);
        EXPECT_EQ(contact.hertzModulus, 1.0);
        EXPECT_EQ(contact.collisionTime, 1.0);
    }
}

} // namespace
