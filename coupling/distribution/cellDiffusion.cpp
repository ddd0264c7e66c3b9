#include "distribution/cellDiffusion.h"

#include "vectorUnits.h"

#include "PstreamReduceOps.H"
#include "UIPstream.H"
#include "UOPstream.H"
#include "cyclicFvPatch.H"
#include "processorFvPatch.H"
#include "surfaceFields.H"
#include "volFields.H"

#include <algorithm>
#include <numeric>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// |S_f|/|d_f| between a cell and a column of the values.
struct Link
{
    label cell;
    label column;
    double conductance;
};

/// Quantities of a cell side by side, as many as a vector unit takes at once.
template<int Lanes>
struct alignas(Lanes * sizeof(double)) Values
{
    double lane[Lanes] = {};
};

struct Neighbours
{
    const label* first;
    const label* cell;
    const double* rate;
};

/// above <- coefficient start + factor X here - above, in each cell
template<int Lanes>
CLEPSYDRA_FOR_VECTOR_UNITS void sweep(label cellCount, const Neighbours neighbours, double coefficient, double factor,
    const Values<Lanes>* start, const Values<Lanes>* here, Values<Lanes>* above)
{
    for (label cell = 0; cell < cellCount; ++cell)
    {
        const Values<Lanes> own = here[cell];
        Values<Lanes> gained = own;
        for (label i = neighbours.first[cell]; i < neighbours.first[cell + 1]; ++i)
        {
            const Values<Lanes>& other = here[neighbours.cell[i]];
            const double rate = neighbours.rate[i];
            for (int lane = 0; lane < Lanes; ++lane)
            {
                gained.lane[lane] += rate * (other.lane[lane] - own.lane[lane]);
            }
        }
        for (int lane = 0; lane < Lanes; ++lane)
        {
            above[cell].lane[lane] =
                coefficient * start[cell].lane[lane] + factor * gained.lane[lane] - above[cell].lane[lane];
        }
    }
}

} // namespace

CellDiffusion::CellDiffusion(const fvMesh& mesh)
    : cellCount_(mesh.nCells()),
      columnCount_(mesh.nCells())
{
    std::vector<Link> links;
    const auto conductances = [](const scalarField& faceArea, const scalarField& deltaCoeff) {
        return scalarField(faceArea * deltaCoeff);
    };
    const scalarField inside = conductances(mesh.magSf().primitiveField(), mesh.deltaCoeffs().primitiveField());
    forAll (inside, face)
    {
        links.push_back({mesh.owner()[face], mesh.neighbour()[face], inside[face]});
        links.push_back({mesh.neighbour()[face], mesh.owner()[face], inside[face]});
    }
    for (const fvPatch& patch : mesh.boundary())
    {
        if (!patch.coupled())
        {
            continue;
        }
        const scalarField across = conductances(patch.magSf(), patch.deltaCoeffs());
        const labelUList& cells = patch.faceCells();
        const auto* toRank = isA<processorFvPatch>(patch) ? &refCast<const processorFvPatch>(patch) : nullptr;
        const auto* cyclic = isA<cyclicFvPatch>(patch) ? &refCast<const cyclicFvPatch>(patch) : nullptr;
        const bool rotates = !refCast<const coupledFvPatch>(patch).parallel();
        if (rotates || (!toRank && !cyclic))
        {
            FatalErrorInFunction << "Patch " << patch.name() << " is of type " << patch.type()
                                 << (rotates ? " and rotates" : "")
                                 << "; allowed between cells that beads are spread over: processor and cyclic without "
                                    "rotation"
                                 << exit(FatalError);
        }
        if (toRank)
        {
            boundaries_.push_back({toRank->neighbProcNo(), toRank->tag(), toRank->comm(),
                std::vector<label>(cells.begin(), cells.end()), columnCount_});
        }
        forAll (cells, face)
        {
            const label behind =
                toRank ? static_cast<label>(columnCount_++) : cyclic->neighbFvPatch().faceCells()[face];
            links.push_back({cells[face], behind, across[face]});
        }
    }

    scalarField outOfCell(mesh.nCells(), 0.0);
    firstNeighbour_.assign(mesh.nCells() + 1, 0);
    for (const Link& link : links)
    {
        outOfCell[link.cell] += link.conductance / mesh.V()[link.cell];
        ++firstNeighbour_[link.cell + 1];
    }
    // A mesh of one cell has none; any bound will do there.
    largestEigenvalue_ = std::max(2 * gMax(outOfCell), VSMALL);
    std::partial_sum(firstNeighbour_.begin(), firstNeighbour_.end(), firstNeighbour_.begin());

    neighbour_.resize(links.size());
    rate_.resize(links.size());
    std::vector<label> next(firstNeighbour_.begin(), firstNeighbour_.end() - 1);
    for (const Link& link : links)
    {
        const label at = next[link.cell]++;
        neighbour_[at] = link.column;
        rate_[at] = 2 * link.conductance / (largestEigenvalue_ * mesh.V()[link.cell]);
    }
}

