#include "distribution/cellDiffusion.h"

#include "distribution/cyclicPatches.h"
#include "vectorUnits.h"
#include "vectors.h"

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

/// Conductance |S_f|/|d_f| between a cell and a column of the values [m], and their distance [m].
struct Link
{
    label cell;
    label column;
    double conductance;
    double distance;
};

/// Quantities of a cell side by side, for vector units.
template<int Lanes>
struct alignas((Lanes > 8 ? 4 : Lanes) * sizeof(double)) Values
{
    double lane[Lanes] = {};
};

/// above <- coefficient start + factor X here - above, in each cell.
template<int Lanes, class Part>
CLEPSYDRA_FOR_VECTOR_UNITS void sweep(const Part& part, double coefficient, double factor, const Values<Lanes>* start,
    const Values<Lanes>* here, Values<Lanes>* above)
{
    for (std::size_t cell = 0; cell < part.rows.size(); ++cell)
    {
        const auto& row = part.rows[cell];
        Values<Lanes> next = here[cell];
        for (int lane = 0; lane < Lanes; ++lane)
        {
            next.lane[lane] *= row.own;
        }
        for (std::size_t i = 0; i < row.most; ++i)
        {
            const Values<Lanes>& other = here[row.column[i]];
            for (int lane = 0; lane < Lanes; ++lane)
            {
                next.lane[lane] += row.rate[i] * other.lane[lane];
            }
        }
        for (int lane = 0; lane < Lanes; ++lane)
        {
            above[cell].lane[lane] =
                coefficient * start[cell].lane[lane] + factor * next.lane[lane] - above[cell].lane[lane];
        }
    }
    for (const auto& further : part.further)
    {
        for (int lane = 0; lane < Lanes; ++lane)
        {
            above[further.cell].lane[lane] += factor * further.rate * here[further.column].lane[lane];
        }
    }
}

/// All cells, each soon after the first of its neighbours (Cuthill & McKee, Proc. 24th ACM National Conf., 157, 1969).
std::vector<label> orderByNeighbours(
    label cellCount, const std::vector<label>& firstNeighbour, const std::vector<label>& neighbour)
{
    std::vector<label> order;
    std::vector<bool> isListed(cellCount, false);
    const auto list = [&](label cell) {
        // Behind a boundary there is a cell of another rank.
        if (cell < cellCount && !isListed[cell])
        {
            isListed[cell] = true;
            order.push_back(cell);
        }
    };
    std::size_t next = 0;
    for (label first = 0; first < cellCount; ++first)
    {
        for (list(first); next < order.size(); ++next)
        {
            const label cell = order[next];
            std::for_each(neighbour.begin() + firstNeighbour[cell], neighbour.begin() + firstNeighbour[cell + 1], list);
        }
    }
    return order;
}

} // namespace

CellDiffusion::CellDiffusion(const fvMesh& mesh)
    : mesh_(mesh),
      periodic_(periodicBoxOf(mesh))
{
    Whole& whole = whole_;
    whole.columnCount = mesh.nCells();
    std::vector<Link> links;
    const auto conductances = [](const scalarField& faceArea, const scalarField& deltaCoeff) {
        return scalarField(faceArea * deltaCoeff);
    };
    const scalarField inside = conductances(mesh.magSf().primitiveField(), mesh.deltaCoeffs().primitiveField());
    forAll (inside, face)
    {
        const double distance = 1 / mesh.deltaCoeffs()[face];
        links.push_back({mesh.owner()[face], mesh.neighbour()[face], inside[face], distance});
        links.push_back({mesh.neighbour()[face], mesh.owner()[face], inside[face], distance});
    }
    for (const fvPatch& patch : mesh.boundary())
    {
        if (!patch.coupled())
        {
            continue;
        }
        const scalarField across = conductances(patch.magSf(), patch.deltaCoeffs());
        const labelUList& cells = patch.faceCells();
        if (isA<cyclicFvPatch>(patch))
        {
            const labelUList& behind = refCast<const cyclicFvPatch>(patch).neighbFvPatch().faceCells();
            forAll (cells, face)
            {
                links.push_back({cells[face], behind[face], across[face], 1 / patch.deltaCoeffs()[face]});
            }
            continue;
        }
        const auto& toRank = refCast<const processorFvPatch>(patch);
        whole.boundaries.push_back({toRank.neighbProcNo(), toRank.tag(), toRank.comm(),
            std::vector<label>(cells.begin(), cells.end()), whole.columnCount});
        forAll (cells, face)
        {
            const auto behind = static_cast<label>(whole.columnCount++);
            links.push_back({cells[face], behind, across[face], 1 / patch.deltaCoeffs()[face]});
        }
    }

    width_.assign(mesh.nCells(), 0.0);
    scalarField outOfCell(mesh.nCells(), 0.0);
    whole.firstNeighbour.assign(mesh.nCells() + 1, 0);
    for (const Link& link : links)
    {
        outOfCell[link.cell] += link.conductance / mesh.V()[link.cell];
        width_[link.cell] = std::max(width_[link.cell], link.distance);
        ++whole.firstNeighbour[link.cell + 1];
    }
    // A mesh of one cell has no links; there any bound is valid.
    largestEigenvalue_ = std::max(2 * gMax(outOfCell), VSMALL);
    meanEigenvalue_ = std::max(2 * sqr(gAverage(scalarField(sqrt(outOfCell)))), VSMALL);
    const label stiffest = findMax(outOfCell);
    stiffestCell_ = stiffest >= 0 && 2 * outOfCell[stiffest] >= largestEigenvalue_ ? stiffest : -1;
    std::partial_sum(whole.firstNeighbour.begin(), whole.firstNeighbour.end(), whole.firstNeighbour.begin());

    whole.neighbour.resize(links.size());
    whole.rate.resize(links.size());
    std::vector<label> next(whole.firstNeighbour.begin(), whole.firstNeighbour.end() - 1);
    for (const Link& link : links)
    {
        const label at = next[link.cell]++;
        whole.neighbour[at] = link.column;
        whole.rate[at] = 2 * link.conductance / (largestEigenvalue_ * mesh.V()[link.cell]);
    }
    whole.order = orderByNeighbours(mesh.nCells(), whole.firstNeighbour, whole.neighbour);
    part_ = allCells();
}

