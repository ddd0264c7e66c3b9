#include "exchange/beadExchange.h"

#include "couplingState.h"

#include <algorithm>

namespace clepsydra
{

namespace
{

constexpr int messageTag = 51;

/// On each side, in parts of the box around a rank's beads: what spreads is announced ever less often, and no rank hears
/// of many more beads than touch it.
constexpr double roomAroundBeads = 0.25;

/// Collective.
std::vector<Box> boxesOfRanks(MPI_Comm communicator, const Box& own)
{
    int rankCount = 1;
    MPI_Comm_size(communicator, &rankCount);
    Eigen::Matrix<double, 6, 1> corners;
    corners << own.min(), own.max();
    Eigen::Matrix<double, 6, Eigen::Dynamic> all(6, rankCount);
    MPI_Allgather(corners.data(), 6, MPI_DOUBLE, all.data(), 6, MPI_DOUBLE, communicator);
    std::vector<Box> boxes;
    for (const auto& of : all.colwise())
    {
        // An empty one stays empty.
        boxes.emplace_back(Vector3d(of.head<3>()), Vector3d(of.tail<3>()));
    }
    return boxes;
}

Box boxAround(const BeadsView& beads, double commonReach)
{
    Box around;
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        const SphereInFluid sphere = sphereInFluid(beads, bead);
        const Vector3d reach = Vector3d::Constant(std::max(sphere.radius, commonReach));
        around.extend(sphere.centre - reach);
        around.extend(sphere.centre + reach);
    }
    return around;
}

VisitingBead visitFrom(const BeadsView& beads, const Reactions& reactions, Eigen::Index bead)
{
    const SphereInFluid sphere = sphereInFluid(beads, bead);
    return {sphere.centre, reactions.col(bead), beads.state[bead].given.implicitCoefficientTime,
        volumeInFluid(beads, bead), sphere.radius, static_cast<double>(beads.id[bead])};
}

} // namespace

BeadExchange::BeadExchange(MPI_Comm communicator, const Box& cells, double commonReach)
    : communicator_(communicator),
      cells_(cells),
      commonReach_(commonReach),
      cellsOfRanks_(boxesOfRanks(communicator, cells))
{
    MPI_Comm_rank(communicator_, &rank_);
}

void BeadExchange::announce(const Box& beads)
{
    if (!announced_.contains(beads))
    {
        const Vector3d room = roomAroundBeads * beads.sizes();
        announced_.extend(Box(beads.min() - room, beads.max() + room));
    }
    const std::vector<Box> announced = boxesOfRanks(communicator_, announced_);
    hosts_.clear();
    guests_.clear();
    const auto add = [&](int rank) {
        const auto of = static_cast<std::size_t>(rank);
        if (announced_.intersects(cellsOfRanks_[of]))
        {
            hosts_.push_back(rank);
        }
        if (announced[of].intersects(cells_))
        {
            guests_.push_back(rank);
        }
    };
    add(rank_);
    for (int rank = 0; rank < static_cast<int>(announced.size()); ++rank)
    {
        if (rank != rank_)
        {
            add(rank);
        }
    }
}

void BeadExchange::makePlan(const BeadsView& beads)
{
    const Box around = boxAround(beads, commonReach_);
    int anyLeft = announced_.contains(around) ? 0 : 1;
    MPI_Allreduce(MPI_IN_PLACE, &anyLeft, 1, MPI_INT, MPI_MAX, communicator_);
    if (anyLeft != 0)
    {
        announce(around);
    }
    exports_.clear();
    for (const int host : hosts_)
    {
        Exports leaving{host, {}};
        const Box& cells = cellsOfRanks_[static_cast<std::size_t>(host)];
        for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
        {
            const SphereInFluid sphere = sphereInFluid(beads, bead);
            if (cubeMeets(cells, sphere.centre, std::max(sphere.radius, commonReach_)))
            {
                leaving.beads.push_back(bead);
            }
        }
        exports_.push_back(std::move(leaving));
    }
    imports_.clear();
    for (const int guest : guests_)
    {
        imports_.push_back({guest, 0, 0});
    }
}

