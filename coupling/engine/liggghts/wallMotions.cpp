#include "engine/liggghts/wallMotions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

namespace clepsydra
{

namespace
{

using Eigen::Vector3d;
using Tokens = std::vector<std::string>;

/// The numbers that follow a word in the command; none where there are fewer.
/// \param first  index from which on the word is looked for
template<std::size_t Count>
std::optional<std::array<double, Count>> numbersAfter(
    const Tokens& tokens, const std::string& word, std::size_t first = 0)
{
    const auto found =
        std::find(tokens.begin() + static_cast<std::ptrdiff_t>(std::min(first, tokens.size())), tokens.end(), word);
    if (std::distance(found, tokens.end()) <= static_cast<std::ptrdiff_t>(Count))
    {
        return std::nullopt;
    }
    std::array<double, Count> numbers{};
    for (std::size_t i = 0; i < Count; ++i)
    {
        std::istringstream stream(*(found + 1 + static_cast<std::ptrdiff_t>(i)));
        if (!(stream >> numbers[i]) || stream.peek() != std::istringstream::traits_type::eof())
        {
            return std::nullopt;
        }
    }
    return numbers;
}

std::optional<Vector3d> vectorAfter(const Tokens& tokens, const std::string& word)
{
    const auto numbers = numbersAfter<3>(tokens, word);
    return numbers ? std::optional<Vector3d>(Vector3d(numbers->data())) : std::nullopt;
}

bool has(const Tokens& tokens, const std::string& word)
{
    return std::find(tokens.begin(), tokens.end(), word) != tokens.end();
}

/// A rotation about the words `origin` and `axis` of a command.
/// \param speed  [rad/s]; none where the command does not state it
std::optional<RigidMotion> rotation(const Tokens& tokens, std::optional<double> speed)
{
    const std::optional<Vector3d> origin = vectorAfter(tokens, "origin");
    const std::optional<Vector3d> axis = vectorAfter(tokens, "axis");
    if (!origin || !axis || !speed || !(axis->norm() > 0) || !std::isfinite(*speed))
    {
        return std::nullopt;
    }
    return RigidMotion{Vector3d::Zero(), *origin, *speed * axis->normalized()};
}

void set(WallMotion& wall, const std::optional<RigidMotion>& motion)
{
    if (motion)
    {
        wall.motion = *motion;
    }
    else
    {
        wall.unknownBecause = "its motion is not stated in numbers";
    }
}

WallMotion ofMovedMesh(const ScriptFacts::Fix& fix)
{
    WallMotion wall{fix.id, fix.command, "move/mesh", {}, {}};
    const Tokens tokens = tokensOf(fix.command.text);
    if (has(tokens, "rotate"))
    {
        const auto period = numbersAfter<1>(tokens, "period");
        set(wall, rotation(tokens, period ? std::optional<double>(2 * M_PI / period->front()) : std::nullopt));
    }
    else if (has(tokens, "linear"))
    {
        const std::optional<Vector3d> velocity = vectorAfter(tokens, "linear");
        set(wall, velocity ? std::optional<RigidMotion>(RigidMotion{*velocity, Vector3d::Zero(), Vector3d::Zero()})
                           : std::nullopt);
    }
    else
    {
        wall.unknownBecause = "only 'rotate' and 'linear' are constant motions";
    }
    return wall;
}

/// The words of `mesh/surface`; none where the surface is at rest.
std::optional<WallMotion> ofSurface(const ScriptFacts::Fix& fix)
{
    const Tokens tokens = tokensOf(fix.command.text);
    WallMotion wall{fix.id, fix.command, "surface_vel", {}, {}};
    if (has(tokens, wall.kind))
    {
        const std::optional<Vector3d> velocity = vectorAfter(tokens, wall.kind);
        set(wall, velocity ? std::optional<RigidMotion>(RigidMotion{*velocity, Vector3d::Zero(), Vector3d::Zero()})
                           : std::nullopt);
        return wall;
    }
    wall.kind = "surface_ang_vel";
    if (has(tokens, wall.kind))
    {
        const auto speed = numbersAfter<1>(tokens, "omega");
        set(wall, rotation(tokens, speed ? std::optional<double>(speed->front()) : std::nullopt));
        return wall;
    }
    return std::nullopt;
}

/// The word `shear` of a plane or cylinder: along an axis, or around the axis of a cylinder where it names another one.
std::optional<WallMotion> ofShearedWall(const ScriptFacts::Fix& fix)
{
    static const std::string axes = "xyz";
    const Tokens tokens = tokensOf(fix.command.text);
    const auto word = std::find(tokens.begin(), tokens.end(), "shear");
    if (word == tokens.end())
    {
        return std::nullopt;
    }
    WallMotion wall{fix.id, fix.command, "shear", {}, {}};
    const std::string axis = std::distance(word, tokens.end()) > 2 ? *(word + 1) : "";
    const auto speed = numbersAfter<1>(tokens, axis, static_cast<std::size_t>(word - tokens.begin()));
    const std::size_t along = axis.size() == 1 ? axes.find(axis) : std::string::npos;
    if (!speed || along == std::string::npos)
    {
        set(wall, std::nullopt);
        return wall;
    }
    const auto direction = [](std::size_t of) { return Vector3d(Vector3d::Unit(static_cast<Eigen::Index>(of))); };
    for (std::size_t ofCylinder = 0; ofCylinder < axes.size(); ++ofCylinder)
    {
        const std::string style = axes.substr(ofCylinder, 1) + "cylinder";
        if (!has(tokens, style) || ofCylinder == along)
        {
            continue;
        }
        if (style == "ycylinder")
        {
            wall.unknownBecause =
                "LIGGGHTS exchanges x and z of a ycylinder that rotates, so that its surface moves wrongly";
            return wall;
        }
        const auto cylinder = numbersAfter<3>(tokens, style);
        if (!cylinder)
        {
            set(wall, std::nullopt);
            return wall;
        }
        Vector3d origin = Vector3d::Zero();
        origin[static_cast<Eigen::Index>((ofCylinder + 1) % 3)] = (*cylinder)[1];
        origin[static_cast<Eigen::Index>((ofCylinder + 2) % 3)] = (*cylinder)[2];
        wall.motion = {Vector3d::Zero(), origin, speed->front() * direction(ofCylinder)};
        return wall;
    }
    wall.motion.velocity = speed->front() * direction(along);
    return wall;
}

bool isAtRest(const WallMotion& wall)
{
    return wall.unknownBecause.empty() && wall.motion.velocity.isZero() && wall.motion.angularVelocity.isZero();
}

} // namespace

std::vector<WallMotion> wallMotions(const ScriptFacts& facts)
{
    std::vector<WallMotion> walls;
    const auto add = [&](std::optional<WallMotion> wall) {
        if (wall && !isAtRest(*wall))
        {
            walls.push_back(*std::move(wall));
        }
    };
    for (const ScriptFacts::Fix& fix : facts.fixes)
    {
        if (fix.style == "move/mesh")
        {
            add(ofMovedMesh(fix));
        }
        else if (fix.style.rfind("mesh/surface", 0) == 0)
        {
            add(ofSurface(fix));
        }
        else if (fix.style.rfind("wall/gran", 0) == 0)
        {
            add(ofShearedWall(fix));
        }
    }
    // Several fixes may move one mesh, whose motions then add up.
    for (WallMotion& wall : walls)
    {
        const auto meshOf = [](const WallMotion& of) {
            const Tokens tokens = tokensOf(of.command.text);
            const auto word = std::find(tokens.begin(), tokens.end(), "mesh");
            return of.kind == "move/mesh" && std::distance(word, tokens.end()) > 1 ? *(word + 1) : std::string();
        };
        const std::string mesh = meshOf(wall);
        if (!mesh.empty() && std::count_if(walls.begin(), walls.end(), [&](const WallMotion& other) {
                return meshOf(other) == mesh;
            }) > 1)
        {
            wall.unknownBecause = "several fixes move the mesh '" + mesh + '\'';
        }
    }
    return walls;
}

} // namespace clepsydra
