// Models of large eddies and of detached eddies; see rasModels.cpp.

#include "turbulence/modelTypes.h"

// What OpenFOAM's headers of detached eddies use and do not include.
#include "LESeddyViscosity.H"
#include "bound.H"
#include "wallDist.H"
#include "zeroGradientFvPatchFields.H"

#include "SpalartAllmarasDES.H"

#include "SpalartAllmarasDDES.H"
#include "SpalartAllmarasIDDES.H"
#include "Smagorinsky.H"
#include "WALE.H"
#include "dynamicKEqn.H"
#include "dynamicLagrangian.H"
#include "kEqn.H"
#include "kOmegaSSTDDES.H"
#include "kOmegaSSTDES.H"
#include "kOmegaSSTIDDES.H"

#define makeLESModel(Type) makeTemplatedTurbulenceModel(FluidTransportVoidFractionTurbulenceModel, LES, Type)

makeLESModel(Smagorinsky);
makeLESModel(WALE);
makeLESModel(kEqn);
makeLESModel(dynamicKEqn);
makeLESModel(dynamicLagrangian);
makeLESModel(SpalartAllmarasDES);
makeLESModel(SpalartAllmarasDDES);
makeLESModel(SpalartAllmarasIDDES);
makeLESModel(kOmegaSSTDES);
makeLESModel(kOmegaSSTDDES);
makeLESModel(kOmegaSSTIDDES);
