/// \file
/// Which forces may stand beside which, and which the equations ask for. Two forces of one family add up, and a term that is
/// missing is missing from the result; neither is seen in a run.

// Before OpenFOAM, whose macro Log means something else.
#include <gmock/gmock.h>

#include "forcesOnParticles.h"

#include "support/errorOf.h"

#include <gtest/gtest.h>

namespace clepsydra::tests
{

namespace
{

using testing::AllOf;
using testing::HasSubstr;

std::string errorOfForces(const std::string& couplingProperties)
{
    return errorOf([&] { const ForcesOnParticles forces(couplingProperties); });
}

/// Error of a run with these forces, whose equations ask for some.
std::string errorOfRun(const std::string& modelType, const std::string& forces)
{
    const std::string text = "modelType " + modelType + "; forceModels (" + forces + ");";
    Foam::IStringStream stream(text);
    const Foam::dictionary dict(stream);
    const ForcesOnParticles all(text);
    return errorOf([&] { all.forces().requireAllTerms(dict); });
}

TEST(ForceFamilies, TwoModelsOfOneFamilyAreRefused)
{
    EXPECT_THAT(errorOfForces("forceModels (DiFeliceDrag Archimedes GidaspowDrag);"),
        AllOf(HasSubstr("'DiFeliceDrag' and 'GidaspowDrag'"), HasSubstr("add up"), HasSubstr("RongDrag")));
    EXPECT_THAT(errorOfForces("forceModels (MagnusLiftForce MagnusLiftForceOesterle);"), HasSubstr("lift by rotation"));
    EXPECT_THAT(errorOfForces("forceModels (DennisTorque StokesTorque);"), HasSubstr("torque"));
    EXPECT_THAT(errorOfForces("forceModels (noBuoyancy Archimedes);"), HasSubstr("leaves it out"));
}

/// Lifts of different kinds, and added mass beside the history force, are different terms.
TEST(ForceFamilies, ModelsOfDifferentFamiliesStandBesideEachOther)
{
    EXPECT_NO_THROW(ForcesOnParticles(
        "forceModels (SaffmanLiftForce MagnusLiftForce virtualMassForce historyForce DiFeliceDrag);"));
}

/// The program knows the family of each force model by name, and only of those.
TEST(ForceFamilies, EachModelHasOne)
{
    std::multiset<std::string> found = {"noDrag", "noPressureGradient", "noViscousStress", "noBuoyancy"};
    for (int family = 0; family <= static_cast<int>(ForceFamily::other); ++family)
    {
        for (const Foam::word& name : ForceLines::namesOf(static_cast<ForceFamily>(family)))
        {
            found.insert(name);
        }
    }
    const Foam::wordList all = ForceModel::dictionaryConstructorTablePtr_->sortedToc();
    EXPECT_EQ(found, std::multiset<std::string>(all.begin(), all.end()));
}

TEST(ForceFamilies, WhatIsMissingIsNamedWithWhatIsAllowed)
{
    EXPECT_THAT(errorOfRun("A", "DiFeliceDrag viscForce Archimedes"),
        AllOf(HasSubstr("no model of the pressure gradient, - V_p grad(p)"), HasSubstr("model A"),
            HasSubstr("(gradPForce noPressureGradient)")));
    EXPECT_THAT(errorOfRun("A", "DiFeliceDrag gradPForce viscForce"), HasSubstr("(Archimedes noBuoyancy)"));
    EXPECT_THAT(errorOfRun("A", "DiFeliceDrag gradPForce Archimedes"), HasSubstr("(viscForce noViscousStress)"));
    EXPECT_THAT(errorOfRun("A", "gradPForce viscForce Archimedes"),
        AllOf(HasSubstr("no model of the drag"), HasSubstr("DiFeliceDrag"), HasSubstr("noDrag")));
    EXPECT_THAT(errorOfRun("B", "DiFeliceDrag"), AllOf(HasSubstr("model B"), HasSubstr("(Archimedes noBuoyancy)")));
    EXPECT_THAT(errorOfRun("B", "Archimedes"), HasSubstr("noDrag"));
    EXPECT_THAT(errorOfRun("A", "lubricationForce); lubricationForceProps { roughness 1e-6; } other ("),
        AllOf(HasSubstr("drag"), HasSubstr("buoyancy"), HasSubstr("pressure gradient"), HasSubstr("viscous stress")));
}

TEST(ForceFamilies, WhatTheEquationsAskForIsEnough)
{
    EXPECT_EQ(errorOfRun("A", "DiFeliceDrag gradPForce viscForce Archimedes"), "");
    EXPECT_EQ(errorOfRun("A", "noDrag noPressureGradient noViscousStress noBuoyancy"), "");
    EXPECT_EQ(errorOfRun("B", "DiFeliceDrag Archimedes"), "");
    EXPECT_EQ(errorOfRun("B", "noDrag noBuoyancy"), "");
}

/// Faxen's factor and a lubrication force with a long reach both hold the wall's resistance beyond a fifth of a radius.
TEST(ForceFamilies, OneWallInTwoForcesIsRefused)
{
    const auto forces = [](const std::string& wallReach, const std::string& wallOfLubrication) {
        return "forceModels (StokesDrag lubricationForce); "
               "StokesDragProps { wallCorrection { law Faxen; walls ( ((0 0 0) (0 0 1)) ); } } "
               "lubricationForceProps { roughness 1e-6; wallReach "
               + wallReach + "; walls ( (" + wallOfLubrication + ") ); }";
    };
    EXPECT_THAT(errorOfForces(forces("1.25", "(5 3 0) (0 0 2)")), AllOf(HasSubstr("twice"), HasSubstr("wallReach")));
    EXPECT_NO_THROW(ForcesOnParticles(forces("0.1", "(0 0 0) (0 0 1)")));
    EXPECT_NO_THROW(ForcesOnParticles(forces("1.25", "(0 0 1) (0 0 -1)")));
}

/// Each term with its model. A list that is always the same would show gradPForce in model B, or Archimedes where it is left
/// out.
TEST(Equations, AreThoseOfModelA)
{
    EXPECT_THAT(printed("modelType A; forceModels (DiFeliceDrag gradPForce viscForce Archimedes virtualMassForce);"),
        AllOf(HasSubstr("d(eps)/dt + div(eps U) = 0"), HasSubstr("= - eps grad(p) + div(tau) - S"),
            testing::ContainsRegex("\\+ S_p \\(U - v\\) +drag: DiFeliceDrag, reaction in S"),
            testing::ContainsRegex("- V_p grad\\(p\\) +pressure gradient: gradPForce"),
            testing::ContainsRegex("\\+ V_p div\\(tau\\) +viscous stress: viscForce"),
            testing::ContainsRegex("- rho_f V_p g +buoyancy: Archimedes"),
            testing::ContainsRegex("m_a \\(DU/Dt - dv/dt\\) +added mass: virtualMassForce"),
            testing::Not(HasSubstr("left out"))));
}

TEST(Equations, AreThoseOfModelB)
{
    EXPECT_THAT(printed("modelType B; useDDTvoidfraction off; forceModels (RongDrag Archimedes);"),
        AllOf(HasSubstr("continuity          div(eps U) = 0"), HasSubstr("= - grad(p) + div(tau) - S"),
            testing::ContainsRegex("\\+ 1/eps S_p \\(U - v\\) +drag: RongDrag"),
            testing::ContainsRegex("- rho_f V_p g +buoyancy: Archimedes"), testing::Not(HasSubstr("V_p grad(p)"))));
}

TEST(Equations, SayWhatIsLeftOut)
{
    EXPECT_THAT(printed("modelType A; forceModels (DiFeliceDrag noPressureGradient viscForce noBuoyancy);"),
        AllOf(testing::ContainsRegex("left out +- V_p grad\\(p\\), pressure gradient, by noPressureGradient; momentum"),
            testing::ContainsRegex("left out +- rho_f V_p g, buoyancy, by noBuoyancy"),
            testing::Not(HasSubstr("Archimedes"))));
}

} // namespace

} // namespace clepsydra::tests