void CellDiffusion::applyChebyshev(const std::vector<double>& coefficients, Eigen::MatrixXd& u) const
{
    constexpr Eigen::Index most = 8;
    for (Eigen::Index row = 0; row < u.rows(); row += most)
    {
        const Eigen::Index rows = std::min(most, u.rows() - row);
        const Eigen::Ref<Eigen::MatrixXd> part = u.middleRows(row, rows);
        if (rows <= 2)
        {
            applyChebyshevTo<2>(coefficients, part);
        }
        else if (rows <= 4)
        {
            applyChebyshevTo<4>(coefficients, part);
        }
        else
        {
            applyChebyshevTo<most>(coefficients, part);
        }
    }
}

template<int Lanes>
void CellDiffusion::applyChebyshevTo(const std::vector<double>& coefficients, Eigen::Ref<Eigen::MatrixXd> u) const
{
    // Clenshaw's recurrence b_k = c_k u + 2 X b_(k+1) - b_(k+2), X = 1 - 2 L/largestEigenvalue; result c_0 u + X b_1 - b_2.
    std::vector<Values<Lanes>> start(columnCount_);
    std::vector<Values<Lanes>> above(columnCount_);
    std::vector<Values<Lanes>> here(columnCount_);
    for (label cell = 0; cell < cellCount_; ++cell)
    {
        std::copy_n(u.col(cell).data(), u.rows(), start[cell].lane);
        for (int lane = 0; lane < Lanes; ++lane)
        {
            here[cell].lane[lane] = coefficients.back() * start[cell].lane[lane];
        }
    }
    for (std::size_t k = coefficients.size() - 1; k > 0; --k)
    {
        exchange(here);
        sweep(cellCount_, {firstNeighbour_.data(), neighbour_.data(), rate_.data()}, coefficients[k - 1], k > 1 ? 2 : 1,
            start.data(), here.data(), above.data());
        here.swap(above);
    }
    for (label cell = 0; cell < cellCount_; ++cell)
    {
        std::copy_n(here[cell].lane, u.rows(), u.col(cell).data());
    }
}

template<class Values>
void CellDiffusion::exchange(std::vector<Values>& values) const
{
    const auto bytes = [](std::size_t columns) { return static_cast<std::streamsize>(columns * sizeof(Values)); };
    const label before = UPstream::nRequests();
    std::vector<std::vector<Values>> outgoing;
    outgoing.reserve(boundaries_.size());
    for (const Boundary& boundary : boundaries_)
    {
        UIPstream::read(UPstream::commsTypes::nonBlocking, boundary.rank,
            reinterpret_cast<char*>(&values[boundary.firstBehind]), bytes(boundary.cells.size()), boundary.tag,
            boundary.communicator);
        std::vector<Values>& message = outgoing.emplace_back();
        for (const label cell : boundary.cells)
        {
            message.push_back(values[cell]);
        }
        UOPstream::write(UPstream::commsTypes::nonBlocking, boundary.rank,
            reinterpret_cast<const char*>(message.data()), bytes(message.size()), boundary.tag, boundary.communicator);
    }
    UPstream::waitRequests(before);
}

} // namespace clepsydra