CellDiffusion::StiffestCell CellDiffusion::stiffestCell() const
{
    const label rank = returnReduce(stiffestCell_ < 0 ? labelMax : label(Pstream::myProcNo()), minOp<label>());
    StiffestCell found{vector::zero, 0};
    if (rank == Pstream::myProcNo() && stiffestCell_ >= 0)
    {
        scalar largestFace = 0;
        for (const label face : mesh_.cells()[stiffestCell_])
        {
            largestFace = max(largestFace, mag(mesh_.faceAreas()[face]));
        }
        found = {mesh_.cellCentres()[stiffestCell_], mesh_.V()[stiffestCell_] / largestFace};
    }
    reduce(found.centre, sumOp<vector>());
    reduce(found.thickness, sumOp<scalar>());
    return found;
}

void CellDiffusion::restrictTo(const std::vector<label>& sources, double reach, RankTotals& totals)
{
    const bool wasRestricted = isRestricted_;
    const Near found = near(sources, reach, planHolds_ ? rounds_ : 0);
    const RankNumbers sizes{{static_cast<double>(std::count(found.taken.begin(), found.taken.end(), true)),
                                static_cast<double>(found.taken.size())},
        {found.isComplete ? 0.0 : 1.0}};
    const auto isWorthwhile = [](const RankNumbers& all) {
        // Where nearly all cells are near, a new list of them in each coupling step saves no time.
        constexpr double worthwhile = 0.8;
        return all.sums[0] < worthwhile * all.sums[1];
    };
    if (planHolds_)
    {
        totals.require(sizes, [this, isWorthwhile](const RankNumbers& all) {
            planHolds_ = all.maxima[0] == 0 && isWorthwhile(all) == isRestricted_;
            return planHolds_;
        });
    }
    else
    {
        rounds_ = std::max(rounds_, found.rounds);
        isRestricted_ = isWorthwhile(RankTotals::of(sizes));
        planHolds_ = true;
    }
    if (isRestricted_)
    {
        part_ = partOf(found.taken);
    }
    else if (wasRestricted)
    {
        part_ = allCells();
    }
}

CellDiffusion::Near CellDiffusion::near(const std::vector<label>& sources, double reach, int rounds) const
{
    // Each cell receives the nearest source from its neighbours (Danielsson, Comput. Graph. Image Process. 14, 227,
    // 1980).
    struct Nearest
    {
        vector source = vector::zero;
        scalar distanceSqr = GREAT;
    };
    const vectorField& centres = mesh_.C().primitiveField();
    std::vector<Nearest> nearest(whole_.columnCount);
    std::vector<label> changed;
    const auto offer = [&, isPeriodic = periodic_.isPeriodic()](label cell, const vector& source) {
        const vector apart = centres[cell] - source;
        const scalar awaySqr = isPeriodic ? periodic_.nearest(toEigen(apart)).squaredNorm() : magSqr(apart);
        if (awaySqr <= sqr(reach + 2 * width_[cell]) && awaySqr < nearest[cell].distanceSqr)
        {
            nearest[cell] = {source, awaySqr};
            changed.push_back(cell);
        }
    };
    for (const label cell : sources)
    {
        offer(cell, centres[cell]);
    }
    const auto taken = [&] {
        std::vector<bool> found(nearest.size());
        std::transform(
            nearest.begin(), nearest.end(), found.begin(), [](const Nearest& n) { return n.distanceSqr < GREAT; });
        return found;
    };
    for (int round = 1;; ++round)
    {
        std::size_t next = 0;
        while (next < changed.size())
        {
            const label cell = changed[next++];
            const vector source = nearest[cell].source;
            for (label n = whole_.firstNeighbour[cell]; n < whole_.firstNeighbour[cell + 1]; ++n)
            {
                const label other = whole_.neighbour[n];
                if (other < mesh_.nCells() && nearest[other].distanceSqr > 0)
                {
                    offer(other, source);
                }
            }
        }
        changed.clear();
        exchange(whole_.boundaries, nearest);
        // What this rank takes from its neighbours below is not known to them before the next exchange.
        const bool isLast = round == rounds;
        const std::vector<bool> knownToNeighbours = isLast ? taken() : std::vector<bool>();
        for (const Boundary& boundary : whole_.boundaries)
        {
            for (std::size_t face = 0; face < boundary.cells.size(); ++face)
            {
                const Nearest& behind = nearest[boundary.firstBehind + face];
                if (behind.distanceSqr < GREAT)
                {
                    offer(boundary.cells[face], behind.source);
                }
            }
        }
        const bool isComplete = changed.empty();
        if (isLast)
        {
            return {knownToNeighbours, round, isComplete};
        }
        if (rounds == 0 && RankTotals::of({{}, {isComplete ? 0.0 : 1.0}}).maxima[0] == 0)
        {
            return {taken(), round, isComplete};
        }
    }
}

