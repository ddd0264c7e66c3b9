#include "support/demScript.h"

#include "support/foamFile.h"

#include <cmath>
#include <random>
#include <sstream>

namespace clepsydra::tests
{

namespace
{

constexpr int particleMaterial = 1;
constexpr int wallMaterial = 2;

} // namespace

std::string DemScript::text(const Box& box) const
{
    const double side = wallFriction < 0 ? friction : wallFriction;
    const double margin = diameter;
    std::ostringstream os;
    os.precision(std::numeric_limits<double>::max_digits10);

    os << "atom_style granular\natom_modify map array\nboundary";
    for (const bool periodic : box.periodic)
    {
        os << (periodic ? " p" : " f");
    }
    os << "\nnewton off\ncommunicate single vel yes\n"
          "units si\n";
    if (readRestart.empty())
    {
        os << "region domain block";
        for (int axis = 0; axis < 3; ++axis)
        {
            const double outside = box.periodic[axis] ? 0 : margin;
            os << ' ' << box.lower[axis] - outside << ' ' << box.upper[axis] + outside;
        }
        os << " units box\ncreate_box " << wallMaterial << " domain\n";
    }
    else
    {
        os << "read_restart " << readRestart << '\n';
    }
    os << "neighbor " << 0.25 * diameter << " bin\nneigh_modify delay 0\n"
       << "fix young all property/global youngsModulus peratomtype " << youngsModulus << ' ' << youngsModulus << '\n'
       << "fix poisson all property/global poissonsRatio peratomtype " << poissonsRatio << ' ' << poissonsRatio << '\n'
       << "fix restitution all property/global coefficientRestitution peratomtypepair 2 " << restitution << ' '
       << restitution << ' ' << restitution << ' ' << restitution << '\n'
       << "fix friction all property/global coefficientFriction peratomtypepair 2 " << friction << ' ' << side << ' '
       << side << ' ' << side << '\n'
       << "pair_style gran model hertz tangential history\npair_coeff * *\n"
       << "timestep " << timeStep << '\n'
       << "fix gravity all gravity " << gravity << " vector 0 0 -1\n";

    if (walls)
    {
        const char axisName[] = {'x', 'y', 'z'};
        for (int axis = 0; axis < 3; ++axis)
        {
            if (box.periodic[axis])
            {
                continue;
            }
            const double low = axis == 2 && !std::isnan(floor) ? floor : box.lower[axis];
            for (const bool upper : {false, true})
            {
                os << "fix wall" << axisName[axis] << (upper ? "Upper" : "Lower")
                   << " all wall/gran model hertz tangential history primitive type " << wallMaterial << ' '
                   << axisName[axis] << "plane " << (upper ? box.upper[axis] : low) << '\n';
            }
        }
    }
    for (const Eigen::Vector3d& particle : particles)
    {
        os << "create_atoms " << particleMaterial << " single " << particle.x() << ' ' << particle.y() << ' '
           << particle.z() << " units box\n";
    }
    if (!particles.empty())
    {
        os << "set group all diameter " << diameter << " density " << density << '\n';
    }
    if (!fixed)
    {
        os << "fix integrate all nve/sphere\n";
    }
    if (dumpEvery > 0)
    {
        os << "dump particles all custom " << dumpEvery
           << " DEM/particles.dump id x y z vx vy vz\ndump_modify particles sort id format \"%d %.12g %.12g %.12g "
              "%.12g %.12g "
              "%.12g\"\n";
    }
    os << more << '\n';
    return os.str();
}

std::vector<Eigen::Vector3d> bodyCentredLattice(const Box& box, const Eigen::Vector3i& cells)
{
    const Eigen::Vector3d spacing = box.size().cwiseQuotient(cells.cast<double>());
    std::vector<Eigen::Vector3d> points;
    for (const Eigen::Vector3d& corner : simpleLattice(box, cells))
    {
        points.emplace_back(corner - 0.25 * spacing);
        points.emplace_back(corner + 0.25 * spacing);
    }
    return points;
}

std::vector<Eigen::Vector3d> simpleLattice(const Box& box, const Eigen::Vector3i& cells)
{
    const Eigen::Vector3d spacing = box.size().cwiseQuotient(cells.cast<double>());
    std::vector<Eigen::Vector3d> points;
    for (int k = 0; k < cells.z(); ++k)
    {
        for (int j = 0; j < cells.y(); ++j)
        {
            for (int i = 0; i < cells.x(); ++i)
            {
                points.emplace_back(box.lower + spacing.cwiseProduct(Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5)));
            }
        }
    }
    return points;
}

void jitter(std::vector<Eigen::Vector3d>& points, double amplitude, unsigned seed)
{
    std::mt19937 random(seed);
    // Not std::uniform_real_distribution: its numbers differ between libraries.
    const auto symmetric = [&] {
        return 2.0 * static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 1.0;
    };
    for (Eigen::Vector3d& point : points)
    {
        const double x = symmetric();
        const double y = symmetric();
        const double z = symmetric();
        point += amplitude * Eigen::Vector3d(x, y, z);
    }
}

} // namespace clepsydra::tests
