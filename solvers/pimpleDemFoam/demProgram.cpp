#include "demProgram.h"

namespace clepsydra
{

defineTypeNameAndDebug(DemProgram, 0);
defineRunTimeSelectionTable(DemProgram, settings);

Foam::autoPtr<DemProgram> DemProgram::New(const CouplingSettings& settings, bool writesNothing)
{
    const dictionary& dem = settings.demDict();
    const word name = dem.getOrDefault<word>("engine", "liggghts");
    requireKnownName(dem, "engine", name, settingsConstructorTablePtr_->sortedToc());
    return (*settingsConstructorTablePtr_)[name](settings, writesNothing);
}

} // namespace clepsydra
