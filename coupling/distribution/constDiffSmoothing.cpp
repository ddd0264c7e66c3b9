#include "distribution/cellDiffusion.h"
#include "distribution/chebyshevExponential.h"
#include "distribution/smoothingModel.h"

#include "addToRunTimeSelectionTable.H"

#include <optional>
#include <utility>

namespace clepsydra
{

namespace
{

/// Diffusion over a fixed pseudo-time: Sun & Xiao, "Diffusion-based coarse graining in hybrid continuum-discrete
/// solvers", Int. J. Multiphase Flow 72 (2015). With the bandwidth b the pseudo-time is D t = b2/4, and the operator
/// exp(-b2/4 L) is evaluated exactly in t. On a fine mesh it is a Gaussian exp(-r2/b2); on any mesh the variance along
/// each axis is b2/2. (One implicit Euler step, Sun & Xiao's choice, gives exp(-2 r/b)/r, which is singular at the
/// particle.)
///
///     constDiffSmoothingProps { bandwidth 6e-3; }    // b [m]
///
/// Walls and baffles are faces without a neighbour: nothing diffuses through them, and a path around an edge counts
/// with its whole length.
class ConstDiffSmoothing : public SmoothingModel
{
public:
    TypeName("constDiffSmoothing");

    ConstDiffSmoothing(const dictionary& coefficients, const fvMesh& mesh)
        : smoothingBandwidth_(positiveEntry(coefficients, "bandwidth")),
          mesh_(mesh),
          diffusion_(std::in_place, mesh),
          series_(seriesFor(diffusion_->largestEigenvalue()))
    {
        requireKnownEntries(coefficients, {"bandwidth"});
        warnOfManySweeps();
    }

    void nearTo(const std::vector<Foam::label>& cells, RankTotals& totals) override
    {
        // Beyond this reach the Gaussian holds less than 1e-6. On cells as wide as the bandwidth, where a step reaches
        // farther, the two additional cells of restrictTo() ensure the same.
        diffusion_->restrictTo(cells, 4 * smoothingBandwidth_, totals);
    }

    void smooth(Eigen::MatrixXd& densities) const override
    {
        diffusion_->applyChebyshev(series_, densities);
    }

    void meshMoved() override
    {
        diffusion_.emplace(mesh_);
        series_ = seriesFor(diffusion_->largestEigenvalue());
    }

    double bandwidth() const override
    {
        return smoothingBandwidth_;
    }

    Foam::string description() const override
    {
        return "constDiffSmoothing: Gaussian of bandwidth " + Foam::name(smoothingBandwidth_) + " m, in "
               + Foam::name(static_cast<label>(series_.size() - 1)) + " sweeps over the mesh";
    }

private:
    /// Largest error of the operator, relative to its argument, in the volume-weighted root mean square. Conservation
    /// of volume and momentum does not depend on it; they are conserved to rounding.
    static constexpr double tolerance = 1e-5;
    /// Fewer sweeps are no reason for a warning, nor are sweeps that most cells need.
    static constexpr std::size_t manySweeps = 100;
    static constexpr std::size_t timesAsMany = 3;

    std::vector<double> seriesFor(double eigenvalue) const
    {
        return chebyshevExponential(0.5 * eigenvalue * smoothingBandwidth_ * smoothingBandwidth_ / 4, tolerance);
    }

    /// The number of sweeps grows with the bandwidth over the thickness of the thinnest cell. Collective.
    void warnOfManySweeps() const
    {
        const std::size_t sweeps = series_.size() - 1;
        const std::size_t ofMeanCells = seriesFor(diffusion_->meanEigenvalue()).size() - 1;
        if (sweeps <= manySweeps || sweeps <= timesAsMany * ofMeanCells)
        {
            return;
        }
        const CellDiffusion::StiffestCell thinnest = diffusion_->stiffestCell();
        if (Pstream::master())
        {
            WarningInFunction << "Smoothing over a bandwidth of " << smoothingBandwidth_ << " m takes " << label(sweeps)
                              << " sweeps over the mesh in every coupling step because of its "
                              << "thinnest cells, one of " << thinnest.thickness << " m at " << thinnest.centre
                              << " m; with cells of the mesh's mean size " << label(ofMeanCells)
                              << " would be enough. Thicker layers of cells at walls, or a smaller bandwidth in "
                              << "constDiffSmoothingProps, make it cheaper" << endl;
        }
    }

    const double smoothingBandwidth_;
    const fvMesh& mesh_;
    std::optional<CellDiffusion> diffusion_;
    std::vector<double> series_;
};

defineTypeNameAndDebug(ConstDiffSmoothing, 0);
addToRunTimeSelectionTable(SmoothingModel, ConstDiffSmoothing, dictionary);
const ModelLines lines(
    "smoothingModel", {{ConstDiffSmoothing::typeName_(), "diffusion to a Gaussian of `bandwidth`, stopped by walls"}});

} // namespace

} // namespace clepsydra
