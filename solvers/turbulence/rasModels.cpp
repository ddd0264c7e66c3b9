// Models for Reynolds-averaged equations. Only models of an eddy viscosity are here, because the stress that the particles
// receive is that of an eddy viscosity; see ViscousStress. The names are listed in pimpleDemFoam/turbulence.cpp, too.

#include "turbulence/modelTypes.h"

#include "LaunderSharmaKE.H"
#include "RNGkEpsilon.H"
#include "SpalartAllmaras.H"
#include "kEpsilon.H"
#include "kOmega.H"
#include "kOmegaSST.H"
#include "kOmegaSSTLM.H"
#include "kOmegaSSTSAS.H"
#include "realizableKE.H"

#define makeRASModel(Type) makeTemplatedTurbulenceModel(FluidTransportVoidFractionTurbulenceModel, RAS, Type)

makeRASModel(SpalartAllmaras);
makeRASModel(kEpsilon);
makeRASModel(RNGkEpsilon);
makeRASModel(realizableKE);
makeRASModel(LaunderSharmaKE);
makeRASModel(kOmega);
makeRASModel(kOmegaSST);
makeRASModel(kOmegaSSTSAS);
makeRASModel(kOmegaSSTLM);
