#pragma once

#include "checkpoint/checkpoints.h"
#include "couplingStep/couplingSettings.h"
#include "engine/demEngine.h"
#include "forces/fluidProperties.h"
#include "runTimeSelection.h"

#include "volFields.H"

#include <filesystem>
#include <vector>

namespace clepsydra
{

/// The DEM program of a case, selected by the entry `engine` of the dictionary DEM. The engine itself knows no OpenFOAM;
/// this is the part of it that reads the case and checks whether the program's input fits to the fluid.
class DemProgram
{
public:
    TypeName("demProgram");

    declareRunTimeSelectionTable(Foam::autoPtr, DemProgram, settings,
        (const CouplingSettings& settings, bool writesNothing), (settings, writesNothing))

        /// Reads the entries of the program that is selected. FatalIOError where it is unknown.
        /// \param writesNothing  true where the engine must not write files
        static Foam::autoPtr<DemProgram> New(const CouplingSettings& settings, bool writesNothing);

    virtual ~DemProgram() = default;

    /// The files that a resumed run reads again.
    virtual std::vector<std::filesystem::path> inputs() const = 0;

    /// Starts the engine, from the checkpoint where the run is resumed. FatalError or FatalIOError where its input does not
    /// fit to the case. Collective.
    /// \param meshMoves  whether checkMovedWalls() will be called, so that nothing is known of the walls' motion yet
    /// \param fluid  null for DEM only
    virtual DemEngine& start(
        const Checkpoints& checkpoints, const Foam::fvMesh& mesh, bool meshMoves, const FluidProperties* fluid) = 0;

    /// Compares the walls of the program with those of the fluid, when both have moved by a coupling step. FatalError or
    /// FatalIOError where they do not move alike. Collective.
    virtual void checkMovedWalls(const Foam::volVectorField& U) = 0;

    /// Warns of input that has no effect. Collective. \pre the engine is initialised
    virtual void warnOfUnreadInput() const = 0;
};

} // namespace clepsydra
