#include "run/equations.h"

#include "closures/parcelScaling.h"

#include <iomanip>
#include <sstream>

namespace clepsydra
{

using namespace Foam;

namespace
{

std::string lineOf(const std::string& what, const std::string& text)
{
    std::ostringstream line;
    line << std::left << std::setw(20) << what << text;
    return line.str();
}

std::string continuity(const CouplingSettings& settings)
{
    if (!settings.ddtVoidFraction())
    {
        return "div(eps U) = 0";
    }
    std::ostringstream text;
    text << "d(eps)/dt + div(eps U) = 0";
    if (settings.ddtSmoothingTime() > 0)
    {
        text << ", eps in d(eps)/dt low-pass filtered over " << settings.ddtSmoothingTime() << " s";
    }
    return text.str();
}

std::string stress(const FluidProperties& fluid)
{
    std::ostringstream text;
    text << "tau = " << (fluid.turbulence.empty() ? "mu" : "(mu + rho_f nut)")
         << " (grad(U) + grad(U)^T - 2/3 div(U) I), mu = " << fluid.dynamicViscosity << " Pa s"
         << (fluid.stratification.isThere() ? " in the lower liquid, stratified" : "");
    if (!fluid.turbulence.empty())
    {
        text << ", nut: " << fluid.turbulence << " with the void fraction in its equations";
    }
    return text.str();
}

/// The term of a force as it is in the equation of motion: in model B, forces whose reaction is a source of the fluid
/// are divided by the void fraction.
std::string termIn(ModelType modelType, const ForceModel& force)
{
    const std::string term = force.term();
    if (modelType == ModelType::A)
    {
        return term;
    }
    switch (textOf(force.family()).reaction)
    {
        case ReactionPlace::source:
            return term.substr(0, 1) + " 1/eps" + term.substr(1);
        case ReactionPlace::ofOwnKind:
            return term + ", divided by eps where its reaction is a source of the fluid";
        case ReactionPlace::inFluid:
        case ReactionPlace::mutual:
        case ReactionPlace::couple:
            break;
    }
    return term;
}

std::string reactionOf(const ForceModel& force)
{
    switch (textOf(force.family()).reaction)
    {
        case ReactionPlace::source:
            return "reaction in S";
        case ReactionPlace::inFluid:
            return force.family() == ForceFamily::buoyancy ? "reaction on the tank" : "reaction in - eps grad(p)";
        case ReactionPlace::mutual:
            return "reaction on the other particle or the wall";
        case ReactionPlace::couple:
            return "reaction in S, as 1/2 curl of the torque per volume";
        case ReactionPlace::ofOwnKind:
            break;
    }
    return "reaction as the model states";
}

/// A line on a force or a torque of the fluid.
std::string lineOfTerm(const ForceModel& force, const std::string& name, ModelType modelType)
{
    std::ostringstream line;
    line << "    " << std::left << std::setw(36) << termIn(modelType, force) << ' ' << textOf(force.family()).name
         << ": " << name << ", " << reactionOf(force);
    return lineOf("", line.str());
}

/// What a sphere of the DEM script is; empty where it is a particle.
std::vector<std::string> parcels(double coarseGraining, bool hasFluid)
{
    if (coarseGraining == 1)
    {
        return {};
    }
    std::ostringstream text;
    text << "each sphere of the DEM script stands for " << closures::particlesPerParcel(coarseGraining)
         << " particles with its diameter divided by " << coarseGraining;
    std::vector<std::string> lines = {lineOf("parcels", text.str())};
    if (hasFluid)
    {
        lines.push_back(lineOf("", "a term of the fluid below is that on one of these particles, times their number"));
    }
    return lines;
}

void addForces(const ParticleForces& forces, ModelType modelType, std::vector<std::string>& lines)
{
    std::vector<std::string> leftOut;
    std::vector<std::string> torques;
    for (label i = 0; i < forces.models().size(); ++i)
    {
        const ForceModel& force = forces.models()[i];
        const std::string name = forces.names()[i];
        const ForceFamilyText& text = textOf(force.family());
        if (force.isLeftOut())
        {
            leftOut.push_back(lineOf("left out", std::string(text.term) + ", " + text.name + ", by " + name
                                                     + (force.family() == ForceFamily::pressureGradient
                                                             ? "; momentum is not conserved, because the fluid's "
                                                               "equation keeps - eps grad(p)"
                                                             : "")));
            continue;
        }
        (force.family() == ForceFamily::torque ? torques : lines).push_back(lineOfTerm(force, name, modelType));
    }
    if (!torques.empty())
    {
        lines.push_back(lineOf("", "I domega/dt = torques of the DEM script (contacts)"));
        lines.insert(lines.end(), torques.begin(), torques.end());
    }
    lines.insert(lines.end(), leftOut.begin(), leftOut.end());
}

void addTemperatures(const ThermalProperties& fluid, bool turbulent, std::vector<std::string>& lines)
{
    lines.push_back(
        lineOf("temperature", std::string("rho_f Cp (d(eps T)/dt + div(eps U T)) = div(eps ")
                                  + (turbulent ? "(kappa + rho_f Cp nut/Prt)" : "kappa") + " grad(T)) - Q"));
    std::ostringstream values;
    values << "Cp = " << fluid.specificHeat << " J/(kg K), kappa = " << fluid.conductivity << " W/(m K)";
    if (turbulent)
    {
        values << ", Prt = " << fluid.turbulentPrandtlNumber;
    }
    lines.push_back(lineOf("", values.str()));
    lines.push_back(lineOf("", "Q: h A (T - T_p), summed over the particles, per volume"));
    if (fluid.expansion > 0)
    {
        std::ostringstream buoyancy;
        buoyancy << "momentum also has - eps rho_f beta (T - TRef) g, beta = " << fluid.expansion
                 << " 1/K, TRef = " << fluid.referenceTemperature << " K";
        lines.push_back(lineOf("", buoyancy.str()));
    }
    lines.push_back(lineOf("of a particle", "m Cp_p dT_p/dt = h A (T - T_p) + heat of the DEM script (contacts)"));
}

} // namespace

std::vector<std::string> equations(const CouplingSettings& settings, const FluidProperties& fluid,
    const ParticleForces* forces, const std::optional<Energy>& energy)
{
    const std::string motion = "m dv/dt = forces of the DEM script (contacts, gravity)";
    const std::vector<std::string> ofParcels = parcels(settings.coarseGraining(), forces != nullptr);
    const std::string ofSphere = lineOf(ofParcels.empty() ? "particle" : "parcel", motion);
    if (forces == nullptr)
    {
        std::vector<std::string> lines = ofParcels;
        lines.push_back(ofSphere);
        return lines;
    }
    const bool isA = settings.modelType() == ModelType::A;
    std::vector<std::string> lines = {lineOf("continuity", continuity(settings)),
        lineOf("momentum", std::string("rho_f eps (dU/dt + U . grad(U)) = ") + (isA ? "- eps grad(p)" : "- grad(p)")
                               + " + div(tau) - S"),
        lineOf("", stress(fluid)),
        lineOf("", "S: the terms below whose reaction is in S, summed over the particles, per volume"),
        lineOf("", "p [Pa]: without its hydrostatic part; the field p is p/rho_f")};
    lines.insert(lines.end(), ofParcels.begin(), ofParcels.end());
    lines.push_back(ofSphere);
    addForces(*forces, settings.modelType(), lines);
    if (energy)
    {
        addTemperatures(energy->fluid, !fluid.turbulence.empty(), lines);
    }
    return lines;
}

} // namespace clepsydra
