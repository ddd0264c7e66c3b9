#include "distribution/cellDiffusion.h"

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
    constexpr Eigen::Index most = 5;
    for (Eigen::Index row = 0; row < u.rows(); row += most)
    {
        const Eigen::Index rows = std::min(most, u.rows() - row);
        const Eigen::Ref<Eigen::MatrixXd> part = u.middleRows(row, rows);
        switch (rows)
        {
            case 1:
                applyChebyshevTo<1>(coefficients, part);
                break;
            case 2:
                applyChebyshevTo<2>(coefficients, part);
                break;
            case 3:
                applyChebyshevTo<3>(coefficients, part);
                break;
            case 4:
                applyChebyshevTo<4>(coefficients, part);
                break;
            default:
                applyChebyshevTo<most>(coefficients, part);
        }
    }
}

template<int Quantities>
void CellDiffusion::applyChebyshevTo(const std::vector<double>& coefficients, Eigen::Ref<Eigen::MatrixXd> u) const
{
    using Values = Eigen::Array<double, Quantities, Eigen::Dynamic>;
    using Value = Eigen::Array<double, Quantities, 1>;

    // Clenshaw's recurrence b_k = c_k u + 2 X b_(k+1) - b_(k+2), X = 1 - 2 L/largestEigenvalue; result c_0 u + X b_1 - b_2.
    const Values start = u;
    Values above = Values::Zero(Quantities, columnCount_);
    Values here = Values::Zero(Quantities, columnCount_);
    here.leftCols(cellCount_) = coefficients.back() * start;
    for (std::size_t k = coefficients.size() - 1; k > 0; --k)
    {
        exchange(here);
        const double factor = k > 1 ? 2 : 1;
        for (label cell = 0; cell < cellCount_; ++cell)
        {
            const Value own = here.col(cell);
            Value gained = own;
            for (label i = firstNeighbour_[cell]; i < firstNeighbour_[cell + 1]; ++i)
            {
                gained += rate_[i] * (here.col(neighbour_[i]) - own);
            }
            above.col(cell) = coefficients[k - 1] * start.col(cell) + factor * gained - above.col(cell);
        }
        here.swap(above);
    }
    u = here.leftCols(cellCount_).matrix();
}

template<class Values>
void CellDiffusion::exchange(Values& values) const
{
    if (boundaries_.empty())
    {
        return;
    }
    const auto bytes = [&](std::size_t columns) {
        return static_cast<std::streamsize>(columns * static_cast<std::size_t>(values.rows()) * sizeof(double));
    };
    const label before = UPstream::nRequests();
    std::vector<Values> outgoing;
    outgoing.reserve(boundaries_.size());
    for (const Boundary& boundary : boundaries_)
    {
        UIPstream::read(UPstream::commsTypes::nonBlocking, boundary.rank,
            reinterpret_cast<char*>(values.col(boundary.firstBehind).data()), bytes(boundary.cells.size()),
            boundary.tag, boundary.communicator);
        outgoing.push_back(values(Eigen::all, boundary.cells));
        UOPstream::write(UPstream::commsTypes::nonBlocking, boundary.rank,
            reinterpret_cast<const char*>(outgoing.back().data()), bytes(boundary.cells.size()), boundary.tag,
            boundary.communicator);
    }
    UPstream::waitRequests(before);
}

} // namespace clepsydra
