// Prints values of the formulas of this folder, one number per line, so that scripts need no second implementation of a
// formula. Options have the names of the entries of a case's `parameters` and SI units. `closures <formula> --help`
// lists them.

#include "closures/beverloo.h"
#include "closures/dragLaws.h"
#include "closures/ergun.h"
#include "closures/nusselt.h"
#include "closures/polydisperseDrag.h"
#include "closures/richardsonZaki.h"
#include "closures/rotationTorque.h"
#include "closures/terminalVelocity.h"
#include "closures/wallCorrection.h"
#include "tokens/exactText.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace
{

using namespace clepsydra::closures;

/// Values of the options; each formula uses its own subset of them.
struct Input
{
    double particleDiameter = 0;
    double particleDensity = 0;
    double fluidDensity = 0;
    double fluidViscosity = 0; // kinematic, as in `parameters`
    double gravity = defaultGravity;
    std::vector<double> voidFraction;
    std::string dragLaw;
    std::string polydispersity;
    double sauterMeanDiameter = 0;
    std::vector<double> speed;
    double bulkDensity = 0;
    double orificeDiameter = 0;
    double ratio = 0;
    double gap = 0;
    double reynolds = 0;
    double prandtl = 0;

    double dynamicViscosity() const
    {
        return fluidDensity * fluidViscosity;
    }

    SettlingParticle settlingParticle(double eps = 1) const
    {
        return {particleDiameter, particleDensity, fluidDensity, dynamicViscosity(), gravity, eps};
    }

    double oneVoidFraction() const
    {
        return voidFraction.empty() ? 1 : voidFraction.front();
    }

    ParticleInFluid particleInFluid(double slipSpeed) const
    {
        return makeParticleInFluid(particleDiameter, oneVoidFraction(), slipSpeed, fluidDensity, dynamicViscosity());
    }

    PackedBed bed(double eps) const
    {
        return {particleDiameter, eps, fluidDensity, dynamicViscosity()};
    }
};

/// One formula of the program: a subcommand with its options.
class Formula
{
public:
    Formula(CLI::App& program, const std::string& name, const std::string& description)
        : command_(program.add_subcommand(name, description))
    {}

    Formula& particle()
    {
        return positive("--particleDiameter", input_->particleDiameter, "[m]");
    }

    Formula& particleDensity()
    {
        return positive("--particleDensity", input_->particleDensity, "[kg/m3]");
    }

    Formula& fluid()
    {
        return positive("--fluidDensity", input_->fluidDensity, "[kg/m3]")
            .positive("--fluidViscosity", input_->fluidViscosity, "kinematic [m2/s]");
    }

    Formula& gravity()
    {
        command_->add_option("--gravity", input_->gravity, "[m/s2]")->capture_default_str()->check(CLI::PositiveNumber);
        return *this;
    }

    Formula& settlingParticle()
    {
        return particle().particleDensity().fluid().gravity();
    }

    Formula& dragLaw()
    {
        command_->add_option("--dragLaw", input_->dragLaw, "its name; `closures dragLaws` lists them")
            ->required()
            ->check(CLI::IsMember(dragLawNames()));
        return *this;
    }

    Formula& polydispersity()
    {
        command_->add_option("--polydispersity", input_->polydispersity, "name of a law for mixtures")
            ->required()
            ->check(CLI::IsMember(polydispersityLawNames()));
        return positive("--sauterMeanDiameter", input_->sauterMeanDiameter, "of the mixture [m]");
    }

    Formula& voidFractions()
    {
        command_->add_option("--voidFraction", input_->voidFraction, "[-], one or more")
            ->required()
            ->check(CLI::Range(1e-6, 1.0));
        return *this;
    }

    Formula& oneVoidFraction()
    {
        command_->add_option("--voidFraction", input_->voidFraction, "[-]; default 1")
            ->expected(1)
            ->check(CLI::Range(1e-6, 1.0));
        return *this;
    }

    Formula& speeds(const std::string& name)
    {
        command_->add_option(name, input_->speed, "[m/s], one or more")->required()->check(CLI::NonNegativeNumber);
        return *this;
    }

    Formula& rotations()
    {
        command_->add_option("--rotation", input_->speed, "[rad/s], one or more")
            ->required()
            ->check(CLI::NonNegativeNumber);
        return *this;
    }

    Formula& positive(const std::string& name, double& value, const std::string& description)
    {
        command_->add_option(name, value, description)->required()->check(CLI::PositiveNumber);
        return *this;
    }

    Formula& fraction(const std::string& name, const std::string& description)
    {
        command_->add_option(name, input_->ratio, description)->required()->check(CLI::Range(0.0, 1.0));
        return *this;
    }

    Input& input()
    {
        return *input_;
    }

    /// Prints the values that the function computes from the input.
    void prints(const std::function<std::vector<double>(const Input&)>& values)
    {
        command_->callback([input = input_, values] {
            for (const double value : values(*input))
            {
                std::cout << clepsydra::exactText(value) << '\n';
            }
        });
    }

private:
    CLI::App* command_;
    std::shared_ptr<Input> input_ = std::make_shared<Input>();
};

std::vector<double> forEach(const std::vector<double>& arguments, const std::function<double(double)>& formula)
{
    std::vector<double> values(arguments.size());
    std::transform(arguments.begin(), arguments.end(), values.begin(), formula);
    return values;
}

void addDrag(CLI::App& program)
{
    program.add_subcommand("dragLaws", "Names of all drag laws")->callback([] {
        for (const std::string& name : dragLawNames())
        {
            std::cout << name << '\n';
        }
    });
    Formula(program, "drag", "Sp [kg/s] of model A's drag Sp (U_f - u_p) at each interstitial slip speed")
        .dragLaw()
        .particle()
        .fluid()
        .oneVoidFraction()
        .speeds("--slipSpeed")
        .prints([](const Input& in) {
            return forEach(in.speed, [&](double slip) { return dragLaw(in.dragLaw)(in.particleInFluid(slip)); });
        });
    Formula(program, "dragCoefficient", "C_d [-] = Sp/(pi/8 rho d^2 |U_r|), at each slip speed (> 0)")
        .dragLaw()
        .particle()
        .fluid()
        .oneVoidFraction()
        .speeds("--slipSpeed")
        .prints([](const Input& in) {
            const double scale = pi / 8 * in.fluidDensity * in.particleDiameter * in.particleDiameter;
            return forEach(
                in.speed, [&](double slip) { return dragLaw(in.dragLaw)(in.particleInFluid(slip)) / (scale * slip); });
        });
}

/// Sp in a mixture, with the law that the input names.
double namedPolydisperseDrag(const Input& in, double slipSpeed)
{
    double coefficient = 0;
    const auto compute = [&](const auto& law) {
        if (in.polydispersity == law.name)
        {
            coefficient =
                polydisperseDrag(law, dragLaw(in.dragLaw), in.particleInFluid(slipSpeed), in.sauterMeanDiameter);
        }
    };
    std::apply([&](const auto&... law) { (compute(law), ...); }, PolydispersityLaws{});
    return coefficient;
}

void addMixtures(CLI::App& program)
{
    Formula(program, "polydisperseDrag", "Sp [kg/s] of one particle of a mixture at each interstitial slip speed")
        .dragLaw()
        .polydispersity()
        .particle()
        .fluid()
        .oneVoidFraction()
        .speeds("--slipSpeed")
        .prints([](const Input& in) {
            return forEach(in.speed, [&](double slip) { return namedPolydisperseDrag(in, slip); });
        });
}

void addHeatAndRotation(CLI::App& program)
{
    Formula isolated(program, "ranzMarshallNusselt", "Nu [-] of an isolated particle, Ranz & Marshall 1952");
    isolated.positive("--reynolds", isolated.input().reynolds, "with the interstitial slip")
        .positive("--prandtl", isolated.input().prandtl, "[-]")
        .prints([](const Input& in) { return std::vector<double>{ranzMarshallNusselt(in.reynolds, in.prandtl)}; });
    Formula bed(program, "gunnNusselt", "Nu [-] of a particle in a bed or suspension, Gunn 1978");
    bed.positive("--reynolds", bed.input().reynolds, "with the superficial slip")
        .positive("--prandtl", bed.input().prandtl, "[-]")
        .oneVoidFraction()
        .prints([](const Input& in) {
            return std::vector<double>{gunnNusselt(in.reynolds, in.prandtl, in.oneVoidFraction())};
        });
    Formula(program, "rotationTorque", "Torque [N m] on a sphere at each speed of rotation, Dennis et al. 1980")
        .particle()
        .fluid()
        .rotations()
        .prints([](const Input& in) {
            return forEach(in.speed, [&](double rotation) {
                return rotation
                       * DennisTorque{}({in.particleDiameter, 0, rotation, in.fluidDensity, in.dynamicViscosity()});
            });
        });
}

void addSettling(CLI::App& program)
{
    Formula(program, "terminalVelocity", "Terminal velocity [m/s] of an isolated particle in fluid at rest")
        .dragLaw()
        .settlingParticle()
        .prints([](const Input& in) {
            return std::vector<double>{terminalVelocity(dragLaw(in.dragLaw), in.settlingParticle())};
        });
    Formula(program, "hinderedSettlingVelocity",
        "Settling velocity [m/s] relative to the vessel, which is also the superficial velocity that fluidises to it")
        .dragLaw()
        .settlingParticle()
        .voidFractions()
        .prints([](const Input& in) {
            return forEach(in.voidFraction,
                [&](double eps) { return hinderedSettlingVelocity(dragLaw(in.dragLaw), in.settlingParticle(eps)); });
        });

    Formula richardsonZaki(program, "richardsonZakiExponent", "n [-] of v/v_t = eps^n, Richardson & Zaki 1954");
    richardsonZaki.positive("--reynolds", richardsonZaki.input().reynolds, "of the isolated particle at v_t")
        .fraction("--diameterRatio", "particle diameter divided by column diameter")
        .prints([](const Input& in) { return std::vector<double>{richardsonZakiExponent(in.reynolds, in.ratio)}; });
    Formula rowe(program, "roweExponent", "n [-], smooth form of Rowe 1987");
    rowe.positive("--reynolds", rowe.input().reynolds, "of the isolated particle at v_t").prints([](const Input& in) {
        return std::vector<double>{roweExponent(in.reynolds)};
    });
}

void addWalls(CLI::App& program)
{
    Formula tube(program, "tubeVelocityRatio", "v/v_t [-] of a particle on the axis of a tube, Di Felice 1996");
    tube.fraction("--diameterRatio", "particle diameter divided by tube diameter")
        .positive("--reynolds", tube.input().reynolds, "of the free particle at v_t")
        .prints([](const Input& in) { return std::vector<double>{diFeliceWallVelocityRatio(in.ratio, in.reynolds)}; });
    Formula(program, "faxenParallelFactor", "drag divided by free drag [-], creeping motion parallel to a plane wall")
        .fraction("--lambda", "radius divided by the distance of the centre")
        .prints([](const Input& in) { return std::vector<double>{faxenParallelFactor(in.ratio)}; });
    Formula gap(program, "brennerPerpendicularFactor",
        "drag divided by free drag [-], creeping motion towards a plane wall, any gap");
    gap.positive("--gap", gap.input().gap, "between surface and wall, in radii").prints([](const Input& in) {
        return std::vector<double>{brennerPerpendicularFactor(in.gap)};
    });
}

void addBeds(CLI::App& program)
{
    Formula(program, "ergunPressureGradient", "Pressure drop [Pa/m] at each void fraction and superficial velocity")
        .particle()
        .fluid()
        .voidFractions()
        .speeds("--superficialVelocity")
        .prints([](const Input& in) {
            std::vector<double> values;
            for (const double eps : in.voidFraction)
            {
                for (const double speed : in.speed)
                {
                    values.push_back(ergunPressureGradient(in.bed(eps), speed));
                }
            }
            return values;
        });
    Formula(
        program, "minimumFluidisationVelocity", "Superficial velocity [m/s] by Ergun's equation at each void fraction")
        .settlingParticle()
        .voidFractions()
        .prints([](const Input& in) {
            return forEach(in.voidFraction,
                [&](double eps) { return minimumFluidisationVelocity(in.bed(eps), in.particleDensity, in.gravity); });
        });
}

void addHoppers(CLI::App& program)
{
    Formula dry(program, "beverlooRate", "Mass flow rate [kg/s] of a dry hopper, C = 0.58, k = 1.4");
    dry.particle()
        .positive("--bulkDensity", dry.input().bulkDensity, "of the flowing bed [kg/m3]")
        .positive("--orificeDiameter", dry.input().orificeDiameter, "[m]")
        .gravity()
        .prints([](const Input& in) {
            return std::vector<double>{
                beverlooRate(in.bulkDensity, in.gravity, in.orificeDiameter, in.particleDiameter)};
        });
    Formula submerged(program, "modifiedBeverlooRate",
        "Mass flow rate [kg/s] of a submerged hopper, v_t by the drag law, C = 0.4, k = 2.4");
    submerged.dragLaw()
        .settlingParticle()
        .positive("--orificeDiameter", submerged.input().orificeDiameter, "[m]")
        .prints([](const Input& in) {
            const double fall = terminalVelocity(dragLaw(in.dragLaw), in.settlingParticle());
            return std::vector<double>{
                modifiedBeverlooRate(in.particleDensity, fall, in.orificeDiameter, in.particleDiameter)};
        });
}

} // namespace

int main(int argc, char* argv[])
{
    try
    {
        CLI::App program(
            "Prints values of closure formulas, one number per line. All options have SI units.", "closures");
        program.require_subcommand(1);
        addDrag(program);
        addMixtures(program);
        addSettling(program);
        addWalls(program);
        addBeds(program);
        addHoppers(program);
        addHeatAndRotation(program);
        CLI11_PARSE(program, argc, argv);
    }
    catch (const std::exception& error)
    {
        std::cerr << "closures: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
