#pragma once

#include <Eigen/Core>

#include <array>
#include <sstream>
#include <string>
#include <vector>

namespace clepsydra::tests
{

using Triangle = std::array<Eigen::Vector3d, 3>;

/// A file of triangles for LIGGGHTS, which calculates their normals itself.
inline std::string stlText(const std::vector<Triangle>& triangles)
{
    std::ostringstream text;
    text.precision(17);
    text << "solid walls\n";
    for (const Triangle& triangle : triangles)
    {
        text << "facet normal 0 0 0\nouter loop\n";
        for (const Eigen::Vector3d& corner : triangle)
        {
            text << "vertex " << corner.x() << ' ' << corner.y() << ' ' << corner.z() << '\n';
        }
        text << "endloop\nendfacet\n";
    }
    text << "endsolid walls\n";
    return text.str();
}

} // namespace clepsydra::tests
