#pragma once

#include "engine/periodicBox.h"

#include <Eigen/Core>

#include "fvMesh.H"
#include "rankTotals.h"

#include <array>
#include <vector>

namespace clepsydra
{

/// Diffusion of several quantities between the cells of a mesh:
///
///     (L u)_P = 1/V_P sum over faces of |S_f| (u_P - u_N)/|d_f|
///
/// There is no correction for non-orthogonality, because only then is L self-adjoint in the volume-weighted product.
/// Nothing passes a face without a cell behind it (wall, baffle, inlet); faces between ranks and those of cyclic patches
/// are treated as internal faces. What leaves a cell enters its neighbour, so the integral over the mesh is constant to rounding.
class CellDiffusion
{
public:
    /// Collective. FatalError as periodicBoxOf().
    explicit CellDiffusion(const Foam::fvMesh& mesh);

    /// Upper bound of the eigenvalues of L by Gershgorin's theorem [1/m2]; the lower bound is zero.
    double largestEigenvalue() const
    {
        return largestEigenvalue_;
    }

    /// Square of the mean over the cells of the root of each cell's bound [1/m2]. The number of sweeps of an exponential
    /// is proportional to the root.
    double meanEigenvalue() const
    {
        return meanEigenvalue_;
    }

    /// Centre and thickness (volume over largest face) of the cell that determines largestEigenvalue() [m].
    struct StiffestCell
    {
        Foam::point centre;
        double thickness;
    };

    /// Collective.
    StiffestCell stiffestCell() const;

    /// u <- sum_k c_k T_k(1 - 2 L/largestEigenvalue) u with the Chebyshev polynomials T_k. Collective; one message to
    /// each neighbouring rank per term for up to twelve quantities.
    /// \param coefficients  c_k, at least one
    /// \param u  quantities x cells of this rank
    void applyChebyshev(const std::vector<double>& coefficients, Eigen::MatrixXd& u) const;

    /// Restricts later calls of applyChebyshev() to cells near the given ones. Values in the other cells do not change,
    /// and nothing passes between the two regions. The operator is still conservative and self-adjoint, and it equals
    /// that on the whole mesh as long as nothing diffuses farther than `reach` and two cells. Distances are straight,
    /// but paths do not lead through walls. Collective.
    ///
    /// The cells are found in rounds, in each of which neighbouring ranks exchange a message. From the second call on,
    /// as many rounds are made as before, and the part of the mesh is restricted where it was before. Whether more rounds
    /// were needed, or whether it is now worthwhile to restrict it, is a condition of the totals: where it does not hold,
    /// call again after they have been reduced.
    /// \param sources  cells of this rank
    /// \param reach  distance from the sources [m]
    void restrictTo(const std::vector<Foam::label>& sources, double reach, RankTotals& totals);

private:
    /// The cells at one boundary to another rank, and where the values of the cells behind it are stored.
    struct Boundary
    {
        int rank;
        int tag;
        int communicator;
        std::vector<Foam::label> cells;
        Eigen::Index firstBehind;
    };

    /// All cells of this rank and those behind its boundaries, whose columns come after.
    struct Whole
    {
        Eigen::Index columnCount;
        std::vector<Boundary> boundaries;
        // Neighbours of cell P are the entries firstNeighbour[P] to firstNeighbour[P + 1].
        std::vector<Foam::label> firstNeighbour;
        std::vector<Foam::label> neighbour;
        /// 2/largestEigenvalue |S_f|/(|d_f| V_P) [-].
        std::vector<double> rate;
        /// The cells in an order in which neighbours are near each other in memory.
        std::vector<Foam::label> order;
    };

    /// What a sweep adds up for a cell: itself and as many neighbours as a hexahedron has, so that the loop over them has a
    /// fixed length. Where a cell has fewer, the rest are itself with a rate of zero.
    struct Row
    {
        static constexpr std::size_t most = 6;
        double own;
        std::array<double, most> rate;
        std::array<Foam::label, most> column;
    };

    /// A neighbour beyond those of the Row.
    struct FurtherNeighbour
    {
        Foam::label cell;
        Foam::label column;
        double rate;
    };

    /// All cells of this rank, or some of them.
    struct Part
    {
        /// Their labels in the mesh.
        std::vector<Foam::label> cells;
        /// Number of the cells and of those behind the boundaries.
        Eigen::Index columnCount;
        std::vector<Boundary> boundaries;
        std::vector<Row> rows;
        std::vector<FurtherNeighbour> further;
    };

    /// The cells near sources.
    struct Near
    {
        /// For each column of the whole mesh; the same on the two ranks that have a cell and its copy behind a boundary.
        std::vector<bool> taken;
        /// Number of rounds in which they were found.
        int rounds;
        /// Whether a further round would find no more cells from this rank.
        bool isComplete;
    };

    /// Collective.
    /// \param rounds  number of rounds; 0 for as many as are needed, with a reduction after each
    Near near(const std::vector<Foam::label>& sources, double reach, int rounds) const;
    Part partOf(const std::vector<bool>& taken) const;
    Part allCells() const;
    /// applyChebyshev() for up to `Lanes` quantities.
    template<int Lanes>
    void applyChebyshevTo(const std::vector<double>& coefficients, Eigen::Ref<Eigen::MatrixXd> u) const;
    /// Fills in the values behind the boundaries to other ranks.
    template<class Values>
    static void exchange(const std::vector<Boundary>& boundaries, std::vector<Values>& values);

    const Foam::fvMesh& mesh_;
    const PeriodicBox periodic_;
    /// Largest distance between a cell and one of its neighbours [m].
    std::vector<double> width_;
    Whole whole_;
    /// The cells that are smoothed.
    Part part_;
    // What restrictTo() assumes about all ranks, the same on all of them: the number of rounds that were needed so far,
    // and whether it is worthwhile to leave out cells.
    bool planHolds_ = false;
    int rounds_ = 0;
    bool isRestricted_ = false;
    double largestEigenvalue_;
    double meanEigenvalue_;
    /// The cell of this rank that determines largestEigenvalue(); -1 where it is on another rank.
    Foam::label stiffestCell_ = -1;
};

} // namespace clepsydra
