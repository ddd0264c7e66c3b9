#pragma once

#include <Eigen/Core>

#include "fvMesh.H"
#include "rankTotals.h"
#include "runTimeSelection.h"

#include <vector>

namespace clepsydra
{

/// A linear, conservative and self-adjoint smoothing of the densities that the particles add to the cells. Selected by
/// `smoothingModel` in couplingProperties, with coefficients in `<name>Props`.
///
/// Conservative: the integral over the mesh is constant to rounding. Self-adjoint in the volume-weighted product: the
/// same operator samples the fluid for the particles, so action equals reaction.
class SmoothingModel
{
public:
    TypeName("smoothingModel");

    declareRunTimeSelectionTable(Foam::autoPtr, SmoothingModel, dictionary,
        (const Foam::dictionary& coefficients, const Foam::fvMesh& mesh), (coefficients, mesh))

        static Foam::autoPtr<SmoothingModel> New(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh);

    virtual ~SmoothingModel() = default;

    /// Restricts later calls of smooth() to densities in these cells and around them; the result far from them is not
    /// used. Collective. What a model assumes about other ranks, so that it needs no reduction, is a condition of the
    /// totals: where it does not hold, nearTo() is called again after the totals have been reduced.
    /// \param cells  of this rank; a cell may be listed twice
    virtual void nearTo(const std::vector<Foam::label>& cells, RankTotals& totals) = 0;

    /// Smooths quantities per volume in one pass over the mesh. Collective.
    /// \param densities  quantities x cells of this rank
    virtual void smooth(Eigen::MatrixXd& densities) const = 0;

    /// Bandwidth b of the Gaussian exp(-r2/b2) that the smoothing approximates [m]; 0 without smoothing.
    virtual double bandwidth() const = 0;

    /// Recomputes what depends on the points of the mesh, after they have moved. Collective.
    virtual void meshMoved()
    {}

    /// One line for the report at the start of the log.
    virtual Foam::string description() const = 0;
};

} // namespace clepsydra
