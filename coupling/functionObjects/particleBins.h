#pragma once

#include "engine/particles.h"

#include "boundBox.H"
#include "label.H"

#include <Eigen/Dense>

namespace clepsydra
{

/// A box that is divided into equal bins along the three axes. Bins are numbered from 0, along x first and along z last.
class ParticleBins
{
public:
    /// Most bins that may be asked for.
    static constexpr double most = 1e6;

    /// A size that exceeds the box gives one bin along that axis. The last bin along an axis ends at the box, so it is
    /// narrower where the size does not divide the box.
    /// \pre all sizes are positive, the box has a volume, and numberOf(box, size) <= most
    ParticleBins(const Foam::boundBox& box, const Vector3d& size);

    /// Number of bins, as a floating-point number because a wrong size can give more than an integer holds.
    static double numberOf(const Foam::boundBox& box, const Vector3d& size);

    Foam::label count() const
    {
        return counts_.prod();
    }

    /// Number of the bin in which a point lies; -1 outside of the box. A point on the face between two bins is in the
    /// upper one.
    Foam::label binOf(const Vector3d& point) const;

    Vector3d centre(Foam::label bin) const;

    /// [m3]
    double volume(Foam::label bin) const;

    const Vector3d& lowest() const
    {
        return lowest_;
    }

    const Vector3d& highest() const
    {
        return highest_;
    }

    const Vector3d& size() const
    {
        return size_;
    }

    /// Whether the bins are the same but for the rounding of written numbers.
    bool areLike(const ParticleBins& other) const;

private:
    using Place = Eigen::Array<Foam::label, 3, 1>;

    static Eigen::Array3d counts(const Foam::boundBox& box, const Vector3d& size);
    Place placeOf(Foam::label bin) const;
    Vector3d lowerCorner(Foam::label bin) const;
    Vector3d upperCorner(Foam::label bin) const;

    Vector3d lowest_;
    Vector3d highest_;
    Vector3d size_;
    Place counts_;
};

} // namespace clepsydra
