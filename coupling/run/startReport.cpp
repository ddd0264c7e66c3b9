#include "run/startReport.h"

#include "runTimeSelection.h"

#include "foamVersion.H"

#include <clepsydra/version.h>

#include <iomanip>
#include <sstream>

namespace clepsydra
{

namespace
{

/// LIGGGHTS recommends 0.1 to 0.2 of the collision time.
constexpr double maxCollisionFraction = 0.2;

/// One line: the time scale, the fraction of it that the step is, and whether that is below the limit.
std::string scaleLine(
    const std::string& name, const std::optional<double>& scale, const std::string& stepName, double step, double limit)
{
    std::ostringstream line;
    line << "    " << std::left << std::setw(40) << name << std::right;
    if (!scale)
    {
        line << "not known";
        return line.str();
    }
    const double share = step / *scale;
    line << std::setprecision(4) << std::setw(10) << *scale << " s   " << stepName << " is " << std::setprecision(3)
         << share << " of it, " << (share <= limit ? "respected" : "NOT RESPECTED") << " (limit " << limit << ')';
    return line.str();
}

double maxRayleighFraction(const dictionary& demDict)
{
    return demDict.found("maxRayleighFraction") ? positiveEntry(demDict, "maxRayleighFraction") : 0.4;
}

} // namespace

void printStartReport(const DemEngine& engine, const std::vector<std::string>& models,
    const std::vector<std::string>& equations, const DemTimeScales& scales, const dictionary& demDict)
{
    Info << "Versions\n"
         << "    Clepsydra " << version << ", commit " << gitCommit << nl << "    OpenFOAM v" << foamVersion::api
         << " patch " << foamVersion::patch.c_str() << nl << "    " << engine.version().c_str() << nl << nl << "Models"
         << nl;
    for (const std::string& model : models)
    {
        Info << "    " << model.c_str() << nl;
    }
    Info << nl << "Equations" << nl;
    for (const std::string& line : equations)
    {
        Info << "    " << line.c_str() << nl;
    }

    std::ostringstream speed;
    speed << " at " << DemTimeScales::speed << " m/s";
    const auto print = [](const std::string& line) { Info << line.c_str() << nl; };
    Info << nl << "Time scales (DEM step " << scales.demStep << " s, coupling step " << scales.couplingTimeStep
         << " s, " << Foam::label(scales.particles) << " particles)" << nl;
    print(scaleLine("Rayleigh time", scales.rayleigh, "DEM step", scales.demStep, maxRayleighFraction(demDict)));
    print(scaleLine(
        "Collision (Hertz)" + speed.str(), scales.collision, "DEM step", scales.demStep, maxCollisionFraction));
    print(scaleLine(
        "Particle's relaxation by drag" + speed.str(), scales.relaxation, "coupling step", scales.couplingTimeStep, 1));
    print(scaleLine("Courant limit" + speed.str(), scales.courant, "coupling step", scales.couplingTimeStep, 1));
    Info << endl;
}

void checkDemStep(const DemTimeScales& scales, const dictionary& demDict)
{
    const double limit = maxRayleighFraction(demDict);
    if (scales.rayleigh && scales.demStep > limit * (*scales.rayleigh))
    {
        FatalIOErrorInFunction(demDict) << "The DEM step is above the stable one: the script "
                                        << demDict.getOrDefault<fileName>("script", "").c_str() << " sets "
                                        << scales.demStep << " s, which is " << scales.demStep / (*scales.rayleigh)
                                        << " of the Rayleigh time of " << *scales.rayleigh << " s; allowed: at most "
                                        << limit * (*scales.rayleigh) << " s, because entry 'maxRayleighFraction' is "
                                        << limit << exit(FatalIOError);
    }
}

} // namespace clepsydra
