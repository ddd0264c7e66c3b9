#pragma once

#include <Eigen/Core>

#include "fvMesh.H"

#include <optional>
#include <vector>

namespace clepsydra
{

/// Diffusion between the cells of a mesh, of several quantities at once:
///
///     (L u)_P = 1/V_P sum over faces of |S_f| (u_P - u_N)/|d_f|
///
/// Uncorrected for non-orthogonality: only then is L self-adjoint in the volume-weighted product. A face without a cell
/// behind it (wall, baffle, inlet) lets nothing through; a face to another rank is a face like any other. What leaves
/// a cell enters its neighbour, so the integral over the mesh stays to rounding.
class CellDiffusion
{
public:
    /// Collective. \pre no patch joins cells but those between ranks
    explicit CellDiffusion(const Foam::fvMesh& mesh);

    /// Upper bound of L's eigenvalues, after Gershgorin; the lower one is zero [1/m2].
    double largestEigenvalue() const
    {
        return largestEigenvalue_;
    }

    /// u <- sum_k c_k T_k(1 - 2 L/largestEigenvalue) u, T_k being Chebyshev's polynomials. Collective; one message to
    /// each neighbouring rank per term for up to twelve quantities.
    /// \param coefficients  c_k, at least one
    /// \param u  quantities x cells of this rank
    void applyChebyshev(const std::vector<double>& coefficients, Eigen::MatrixXd& u) const;

    /// From now on applyChebyshev() smooths near these cells only: the others keep what they have, and nothing passes
    /// between the two. Still conservative and self-adjoint, and the same as on the whole mesh as far as nothing diffuses
    /// farther than `reach` and two cells. Distances are straight, but do not lead through walls. Collective.
    /// \param sources  cells of this rank
    void restrictTo(const std::vector<Foam::label>& sources, double reach);

private:
    /// The cells at one boundary to another rank, and where the values of the cells behind it are kept.
    struct Boundary
    {
        int rank;
        int tag;
        int communicator;
        std::vector<Foam::label> cells;
        Eigen::Index firstBehind;
    };

    /// All cells of this rank, or some of them.
    struct Part
    {
        /// Their places in the mesh.
        std::vector<Foam::label> cells;
        /// The cells, then those behind the boundaries.
        Eigen::Index columnCount;
        std::vector<Boundary> boundaries;
        // Neighbours of cell P: entries firstNeighbour[P] to firstNeighbour[P + 1].
        std::vector<Foam::label> firstNeighbour;
        std::vector<Foam::label> neighbour;
        /// 2/largestEigenvalue |S_f|/(|d_f| V_P)
        std::vector<double> rate;
    };

    /// Of each column of the whole mesh whether it is near a source. Collective.
    std::vector<bool> near(const std::vector<Foam::label>& sources, double reach) const;
    Part partOf(const std::vector<bool>& taken) const;
    /// The same for up to `Lanes` quantities.
    template<int Lanes>
    void applyChebyshevTo(const std::vector<double>& coefficients, Eigen::Ref<Eigen::MatrixXd> u) const;
    /// Fills in the values behind the boundaries to other ranks.
    template<class Values>
    static void exchange(const Part& part, std::vector<Values>& values);

    const Foam::fvMesh& mesh_;
    /// Largest distance between a cell and one of its neighbours.
    std::vector<double> width_;
    Part whole_;
    /// What is smoothed, where that is not all.
    std::optional<Part> part_;
    double largestEigenvalue_;
};

} // namespace clepsydra
