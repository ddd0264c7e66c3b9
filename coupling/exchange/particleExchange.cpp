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

void ParticleExchange::makePlan(const ParticlesView& particles)
{
    const Box around = boxAround(particles, commonReach_);
    int anyLeft = publishedBounds_.contains(around) ? 0 : 1;
    MPI_Allreduce(MPI_IN_PLACE, &anyLeft, 1, MPI_INT, MPI_MAX, communicator_);
    if (anyLeft != 0)
    {
        publishBounds(around);
    }
    exports_.clear();
    for (const int receivingRank : receivingRanks_)
    {
        Exports leaving{receivingRank, {}, {}};
        const Box& cells = subdomainBounds_[static_cast<std::size_t>(receivingRank)];
        for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
        {
            const SphereInFluid sphere = sphereInFluid(particles, particle);
            periodic_.forEachImage(cells, sphere.centre, std::max(sphere.radius, commonReach_),
                [&](const Vector3d&, const Eigen::Vector3i& periods) {
                    leaving.particles.push_back(particle);
                    leaving.periods.push_back(periods);
                });
        }
        exports_.push_back(std::move(leaving));
    }
    imports_.clear();
    for (const int sendingRank : sendingRanks_)
    {
        imports_.push_back({sendingRank, 0, 0});
    }
}

std::vector<std::vector<double>> ParticleExchange::swap(const std::vector<int>& toRanks,
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
            // Such a message exists, because both lists of ranks compare the same two boxes of this rank.
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

void ParticleExchange::send(const ParticlesView& particles, const Eigen::MatrixXd& contributions)
{
    constexpr std::size_t ghostSize = sizeof(GhostParticle) / sizeof(double);
    static_assert(std::is_standard_layout_v<GhostParticle> && sizeof(GhostParticle) % sizeof(double) == 0);
    const Eigen::Index rows = contributions.rows();
    const std::size_t size = ghostSize + static_cast<std::size_t>(rows);

    particleCount_ = particles.size();
    makePlan(particles);

    std::vector<int> toRanks;
    std::vector<std::vector<double>> out;
    for (const Exports& leaving : exports_)
    {
        toRanks.push_back(leaving.rank);
        std::vector<double>& message = out.emplace_back(leaving.particles.size() * size);
        double* place = message.data();
        for (std::size_t i = 0; i < leaving.particles.size(); ++i)
        {
            const Eigen::Index particle = leaving.particles[i];
            const GhostParticle ghost = ghostOf(particles, particle, leaving.periods[i]);
            place = std::copy_n(reinterpret_cast<const double*>(&ghost), ghostSize, place);
            place = std::copy_n(contributions.col(particle).data(), rows, place);
        }
    }
    std::vector<int> fromRanks;
    for (const Imports& arriving : imports_)
    {
        fromRanks.push_back(arriving.rank);
    }

    const std::vector<std::vector<double>> in = swap(toRanks, out, fromRanks);
    std::size_t count = 0;
    for (std::size_t i = 0; i < in.size(); ++i)
    {
        imports_[i].first = static_cast<Eigen::Index>(count);
        imports_[i].count = static_cast<Eigen::Index>(in[i].size() / size);
        count += in[i].size() / size;
    }
    ghosts_.resize(count);
    contributions_.resize(rows, static_cast<Eigen::Index>(count));
    for (std::size_t i = 0; i < in.size(); ++i)
    {
        const double* place = in[i].data();
        for (Eigen::Index ghost = imports_[i].first; ghost < imports_[i].first + imports_[i].count; ++ghost)
        {
            std::copy_n(place, ghostSize, reinterpret_cast<double*>(&ghosts_[static_cast<std::size_t>(ghost)]));
            std::copy_n(place + ghostSize, rows, contributions_.col(ghost).data());
            place += size;
        }
    }
}

Eigen::MatrixXd ParticleExchange::sumAtOwners(const Eigen::MatrixXd& perGhost) const
{
    const Eigen::Index width = perGhost.rows();
    std::vector<int> toRanks;
    std::vector<std::vector<double>> out;
    for (const Imports& received : imports_)
    {
        toRanks.push_back(received.rank);
        const double* first = perGhost.data() + received.first * width;
        out.emplace_back(first, first + received.count * width);
    }
    std::vector<int> fromRanks;
    for (const Exports& sent : exports_)
    {
        fromRanks.push_back(sent.rank);
    }

    Eigen::MatrixXd perParticle = Eigen::MatrixXd::Zero(width, particleCount_);
    const std::vector<std::vector<double>> in = swap(toRanks, out, fromRanks);
    for (std::size_t i = 0; i < in.size(); ++i)
    {
        const double* column = in[i].data();
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
    std::vector<int> toRanks;
    std::vector<std::vector<double>> out;
    for (const Exports& sent : exports_)
    {
        toRanks.push_back(sent.rank);
        std::vector<double>& message = out.emplace_back();
        message.reserve(sent.particles.size() * static_cast<std::size_t>(width));
        for (const Eigen::Index particle : sent.particles)
        {
            message.insert(message.end(), perParticle.col(particle).begin(), perParticle.col(particle).end());
        }
    }
    std::vector<int> fromRanks;
    for (const Imports& received : imports_)
    {
        fromRanks.push_back(received.rank);
    }

    Eigen::MatrixXd perGhost(width, static_cast<Eigen::Index>(ghosts_.size()));
    const std::vector<std::vector<double>> in = swap(toRanks, out, fromRanks);
    for (std::size_t i = 0; i < in.size(); ++i)
    {
        perGhost.middleCols(imports_[i].first, imports_[i].count) =
            Eigen::Map<const Eigen::MatrixXd>(in[i].data(), width, imports_[i].count);
    }
    return perGhost;
}

} // namespace clepsydra
