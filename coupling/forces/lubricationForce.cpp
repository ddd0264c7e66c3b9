#include "closures/lubrication.h"
#include "forces/forceModel.h"
#include "forces/wallPlanes.h"

#include "addToRunTimeSelectionTable.H"

#include <algorithm>

namespace clepsydra
{

namespace
{

/// Lubrication force: fluid that is squeezed out between two particles, or a particle and a wall, resists their
/// approach; see closures/lubrication.h. The forces on the two are equal and opposite, and the fluid's equation
/// receives no reaction. They are multiplied by the submerged fraction, of two particles the smaller one.
///
///     lubricationForceProps
///     {
///         roughness 1e-6;     // gap at which the surfaces touch [m]
///         reach     0.1;      // gap beyond which the drag law has it all, in sums of the two radii; default 0.1
///         walls     ( ((0 0 0) (0 0 1)) );    // point and normal of each plane; default none
///         wallReach 1.25;     // reach at the walls, in diameters; default: the value of reach
///     }
///
/// The force is explicit in every DEM step, so the step must stay below m/(6 pi mu R_eff^2/roughness), which is 0.5 ms
/// for 2 mm glass beads at a wall in water with a roughness of 1 um. FatalError for DEM steps above half of it.
class LubricationForce : public ForceOf<ForceFamily::lubrication>
{
public:
    TypeName("lubricationForce");

    LubricationForce(const Foam::dictionary& coefficients, const FluidProperties& fluid)
        : fluid_(fluid),
          roughness_(positiveEntry(coefficients, "roughness")),
          reach_(coefficients.found("reach") ? positiveEntry(coefficients, "reach") : 0.1),
          wallReach_(coefficients.found("wallReach") ? positiveEntry(coefficients, "wallReach") : reach_),
          walls_(readWallPlanes(coefficients))
    {
        requireKnownEntries(coefficients, {"roughness", "reach", "wallReach", "walls"});
        if (coefficients.found("wallReach") && walls_.empty())
        {
            FatalIOErrorInFunction(coefficients)
                << "Entry 'wallReach' has no effect without 'walls'; allowed: "
                << "'walls ( ((point) (normal)) ... );' beside it, or no 'wallReach'" << Foam::exit(Foam::FatalIOError);
        }
    }

    void add(const ParticlesView& particles, ForceSum& sum) const override
    {
        addBetweenParticles(particles, sum);
        for (const WallPlane& wall : walls_)
        {
            addAtWall(wall, particles, sum);
        }
    }

    ForceNeeds needs() const override
    {
        ForceNeeds needs;
        needs.pairReach = reach_;
        return needs;
    }

    std::vector<WallPlane> resistingWalls() const override
    {
        // The correction of the drag is constant in smaller gaps; see WallCorrection.
        constexpr double largestBesideCorrectedDrag = 0.1;
        return wallReach_ > largestBesideCorrectedDrag ? walls_ : std::vector<WallPlane>();
    }

    Foam::string description() const override
    {
        return "lubricationForce: normal component, roughness " + Foam::name(roughness_) + " m, reach "
               + Foam::name(reach_) + " (R1 + R2), " + Foam::name(static_cast<Foam::label>(walls_.size()))
               + " walls with a reach of " + Foam::name(wallReach_) + " diameters";
    }

private:
    void addBetweenParticles(const ParticlesView& particles, ForceSum& sum) const
    {
        const ParticlePairs& near = particles.pairs;
        for (Eigen::Index pair = 0; pair < near.list.cols(); ++pair)
        {
            const int first = near.list(0, pair);
            const int second = near.list(1, pair);
            const double radii = near.radius[first] + near.radius[second];
            const Vector3d apart = near.position.col(second) - near.position.col(first);
            const double reach = reach_ * radii;
            if (apart.squaredNorm() >= (radii + reach) * (radii + reach))
            {
                continue;
            }
            requireReach("reach", reach);
            const double distance = apart.norm();
            const Vector3d normal = apart / distance;
            const double approach = (near.velocity.col(first) - near.velocity.col(second)).dot(normal);
            const double coefficient =
                std::min(near.ofState[first], near.ofState[second])
                * closures::squeezeCoefficient(fluid_.viscosityAt(near.position.col(first) + 0.5 * apart),
                    closures::effectiveRadius(near.radius[first], near.radius[second]), distance - radii, roughness_,
                    reach);
            requireStable(coefficient, particles.mass[first], sum.timeStep);
            const Vector3d force = coefficient * approach * normal;
            sum.mutual.col(first) -= force;
            // Otherwise the second particle is another rank's, which lists the pair with it as the first one.
            if (second < particles.size())
            {
                requireStable(coefficient, particles.mass[second], sum.timeStep);
                sum.mutual.col(second) += force;
            }
        }
    }

    void addAtWall(const WallPlane& wall, const ParticlesView& particles, ForceSum& sum) const
    {
        for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
        {
            const double radius = particles.radius[particle];
            const double reach = 2 * radius * wallReach_;
            requireReach("wallReach", reach);
            const double gap = wall.distance(particles.position.col(particle)) - radius;
            const double coefficient =
                particles.state[particle].fluid.submergedFraction
                * closures::wallSqueezeCoefficient(
                    fluid_.viscosityAt(particles.position.col(particle)), radius, gap, roughness_, reach);
            requireStable(coefficient, particles.mass[particle], sum.timeStep);
            sum.mutual.col(particle) -= coefficient * wall.normal.dot(particles.velocity.col(particle)) * wall.normal;
        }
    }

    /// Where the roughness exceeds the reach, no force ever acts.
    void requireReach(const char* entry, double reach) const
    {
        if (roughness_ >= reach)
        {
            FatalErrorInFunction << "lubricationForce would never act: the roughness of " << roughness_ << " m is not "
                                 << "below the distance of " << reach << " m that " << entry << " gives for these "
                                 << "particles; allowed: a smaller roughness or a larger " << entry
                                 << Foam::exit(Foam::FatalError);
        }
    }

    void requireStable(double coefficient, double mass, double timeStep) const
    {
        constexpr double largestPart = 0.5;
        if (coefficient * timeStep > largestPart * mass)
        {
            FatalErrorInFunction << "lubricationForce damps a particle of " << mass << " kg at the rate "
                                 << coefficient / mass << " 1/s, which is too fast for DEM steps of " << timeStep
                                 << " s; allowed: steps up to " << largestPart * mass / coefficient
                                 << " s, or a larger roughness than " << roughness_ << " m"
                                 << Foam::exit(Foam::FatalError);
        }
    }

    const FluidProperties fluid_;
    const double roughness_;
    const double reach_;
    const double wallReach_;
    const std::vector<WallPlane> walls_;
};

defineTypeNameAndDebug(LubricationForce, 0);
addToRunTimeSelectionTable(ForceModel, LubricationForce, dictionary);
const ForceLines lines(ForceFamily::lubrication,
    {{LubricationForce::typeName_(), "lubrication between particles and at walls (Cox 1974)"}});

} // namespace

} // namespace clepsydra
