// SPDX-License-Identifier: BSD-3-Clause
// The objects of a picture: surfaces and shapes, whole or cut by planes, opaque or transparent.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/math/ball.h"
#include "core/render/look.h"

namespace meniscus {

struct Coloring;
struct Shapes;
struct Surface;

/// What lies behind this plane is cut away: points with dot(normal, x) >= offset.
struct ClipPlane {
  glm::dvec3 normal{0.0, 0.0, 1.0};  ///< of length 1
  double offset = 0.0;               ///< Å
};

/// How the solid looks where a plane cuts it.
struct CapStyle {
  std::optional<glm::vec3> color;  ///< sRGB; nothing: that of the atom whose van der Waals sphere is nearest
  double hatching = 0.0;           ///< Å between dark lines on the cap; 0: none
};

/// Across the lines of hatching, of length √2. With the distance along it in units of CapStyle::hatching, a line begins
/// at each whole number and is kHatchedShare wide; there linear light is kHatchedLight of what it is beside them.
glm::dvec3 hatching_direction(const glm::dvec3& normal);
inline constexpr double kHatchedShare = 0.3;
inline constexpr float kHatchedLight = 0.35f;

/// A surface or shapes with their colours. What it points to must stay until the picture is made.
struct PictureObject {
  const Surface* surface = nullptr;  ///< this one,
  const Shapes* shapes = nullptr;    ///< or this
  /// One colour for each of Surface::atoms; for shapes, for each of Structure::atoms.
  const Coloring* coloring = nullptr;
  /// Kept is what lies before all of them; where they cut there are caps: sections of the solid within.
  std::vector<ClipPlane> clip;
  CapStyle cap;
  /// Where a ray goes along a surface that is seen through, it sees more of it: opacity is that of a thin film.
  bool thickens = false;
  MaterialRequest material;  ///< what differs from the look's
};

/// Returns the objects of a picture of one surface as it is.
inline std::array<PictureObject, 1> whole_surface(const Surface& surface, const Coloring& coloring) {
  std::array<PictureObject, 1> objects;
  objects[0].surface = &surface;
  objects[0].coloring = &coloring;
  return objects;
}

/// True if only layers show it as it is: cut, seen through, or shapes.
bool needs_layers(const PictureObject& object);

/// What encloses them: atoms of surfaces, spheres and ends of cylinders, corners of meshes as balls without size.
std::vector<Ball> enclosing_balls(std::span<const PictureObject> objects);

/// The same without what planes cut away as a whole.
std::vector<Ball> kept_balls(std::span<const PictureObject> objects);

}  // namespace meniscus
