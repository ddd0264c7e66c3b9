#include "output/beadWriter.h"

#include "couplingState.h"
#include "output/vtkBeads.h"
#include "output/vtkSeries.h"

#include "OSspecific.H"
#include "Pstream.H"
#include "labelList.H"
#include "scalarList.H"

#include <algorithm>
#include <numeric>
#include <vector>

namespace clepsydra
{

namespace
{

/// How beads travel to the master: position, velocity, angular velocity, radius, void fraction.
constexpr Eigen::Index packedSize = 11;
using Packed = Eigen::Matrix<double, packedSize, Eigen::Dynamic>;

Foam::scalarList pack(const BeadsView& beads)
{
    Foam::scalarList values(static_cast<Foam::label>(packedSize * beads.size()));
    Eigen::Map<Packed> packed(values.data(), packedSize, beads.size());
    packed.topRows<3>() = beads.position;
    packed.middleRows<3>(3) = beads.velocity;
    packed.middleRows<3>(6) = beads.angularVelocity;
    packed.row(9) = beads.radius.matrix().transpose();
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        packed(10, bead) = beads.state != nullptr ? beads.state[bead].fluid.voidFraction : 1.0;
    }
    return values;
}

/// The beads of all ranks by id; empty but on the master. Collective.
DrawnBeads gather(const BeadsView& beads)
{
    using namespace Foam;

    List<labelList> idsOfRanks(Pstream::nProcs());
    idsOfRanks[Pstream::myProcNo()] = labelList(beads.id.begin(), beads.id.end());
    Pstream::gatherList(idsOfRanks);
    List<scalarList> valuesOfRanks(Pstream::nProcs());
    valuesOfRanks[Pstream::myProcNo()] = pack(beads);
    Pstream::gatherList(valuesOfRanks);
    if (!Pstream::master())
    {
        return {};
    }

    std::vector<int> ids;
    std::vector<double> values;
    for (label rank = 0; rank < Pstream::nProcs(); ++rank)
    {
        ids.insert(ids.end(), idsOfRanks[rank].begin(), idsOfRanks[rank].end());
        values.insert(values.end(), valuesOfRanks[rank].begin(), valuesOfRanks[rank].end());
    }
    std::vector<Eigen::Index> order(ids.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return ids[a] < ids[b]; });

    const auto count = static_cast<Eigen::Index>(ids.size());
    const Packed sorted = Eigen::Map<const Packed>(values.data(), packedSize, count)(Eigen::all, order);
    DrawnBeads drawn;
    drawn.id = Eigen::Map<const Eigen::ArrayXi>(ids.data(), count)(order);
    drawn.position = sorted.topRows<3>();
    drawn.velocity = sorted.middleRows<3>(3);
    drawn.angularVelocity = sorted.middleRows<3>(6);
    drawn.radius = sorted.row(9).transpose();
    drawn.voidFraction = sorted.row(10).transpose();
    return drawn;
}

} // namespace

BeadWriter::BeadWriter(const Foam::Time& time)
    : folder_(time.globalPath() / "VTK")
{
    using namespace Foam;

    if (Pstream::master())
    {
        try
        {
            series_ = std::make_unique<VtkSeries>(std::string(folder_ / "beads.pvd"), time.startTime().value());
        }
        catch (const std::runtime_error& error)
        {
            FatalErrorInFunction << error.what() << exit(FatalError);
        }
    }
}

BeadWriter::~BeadWriter() = default;

void BeadWriter::write(const BeadsView& beads, double time)
{
    using namespace Foam;

    const DrawnBeads drawn = gather(beads);
    if (!Pstream::master())
    {
        return;
    }
    const fileName name = "beads_" + Time::timeName(time) + ".vtp";
    try
    {
        mkDir(folder_);
        writeVtp(std::string(folder_ / name), drawn);
        series_->add(time, std::string(name));
    }
    catch (const std::runtime_error& error)
    {
        FatalErrorInFunction << error.what() << exit(FatalError);
    }
}

} // namespace clepsydra
