#include "distribution/cellDiffusion.h"
#include "distribution/chebyshevExponential.h"
#include "distribution/smoothingModel.h"

#include "addToRunTimeSelectionTable.H"

namespace clepsydra
{

namespace
{

/// Diffusion over a fixed pseudo-time: Sun & Xiao, "Diffusion-based coarse graining in hybrid continuum-discrete
/// solvers", Int. J. Multiphase Flow 72 (2015). With bandwidth b = `bandwidth` it diffuses over D t = b2/4, exactly
/// in t: the operator is exp(-b2/4 L), on a fine mesh a Gaussian exp(-r2/b2), of variance b2/2 along each axis on a mesh
/// of any size. (One implicit Euler step, Sun & Xiao's choice, has exp(-2 r/b)/r instead, with a peak at the particle.)
///
/// Walls and baffles are faces without neighbour: nothing diffuses through them, and going round an edge costs the
/// length of the way.
class ConstDiffSmoothing : public SmoothingModel
{
public:
    TypeName("constDiffSmoothing");

    ConstDiffSmoothing(const dictionary& coefficients, const fvMesh& mesh)
        : smoothingBandwidth_(positiveEntry(coefficients, "bandwidth")),
          diffusion_(mesh),
          series_(chebyshevExponential(
              0.5 * diffusion_.largestEigenvalue() * smoothingBandwidth_ * smoothingBandwidth_ / 4, tolerance))
    {
        requireKnownEntries(coefficients, {"bandwidth"});
    }

    void nearTo(const std::vector<Foam::label>& cells) override
    {
        // Beyond, the Gaussian has less than a part in a million; on cells as wide as it, whose steps reach farther, the
        // two cells more that restrictTo() takes keep it so.
        diffusion_.restrictTo(cells, 4 * smoothingBandwidth_);
    }

    void smooth(Eigen::MatrixXd& densities) const override
    {
        diffusion_.applyChebyshev(series_, densities);
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
    /// Largest error of the operator, relative to what it acts on, in the volume-weighted mean square. Volume, momentum
    /// and reaction do not depend on it: they are kept to rounding.
    static constexpr double tolerance = 1e-5;

    const double smoothingBandwidth_;
    CellDiffusion diffusion_;
    const std::vector<double> series_;
};

defineTypeNameAndDebug(ConstDiffSmoothing, 0);
addToRunTimeSelectionTable(SmoothingModel, ConstDiffSmoothing, dictionary);
const ModelLines lines(
    "smoothingModel", {{ConstDiffSmoothing::typeName_(), "diffusion to a Gaussian of `bandwidth`, stopped by walls"}});

} // namespace

} // namespace clepsydra