CellDiffusion::Part CellDiffusion::allCells() const
{
    return partOf(std::vector<bool>(whole_.columnCount, true));
}

CellDiffusion::Part CellDiffusion::partOf(const std::vector<bool>& taken) const
{
    Part part;
    std::vector<label> place(taken.size(), -1);
    for (const label cell : whole_.order)
    {
        if (taken[cell])
        {
            place[cell] = static_cast<label>(part.cells.size());
            part.cells.push_back(cell);
        }
    }
    part.columnCount = static_cast<Eigen::Index>(part.cells.size());
    // Boundary faces between two cells that are both in the part; the two ranks find the same faces in the same order.
    for (const Boundary& boundary : whole_.boundaries)
    {
        Boundary some{boundary.rank, boundary.tag, boundary.communicator, {}, part.columnCount};
        for (std::size_t face = 0; face < boundary.cells.size(); ++face)
        {
            const Eigen::Index behind = boundary.firstBehind + static_cast<Eigen::Index>(face);
            if (taken[boundary.cells[face]] && taken[behind])
            {
                some.cells.push_back(place[boundary.cells[face]]);
                place[behind] = static_cast<label>(part.columnCount++);
            }
        }
        part.boundaries.push_back(std::move(some));
    }
    for (const label cell : part.cells)
    {
        Row row{1, {}, {}};
        row.column.fill(place[cell]);
        std::size_t count = 0;
        for (label n = whole_.firstNeighbour[cell]; n < whole_.firstNeighbour[cell + 1]; ++n)
        {
            const label column = place[whole_.neighbour[n]];
            const double rate = whole_.rate[n];
            if (column < 0)
            {
                continue;
            }
            row.own -= rate;
            if (count < Row::most)
            {
                row.column[count] = column;
                row.rate[count] = rate;
                ++count;
            }
            else
            {
                part.further.push_back({place[cell], column, rate});
            }
        }
        part.rows.push_back(row);
    }
    return part;
}

void CellDiffusion::applyChebyshev(const std::vector<double>& coefficients, Eigen::MatrixXd& u) const
{
    constexpr Eigen::Index most = 12;
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
        else if (rows <= 8)
        {
            applyChebyshevTo<8>(coefficients, part);
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
    // Clenshaw's recurrence b_k = c_k u + 2 X b_(k+1) - b_(k+2), X = 1 - 2 L/largestEigenvalue; the result is c_0 u + X
    // b_1 - b_2.
    std::vector<Values<Lanes>> start(part_.columnCount);
    std::vector<Values<Lanes>> above(part_.columnCount);
    std::vector<Values<Lanes>> here(part_.columnCount);
    for (std::size_t cell = 0; cell < part_.cells.size(); ++cell)
    {
        for (Eigen::Index row = 0; row < u.rows(); ++row)
        {
            start[cell].lane[row] = u(row, part_.cells[cell]);
        }
        for (int lane = 0; lane < Lanes; ++lane)
        {
            here[cell].lane[lane] = coefficients.back() * start[cell].lane[lane];
        }
    }
    for (std::size_t k = coefficients.size() - 1; k > 0; --k)
    {
        exchange(part_.boundaries, here);
        sweep(part_, coefficients[k - 1], k > 1 ? 2 : 1, start.data(), here.data(), above.data());
        here.swap(above);
    }
    for (std::size_t cell = 0; cell < part_.cells.size(); ++cell)
    {
        std::copy_n(here[cell].lane, u.rows(), u.col(part_.cells[cell]).data());
    }
}

template<class Values>
void CellDiffusion::exchange(const std::vector<Boundary>& boundaries, std::vector<Values>& values)
{
    const auto bytes = [](std::size_t columns) { return static_cast<std::streamsize>(columns * sizeof(Values)); };
    const label before = UPstream::nRequests();
    std::vector<std::vector<Values>> outgoing;
    outgoing.reserve(boundaries.size());
    for (const Boundary& boundary : boundaries)
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
