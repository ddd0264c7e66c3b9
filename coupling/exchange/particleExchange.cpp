#include "exchange/particleExchange.h"

#include "couplingState.h"

#include <algorithm>

namespace clepsydra
{

namespace
{

constexpr int messageTag = 51;

/// Margin on each side as a fraction of the box around a rank's particles. With it, a growing region is published ever
/// less often, and a rank does not receive many more particles than overlap its cells.
constexpr double roomAroundParticles = 0.25;

/// Box of each rank. Collective.
std::vector<Box> subdomainBounds(MPI_Comm communicator, const Box& own)
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
        // An empty box remains empty.
        boxes.emplace_back(Vector3d(of.head<3>()), Vector3d(of.tail<3>()));
    }
    return boxes;
}

Box boxAround(const ParticlesView& particles, double commonReach)
{
    Box around;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const SphereInFluid sphere = sphereInFluid(particles, particle);
        const Vector3d reach = Vector3d::Constant(std::max(sphere.radius, commonReach));
        around.extend(sphere.centre - reach);
        around.extend(sphere.centre + reach);
    }
    return around;
}

/// A number for each image; different for all images within 500 lengths of the box.
int imageNumber(const Eigen::Vector3i& periods)
{
    constexpr int most = 1000;
    return periods.x() + most * (periods.y() + most * periods.z());
}

} // namespace

ParticleExchange::ParticleExchange(
    MPI_Comm communicator, const Box& cells, double commonReach, const PeriodicBox& periodic)
    : communicator_(communicator),
      cells_(cells),
      commonReach_(commonReach),
      periodic_(periodic),
      subdomainBounds_(subdomainBounds(communicator, cells))
{
    MPI_Comm_rank(communicator_, &rank_);
}

void ParticleExchange::setCells(const Box& cells)
{
    cells_ = cells;
    subdomainBounds_ = subdomainBounds(communicator_, cells);
    planHolds_ = false;
}

GhostParticle ParticleExchange::ghostOf(
    const ParticlesView& particles, Eigen::Index particle, const Eigen::Vector3i& periods) const
{
    const SphereInFluid sphere = sphereInFluid(particles, particle);
    return {periodic_.image(sphere.centre, periods), sphere.radius, static_cast<double>(particles.id[particle]),
        static_cast<double>(imageNumber(periods))};
}

void ParticleExchange::publishBounds(const Box& particles)
{
    if (!publishedBounds_.contains(particles))
    {
        const Vector3d room = roomAroundParticles * particles.sizes();
        publishedBounds_.extend(Box(particles.min() - room, particles.max() + room));
    }
    const std::vector<Box> published = subdomainBounds(communicator_, publishedBounds_);
    receivingRanks_.clear();
    sendingRanks_.clear();
    const auto add = [&](int rank) {
        const auto of = static_cast<std::size_t>(rank);
        if (periodic_.imagesIntersect(publishedBounds_, subdomainBounds_[of]))
        {
            receivingRanks_.push_back(rank);
        }
        if (periodic_.imagesIntersect(published[of], cells_))
        {
            sendingRanks_.push_back(rank);
        }
    };
    add(rank_);
    for (int rank = 0; rank < static_cast<int>(published.size()); ++rank)
    {
        if (rank != rank_)
        {
            add(rank);
        }
    }
}

void ParticleExchange::listExports(const ParticlesView& particles)
{
    exports_.resize(receivingRanks_.size());
    for (std::size_t i = 0; i < exports_.size(); ++i)
    {
        Exports& leaving = exports_[i];
        leaving.rank = receivingRanks_[i];
        leaving.particles.clear();
        leaving.periods.clear();
        const Box& cells = subdomainBounds_[static_cast<std::size_t>(leaving.rank)];
        for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
        {
            const SphereInFluid sphere = sphereInFluid(particles, particle);
            periodic_.forEachImage(cells, sphere.centre, std::max(sphere.radius, commonReach_),
                [&](const Vector3d&, const Eigen::Vector3i& periods) {
                    leaving.particles.push_back(particle);
                    leaving.periods.push_back(periods);
                });
        }
    }
}

void ParticleExchange::swap(const std::vector<int>& toRanks, const std::vector<int>& fromRanks) const
{
    requests_.clear();
    std::vector<double>* toSelf = nullptr;
    for (std::size_t i = 0; i < toRanks.size(); ++i)
    {
        std::vector<double>& message = outgoing_[i];
        if (toRanks[i] == rank_)
        {
            toSelf = &message;
            continue;
        }
        requests_.emplace_back();
        MPI_Isend(message.data(), static_cast<int>(message.size()), MPI_DOUBLE, toRanks[i], messageTag, communicator_,
            &requests_.back());
        bytesSent_ += message.size() * sizeof(double);
    }
    incoming_.resize(std::max(incoming_.size(), fromRanks.size()));
    for (std::size_t i = 0; i < fromRanks.size(); ++i)
    {
        std::vector<double>& message = incoming_[i];
        if (fromRanks[i] == rank_)
        {
            // Such a message exists, because both lists of ranks compare the same two boxes of this rank.
            message.clear();
            if (toSelf)
            {
                message.swap(*toSelf);
            }
            continue;
        }
        MPI_Status status;
        int count = 0;
        MPI_Probe(fromRanks[i], messageTag, communicator_, &status);
        MPI_Get_count(&status, MPI_DOUBLE, &count);
        message.resize(static_cast<std::size_t>(count));
        MPI_Recv(message.data(), count, MPI_DOUBLE, fromRanks[i], messageTag, communicator_, MPI_STATUS_IGNORE);
    }
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}

