// Compiled without fused multiply-add, so that rounding is the same as in LIGGGHTS, and without errno, so that square
// roots are vectorised: see CMakeLists.txt.
#include "engine/liggghts/hertzContactLaw.h"

#include "vectorUnits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clepsydra
{

namespace
{

/// Inlined into the functions below, each of which is compiled for several vector units.
template<bool rolls>
[[gnu::always_inline]] inline void evaluate(HertzContacts& contacts, double shearStep)
{
    constexpr double rootOfFiveSixths = 0.91287092917527685576161630466800355658790782499663875;
    constexpr double smallest = std::numeric_limits<double>::min();
    HertzContacts& c = contacts;
    const bool shears = shearStep > 0;
    for (std::size_t k = 0; k < c.count; ++k)
    {
        const double dx = c.distance[0][k];
        const double dy = c.distance[1][k];
        const double dz = c.distance[2][k];
        const double r = std::sqrt(dx * dx + dy * dy + dz * dz);
        const double rInverse = 1.0 / r;
        const double nx = dx * rInverse;
        const double ny = dy * rInverse;
        const double nz = dz * rInverse;
        const double mass = c.massI[k] * c.massJ[k] / (c.massI[k] + c.massJ[k]);

        // Relative velocity of the surfaces.
        const double normalVelocity = c.velocity[0][k] * nx + c.velocity[1][k] * ny + c.velocity[2][k] * nz;
        const double overlap = c.radiusI[k] + c.radiusJ[k] - r;
        const double armI = c.radiusI[k] - 0.5 * overlap;
        const double armJ = c.radiusJ[k] - 0.5 * overlap;
        const double wx = (armI * c.angularVelocityI[0][k] + armJ * c.angularVelocityJ[0][k]) * rInverse;
        const double wy = (armI * c.angularVelocityI[1][k] + armJ * c.angularVelocityJ[1][k]) * rInverse;
        const double wz = (armI * c.angularVelocityI[2][k] + armJ * c.angularVelocityJ[2][k]) * rInverse;
        const double tx = c.velocity[0][k] - normalVelocity * nx - (dz * wy - dy * wz);
        const double ty = c.velocity[1][k] - normalVelocity * ny - (dx * wz - dz * wx);
        const double tz = c.velocity[2][k] - normalVelocity * nz - (dy * wx - dx * wy);

        // Normal force.
        const double radius = c.radiusI[k] * c.radiusJ[k] / (c.radiusI[k] + c.radiusJ[k]);
        const double root = std::sqrt(radius * overlap);
        const double normalStiffness = 4. / 3. * c.youngsModulus[k] * root;
        const double tangentialStiffness = 8. * c.shearModulus[k] * root;
        const double twiceDamping = -2. * rootOfFiveSixths * c.damping[k];
        const double normalDamping = twiceDamping * std::sqrt(2. * c.youngsModulus[k] * root * mass);
        const double tangentialDamping = twiceDamping * std::sqrt(tangentialStiffness * mass);
        const double normalForce = -normalDamping * normalVelocity + normalStiffness * overlap;

        // Tangential displacement: integrated, and rotated with the contact.
        double sx = c.shear[0][k];
        double sy = c.shear[1][k];
        double sz = c.shear[2][k];
        const double grownX = sx + tx * shearStep;
        const double grownY = sy + ty * shearStep;
        const double grownZ = sz + tz * shearStep;
        const double along = grownX * nx + grownY * ny + grownZ * nz;
        sx = shears ? grownX - along * nx : sx;
        sy = shears ? grownY - along * ny : sy;
        sz = shears ? grownZ - along * nz : sz;

        // Tangential force: spring and dashpot, or friction, which also limits the displacement.
        const double springX = -(tangentialStiffness * sx);
        const double springY = -(tangentialStiffness * sy);
        const double springZ = -(tangentialStiffness * sz);
        const double spring = tangentialStiffness * std::sqrt(sx * sx + sy * sy + sz * sz);
        const double limit = c.friction[k] * std::fabs(normalForce);
        const bool slides = spring > limit;
        // Branches that are not taken are evaluated, too. They must not divide by zero, because OpenFOAM traps that.
        const double ratio = limit / std::max(std::max(spring, limit), smallest);
        const double frictionX = springX * ratio;
        const double frictionY = springY * ratio;
        const double frictionZ = springZ * ratio;
        const double fx = slides ? frictionX : springX - tangentialDamping * tx;
        const double fy = slides ? frictionY : springY - tangentialDamping * ty;
        const double fz = slides ? frictionZ : springZ - tangentialDamping * tz;
        const double divisor = std::max(tangentialStiffness, smallest);
        const double limitedX = -frictionX / divisor;
        const double limitedY = -frictionY / divisor;
        const double limitedZ = -frictionZ / divisor;
        const bool limitsShear = slides && shears;
        c.shear[0][k] = limitsShear ? limitedX : sx;
        c.shear[1][k] = limitsShear ? limitedY : sy;
        c.shear[2][k] = limitsShear ? limitedZ : sz;

        c.force[0][k] = normalForce * nx + fx;
        c.force[1][k] = normalForce * ny + fy;
        c.force[2][k] = normalForce * nz + fz;
        const double turnX = ny * fz - nz * fy;
        const double turnY = nz * fx - nx * fz;
        const double turnZ = nx * fy - ny * fx;
        double rollingX = 0;
        double rollingY = 0;
        double rollingZ = 0;
        if constexpr (rolls)
        {
            const double turningX = c.angularVelocityI[0][k] - c.angularVelocityJ[0][k];
            const double turningY = c.angularVelocityI[1][k] - c.angularVelocityJ[1][k];
            const double turningZ = c.angularVelocityI[2][k] - c.angularVelocityJ[2][k];
            const double turning = std::sqrt(turningX * turningX + turningY * turningY + turningZ * turningZ);
            const double size =
                c.rollingFriction[k] * normalStiffness * overlap * radius / (turning > 0 ? turning : 1.);
            rollingX = turningX * size;
            rollingY = turningY * size;
            rollingZ = turningZ * size;
            const double about = rollingX * nx + rollingY * ny + rollingZ * nz;
            rollingX -= nx * about;
            rollingY -= ny * about;
            rollingZ -= nz * about;
        }
        c.torqueI[0][k] = -armI * turnX - rollingX;
        c.torqueI[1][k] = -armI * turnY - rollingY;
        c.torqueI[2][k] = -armI * turnZ - rollingZ;
        c.torqueJ[0][k] = -armJ * turnX + rollingX;
        c.torqueJ[1][k] = -armJ * turnY + rollingY;
        c.torqueJ[2][k] = -armJ * turnZ + rollingZ;
    }
}

} // namespace

CLEPSYDRA_FOR_VECTOR_UNITS void evaluateHertz(HertzContacts& contacts, double shearStep)
{
    evaluate<false>(contacts, shearStep);
}

CLEPSYDRA_FOR_VECTOR_UNITS void evaluateHertzRolling(HertzContacts& contacts, double shearStep)
{
    evaluate<true>(contacts, shearStep);
}

} // namespace clepsydra