std::vector<std::vector<double>> BeadExchange::swap(const std::vector<int>& toRanks,
    const std::vector<std::vector<double>>& out, const std::vector<int>& fromRanks) const
{
    std::vector<MPI_Request> requests;
    const std::vector<double>* toSelf = nullptr;
    for (std::size_t i = 0; i < toRanks.size(); ++i)
    {
        if (toRanks[i] == rank_)
        {
            toSelf = &out[i];
            continue;
        }
        requests.emplace_back();
        MPI_Isend(out[i].data(), static_cast<int>(out[i].size()), MPI_DOUBLE, toRanks[i], messageTag, communicator_,
            &requests.back());
        bytesSent_ += out[i].size() * sizeof(double);
    }
    std::vector<std::vector<double>> in(fromRanks.size());
    for (std::size_t i = 0; i < fromRanks.size(); ++i)
    {
        if (fromRanks[i] == rank_)
        {
            // There is one: both plans compare this rank's own two boxes.
            in[i] = toSelf ? *toSelf : std::vector<double>();
            continue;
        }
        MPI_Status status;
        int count = 0;
        MPI_Probe(fromRanks[i], messageTag, communicator_, &status);
        MPI_Get_count(&status, MPI_DOUBLE, &count);
        in[i].resize(static_cast<std::size_t>(count));
        MPI_Recv(in[i].data(), count, MPI_DOUBLE, fromRanks[i], messageTag, communicator_, MPI_STATUS_IGNORE);
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    return in;
}

void BeadExchange::send(const BeadsView& beads, const Reactions& reactions)
{
    constexpr std::size_t size = sizeof(VisitingBead) / sizeof(double);
    static_assert(std::is_standard_layout_v<VisitingBead> && sizeof(VisitingBead) % sizeof(double) == 0);

    beadCount_ = beads.size();
    makePlan(beads);

    std::vector<int> toRanks;
    std::vector<std::vector<double>> out;
    for (const Exports& leaving : exports_)
    {
        toRanks.push_back(leaving.rank);
        std::vector<double>& message = out.emplace_back(leaving.beads.size() * size);
        double* place = message.data();
        for (const Eigen::Index bead : leaving.beads)
        {
            const VisitingBead visit = visitFrom(beads, reactions, bead);
            std::copy_n(reinterpret_cast<const double*>(&visit), size, place);
            place += size;
        }
    }
    std::vector<int> fromRanks;
    for (const Imports& arriving : imports_)
    {
        fromRanks.push_back(arriving.rank);
    }

    visitors_.clear();
    const std::vector<std::vector<double>> in = swap(toRanks, out, fromRanks);
    for (std::size_t i = 0; i < in.size(); ++i)
    {
        const std::size_t count = in[i].size() / size;
        imports_[i].first = static_cast<Eigen::Index>(visitors_.size());
        imports_[i].count = static_cast<Eigen::Index>(count);
        for (std::size_t visit = 0; visit < count; ++visit)
        {
            std::copy_n(&in[i][visit * size], size, reinterpret_cast<double*>(&visitors_.emplace_back()));
        }
    }
}

Eigen::MatrixXd BeadExchange::sumAtHome(const Eigen::MatrixXd& perVisitor) const
{
    const Eigen::Index width = perVisitor.rows();
    std::vector<int> toRanks;
    std::vector<std::vector<double>> out;
    for (const Imports& hosted : imports_)
    {
        toRanks.push_back(hosted.rank);
        const double* first = perVisitor.data() + hosted.first * width;
        out.emplace_back(first, first + hosted.count * width);
    }
    std::vector<int> fromRanks;
    for (const Exports& home : exports_)
    {
        fromRanks.push_back(home.rank);
    }

    Eigen::MatrixXd perBead = Eigen::MatrixXd::Zero(width, beadCount_);
    const std::vector<std::vector<double>> in = swap(toRanks, out, fromRanks);
    for (std::size_t i = 0; i < in.size(); ++i)
    {
        const double* column = in[i].data();
        for (const Eigen::Index bead : exports_[i].beads)
        {
            perBead.col(bead) += Eigen::Map<const Eigen::VectorXd>(column, width);
            column += width;
        }
    }
    return perBead;
}

Eigen::MatrixXd BeadExchange::toVisitors(const Eigen::MatrixXd& perBead) const
{
    const Eigen::Index width = perBead.rows();
    std::vector<int> toRanks;
    std::vector<std::vector<double>> out;
    for (const Exports& home : exports_)
    {
        toRanks.push_back(home.rank);
        std::vector<double>& message = out.emplace_back();
        message.reserve(home.beads.size() * static_cast<std::size_t>(width));
        for (const Eigen::Index bead : home.beads)
        {
            message.insert(message.end(), perBead.col(bead).begin(), perBead.col(bead).end());
        }
    }
    std::vector<int> fromRanks;
    for (const Imports& hosted : imports_)
    {
        fromRanks.push_back(hosted.rank);
    }

    Eigen::MatrixXd perVisitor(width, static_cast<Eigen::Index>(visitors_.size()));
    const std::vector<std::vector<double>> in = swap(toRanks, out, fromRanks);
    for (std::size_t i = 0; i < in.size(); ++i)
    {
        perVisitor.middleCols(imports_[i].first, imports_[i].count) =
            Eigen::Map<const Eigen::MatrixXd>(in[i].data(), width, imports_[i].count);
    }
    return perVisitor;
}

} // namespace clepsydra
