#include "distribution/smoothingModel.h"


#include "addToRunTimeSelectionTable.H"
#include "fvMatrices.H"
#include "fvcSurfaceIntegrate.H"
#include "gaussLaplacianScheme.H"
#include "surfaceFields.H"
#include "volFields.H"
#include "zeroGradientFvPatchFields.H"

namespace clepsydra
{

using namespace Foam;

namespace
{

/// Diffusion over a fixed pseudo-time, in implicit steps: Sun & Xiao, "Diffusion-based coarse graining in hybrid
/// continuum-discrete solvers", Int. J. Multiphase Flow 72 (2015). With bandwidth b = smoothingLength the exact
/// operator is a Gaussian exp(-r2/b2), reached by diffusing over D t = b2/4; each of the `nSteps` implicit steps has
/// D dt = b2/(4 nSteps). The kernel's variance is the same for any number of steps.
///
/// Walls and baffles are faces without neighbour: nothing diffuses through them, and going round an edge costs the
/// length of the way.
class ConstDiffSmoothing : public SmoothingModel
{
public:
    TypeName("constDiffSmoothing");

    ConstDiffSmoothing(const dictionary& coefficients, const fvMesh& mesh)
        : smoothingLength_(positiveEntry(coefficients, "smoothingLength")),
          nSteps_(coefficients.getOrDefault<label>("nSteps", 1)),
          mesh_(mesh),
          work_(IOobject("smoothing", mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE, false), mesh,
              dimensionedScalar("zero", dimless, 0), zeroGradientFvPatchScalarField::typeName),
          matrix_(work_, dimVolume)
    {
        if (nSteps_ < 1)
        {
            FatalIOErrorInFunction(coefficients)
                << "Entry 'nSteps' is " << nSteps_ << "; allowed: 1, 2, ..." << exit(FatalIOError);
        }
        const dimensionedScalar diffusionLengthSqr(
            "diffusionLengthSqr", dimArea, smoothingLength_ * smoothingLength_ / (4 * nSteps_));
        // Uncorrected for non-orthogonality: only then is the matrix symmetric, and the operator self-adjoint.
        matrix_ = fv::gaussLaplacianScheme<scalar, scalar>::fvmLaplacianUncorrected(
            diffusionLengthSqr * mesh.magSf(), mesh.deltaCoeffs(), work_);
        matrix_.negate();
        matrix_.diag() += mesh.V();
        solver_ = matrix_.solver();
        mesh.setFluxRequired(work_.name());
    }

    void smooth(const scalarField& density, scalarField& guess) const override
    {
        scalarField start(density);
        for (label step = 0; step < nSteps_; ++step)
        {
            matrix_.source() = start * mesh_.V().field();
            work_.primitiveFieldRef() = guess;
            work_.correctBoundaryConditions();

            const int solverOutput = SolverPerformance<scalar>::debug;
            SolverPerformance<scalar>::debug = 0;
            const solverPerformance performance = solver_->solve();
            SolverPerformance<scalar>::debug = solverOutput;
            if (!performance.converged())
            {
                FatalErrorInFunction << "The smoothing solver did not converge: residual "
                                     << performance.finalResidual() << " after " << performance.nIterations()
                                     << " iterations; see solvers/smoothing in system/fvSolution" << exit(FatalError);
            }
            // One explicit evaluation with the converged fluxes. What leaves a cell through a face enters the next,
            // so the integral is kept to rounding whatever the solver's tolerance.
            guess = start - fvc::surfaceIntegrate(matrix_.flux())().primitiveField();
            start = guess;
        }
    }

    Foam::string description() const override
    {
        return "constDiffSmoothing: smoothingLength " + Foam::name(smoothingLength_) + " m, nSteps "
               + Foam::name(nSteps_);
    }

private:
    const double smoothingLength_;
    const label nSteps_;
    const fvMesh& mesh_;
    mutable volScalarField work_;
    mutable fvScalarMatrix matrix_;
    mutable autoPtr<fvScalarMatrix::fvSolver> solver_;
};

defineTypeNameAndDebug(ConstDiffSmoothing, 0);
addToRunTimeSelectionTable(SmoothingModel, ConstDiffSmoothing, dictionary);

} // namespace

} // namespace clepsydra