void ParticleExchange::send(const ParticlesView& particles, const Eigen::MatrixXd& contributions)
{
    bool asPlanned = false;
    while (!asPlanned)
    {
        RankTotals totals(communicator_);
        sendAsPlanned(particles, contributions, totals);
        asPlanned = totals.reduce();
    }
}

void ParticleExchange::sendAsPlanned(
    const ParticlesView& particles, const Eigen::MatrixXd& contributions, RankTotals& totals)
{
    constexpr std::size_t ghostSize = sizeof(GhostParticle) / sizeof(double);
    static_assert(std::is_standard_layout_v<GhostParticle> && sizeof(GhostParticle) % sizeof(double) == 0);
    const std::size_t rows = static_cast<std::size_t>(contributions.rows());
    const std::size_t size = ghostSize + rows;

    particleCount_ = particles.size();
    const Box around = boxAround(particles, commonReach_);
    if (!planHolds_)
    {
        publishBounds(around);
    }
    totals.require({{}, {publishedBounds_.contains(around) ? 0.0 : 1.0}}, [this](const RankNumbers& all) {
        planHolds_ = all.maxima[0] == 0;
        return planHolds_;
    });
    listExports(particles);

    outgoing_.resize(std::max(outgoing_.size(), exports_.size()));
    for (std::size_t i = 0; i < exports_.size(); ++i)
    {
        const Exports& leaving = exports_[i];
        std::vector<double>& message = outgoing_[i];
        message.resize(leaving.particles.size() * size);
        double* place = message.data();
        for (std::size_t listed = 0; listed < leaving.particles.size(); ++listed)
        {
            const Eigen::Index particle = leaving.particles[listed];
            const GhostParticle ghost = ghostOf(particles, particle, leaving.periods[listed]);
            place = std::copy_n(reinterpret_cast<const double*>(&ghost), ghostSize, place);
            place = std::copy_n(contributions.col(particle).data(), rows, place);
        }
    }
    swap(receivingRanks_, sendingRanks_);

    imports_.clear();
    std::size_t count = 0;
    for (std::size_t i = 0; i < sendingRanks_.size(); ++i)
    {
        const std::size_t arrived = incoming_[i].size() / size;
        imports_.push_back({sendingRanks_[i], static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(arrived)});
        count += arrived;
    }
    ghosts_.resize(count);
    contributionRows_ = contributions.rows();
    contributions_.resize(rows * count);
    double* contribution = contributions_.data();
    std::size_t ghost = 0;
    for (std::size_t i = 0; i < imports_.size(); ++i)
    {
        const double* place = incoming_[i].data();
        for (Eigen::Index arrived = 0; arrived < imports_[i].count; ++arrived)
        {
            std::copy_n(place, ghostSize, reinterpret_cast<double*>(&ghosts_[ghost++]));
            contribution = std::copy_n(place + ghostSize, rows, contribution);
            place += size;
        }
    }
}

Eigen::MatrixXd ParticleExchange::sumAtOwners(const Eigen::MatrixXd& perGhost) const
{
    const Eigen::Index width = perGhost.rows();
    outgoing_.resize(std::max(outgoing_.size(), imports_.size()));
    for (std::size_t i = 0; i < imports_.size(); ++i)
    {
        const double* first = perGhost.data() + imports_[i].first * width;
        outgoing_[i].assign(first, first + imports_[i].count * width);
    }
    swap(sendingRanks_, receivingRanks_);

    Eigen::MatrixXd perParticle = Eigen::MatrixXd::Zero(width, particleCount_);
    for (std::size_t i = 0; i < exports_.size(); ++i)
    {
        const double* column = incoming_[i].data();
        for (const Eigen::Index particle : exports_[i].particles)
        {
            perParticle.col(particle) += Eigen::Map<const Eigen::VectorXd>(column, width);
            column += width;
        }
    }
    return perParticle;
}

Eigen::MatrixXd ParticleExchange::toGhosts(const Eigen::MatrixXd& perParticle) const
{
    const Eigen::Index width = perParticle.rows();
    outgoing_.resize(std::max(outgoing_.size(), exports_.size()));
    for (std::size_t i = 0; i < exports_.size(); ++i)
    {
        std::vector<double>& message = outgoing_[i];
        message.clear();
        message.reserve(exports_[i].particles.size() * static_cast<std::size_t>(width));
        for (const Eigen::Index particle : exports_[i].particles)
        {
            message.insert(message.end(), perParticle.col(particle).begin(), perParticle.col(particle).end());
        }
    }
    swap(receivingRanks_, sendingRanks_);

    Eigen::MatrixXd perGhost(width, static_cast<Eigen::Index>(ghosts_.size()));
    for (std::size_t i = 0; i < imports_.size(); ++i)
    {
        perGhost.middleCols(imports_[i].first, imports_[i].count) =
            Eigen::Map<const Eigen::MatrixXd>(incoming_[i].data(), width, imports_[i].count);
    }
    return perGhost;
}

} // namespace clepsydra
