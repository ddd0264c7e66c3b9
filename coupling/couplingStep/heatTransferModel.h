#pragma once

#include "runTimeSelection.h"

namespace clepsydra
{

/// Nusselt number of the heat transfer between a particle and the fluid, selected by the entry `heatTransferModel` of the
/// dictionary `energy` of couplingProperties.
class HeatTransferModel
{
public:
    TypeName("heatTransferModel");

    declareRunTimeSelectionTable(
        Foam::autoPtr, HeatTransferModel, dictionary, (const Foam::dictionary& energy), (energy))

        /// FatalIOError where the entry names no model.
        static Foam::autoPtr<HeatTransferModel> New(const Foam::dictionary& energy);

    virtual ~HeatTransferModel() = default;

    /// h d/k [-].
    /// \param reynolds  rho U_r d/mu with the interstitial slip velocity U_r
    /// \param prandtl  mu Cp/k of the fluid
    virtual double nusselt(double reynolds, double prandtl, double voidFraction) const = 0;

    /// The law and its range, for the report at the start of the log.
    virtual std::string description() const = 0;
};

} // namespace clepsydra
