#include "forces/forceFamily.h"

#include <set>

namespace clepsydra
{

namespace
{

/// Created at first use, because it is filled before main() starts.
std::map<ForceFamily, std::set<std::string>>& namesByFamily()
{
    static std::map<ForceFamily, std::set<std::string>> names;
    return names;
}

} // namespace

const ForceFamilyText& textOf(ForceFamily family)
{
    static const std::map<ForceFamily, ForceFamilyText> texts = {
        {ForceFamily::drag, {"drag", "+ S_p (U - v)", ReactionPlace::source, "noDrag"}},
        {ForceFamily::pressureGradient,
            {"pressure gradient", "- V_p grad(p)", ReactionPlace::inFluid, "noPressureGradient"}},
        {ForceFamily::viscousStress, {"viscous stress", "+ V_p div(tau)", ReactionPlace::source, "noViscousStress"}},
        {ForceFamily::buoyancy, {"buoyancy", "- rho_f V_p g", ReactionPlace::inFluid, "noBuoyancy"}},
        {ForceFamily::addedMass, {"added mass", "+ m_a (DU/Dt - dv/dt)", ReactionPlace::source, ""}},
        {ForceFamily::history, {"history force", "- C_h int K(t - s) d(v - U)/ds ds", ReactionPlace::source, ""}},
        {ForceFamily::shearLift, {"lift in shear", "+ C_s (U - v) x curl(U)", ReactionPlace::source, ""}},
        {ForceFamily::rotationLift,
            {"lift by rotation", "+ C_r (U - v) x (omega - curl(U)/2)", ReactionPlace::source, ""}},
        {ForceFamily::lubrication, {"lubrication", "- c v_n", ReactionPlace::mutual, ""}},
        {ForceFamily::torque, {"torque", "+ C_t (curl(U)/2 - omega)", ReactionPlace::couple, ""}},
        {ForceFamily::other, {"other force", "+ F", ReactionPlace::ofOwnKind, ""}}};
    return texts.at(family);
}

ForceLines::ForceLines(ForceFamily family, std::initializer_list<std::pair<const char*, const char*>> lines)
    : ModelLines("forceModels", lines)
{
    for (const Foam::word& name : names())
    {
        namesByFamily()[family].insert(name);
    }
}

Foam::wordList ForceLines::namesOf(ForceFamily family)
{
    Foam::wordList names;
    for (const std::string& name : namesByFamily()[family])
    {
        names.append(Foam::word(name));
    }
    return names;
}

} // namespace clepsydra
