#pragma once

#include <Eigen/Core>

#include "fvMesh.H"
#include "runTimeSelection.h"

#include <vector>

namespace clepsydra
{

/// A linear, conservative and self-adjoint smoothing of what the particles put into the cells. Selected by
/// `smoothingModel` in couplingProperties, coefficients in `<name>Props`.
///
/// Conservative: the integral over the mesh stays to rounding. Self-adjoint in the volume-weighted product: the same
/// operator samples the fluid for the particles, so that action equals reaction.
class SmoothingModel
{
public:
    TypeName("smoothingModel");

    declareRunTimeSelectionTable(Foam::autoPtr, SmoothingModel, dictionary,
        (const Foam::dictionary& coefficients, const Foam::fvMesh& mesh), (coefficients, mesh))

        static Foam::autoPtr<SmoothingModel> New(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh);

    virtual ~SmoothingModel() = default;

    /// From now on smooth() is asked for what is in these cells, or wanted there; what it does far from them does not
    /// matter. Collective.
    /// \param cells  of this rank; may be listed twice
    virtual void nearTo(const std::vector<Foam::label>& cells) = 0;

    /// Smooths quantities per volume, all in one pass over the mesh. Collective.
    /// \param densities  quantities x cells of this rank
    virtual void smooth(Eigen::MatrixXd& densities) const = 0;

    /// b, where the result is like a Gaussian exp(-r2/b2) [m].
    virtual double bandwidth() const = 0;

    /// One line for the start of the log.
    virtual Foam::string description() const = 0;
};

} // namespace clepsydra
