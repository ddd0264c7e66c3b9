#include "functionObjects/particleBins.h"

#include "vectors.h"

#include <cmath>

namespace clepsydra
{

namespace
{

/// In bins: a quotient of lengths that should be whole may miss it by rounding.
constexpr double rounding = 1e-6;

} // namespace

ParticleBins::ParticleBins(const Foam::boundBox& box, const Vector3d& size)
    : lowest_(toEigen(box.min())),
      highest_(toEigen(box.max())),
      size_(size.cwiseMin(highest_ - lowest_)),
      counts_(counts(box, size).cast<Foam::label>())
{}

Eigen::Array3d ParticleBins::counts(const Foam::boundBox& box, const Vector3d& size)
{
    return (toEigen(box.span()).cwiseQuotient(size).array() - rounding).ceil().max(1);
}

double ParticleBins::numberOf(const Foam::boundBox& box, const Vector3d& size)
{
    return counts(box, size).prod();
}

Foam::label ParticleBins::binOf(const Vector3d& point) const
{
    if ((point.array() < lowest_.array()).any() || (point.array() > highest_.array()).any())
    {
        return -1;
    }
    // A point at the upper end of the box belongs to the last bin.
    const Place place = ((point - lowest_).cwiseQuotient(size_).array().floor().cast<Foam::label>()).min(counts_ - 1);
    return place.x() + counts_.x() * (place.y() + counts_.y() * place.z());
}

ParticleBins::Place ParticleBins::placeOf(Foam::label bin) const
{
    const Foam::label row = bin / counts_.x();
    return {bin % counts_.x(), row % counts_.y(), row / counts_.y()};
}

Vector3d ParticleBins::lowerCorner(Foam::label bin) const
{
    return lowest_ + placeOf(bin).cast<double>().matrix().cwiseProduct(size_);
}

Vector3d ParticleBins::upperCorner(Foam::label bin) const
{
    return (lowerCorner(bin) + size_).cwiseMin(highest_);
}

Vector3d ParticleBins::centre(Foam::label bin) const
{
    return 0.5 * (lowerCorner(bin) + upperCorner(bin));
}

double ParticleBins::volume(Foam::label bin) const
{
    return (upperCorner(bin) - lowerCorner(bin)).prod();
}

bool ParticleBins::areLike(const ParticleBins& other) const
{
    const double tolerance = rounding * size_.minCoeff();
    const auto isNear = [tolerance](const Vector3d& a, const Vector3d& b) {
        return (a - b).cwiseAbs().maxCoeff() <= tolerance;
    };
    return (counts_ == other.counts_).all() && isNear(lowest_, other.lowest_) && isNear(highest_, other.highest_)
           && isNear(size_, other.size_);
}

} // namespace clepsydra
