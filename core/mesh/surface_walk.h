// SPDX-License-Identifier: BSD-3-Clause
// Projects a point near a surface onto it, walking from face to face without a search.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus {

/// A point of the exact surface.
struct SurfacePoint {
  glm::dvec3 position{0.0};    ///< Å
  std::uint32_t face = kNone;  ///< into Surface::faces
};

/// Projects a point onto the surface, along the line to the nearest place of the probe's centre. The cones, wedges and
/// tetrahedra over the patches (theorem 1) tile the solid below the surface, and their walls are on the borders. A walk
/// that crosses a wall continues on the face on its other side. Points have to be nearer to the surface than its radii
/// of curvature.
class SurfaceWalk {
 public:
  /// `surface` must live as long. Walks may cross all borders.
  explicit SurfaceWalk(const Surface& surface);
  /// From now on no walk crosses these; per border.
  void bar(std::vector<bool> barred) { barred_ = std::move(barred); }

  /// The point of the surface under x for a walk that begins at `face`; nothing if it leads nowhere or to a bar.
  std::optional<SurfacePoint> below(const glm::dvec3& x, std::uint32_t face) const;
  /// The point of a border's circle nearest to x; nothing if it is not on the arc.
  std::optional<glm::dvec3> on_border(const glm::dvec3& x, std::uint32_t border) const;
  /// The point nearest to x of the cusps at a face and at its neighbours; nothing if there are none.
  std::optional<SurfacePoint> on_near_cusp(const glm::dvec3& x, std::uint32_t face) const;
  /// The unit normal towards the solvent at a point of a face.
  glm::dvec3 normal(const SurfacePoint& point) const;
  /// The touched atom whose contact is nearest to a point of a face.
  std::uint32_t nearest_atom(const SurfacePoint& point) const;
  /// The radius (Å) of the face's sphere, or of its torus' tube.
  double radius(std::uint32_t face) const;

 private:
  enum class Wall : std::uint8_t { plane, tube_low, tube_high, start, end };
  /// One side of a face, and who lives beyond.
  struct Side {
    glm::dvec3 normal{0.0};  ///< plane: away from the face
    double offset = 0.0;     ///< plane: its own; tube: the angle
    std::uint32_t border = kNone, beyond = kNone;
    Wall wall = Wall::plane;
  };
  /// Where x is seen from a face: the foot on its sphere or torus, and the wall that it is farthest beyond.
  struct Look {
    glm::dvec3 foot{0.0};
    const Side* crossed = nullptr;
    bool lost = false;  ///< no foot: x is in the middle of a sphere, or past the tip of a spindle
  };

  void list_sides(std::uint32_t face);
  bool on_patch(const glm::dvec3& foot, std::uint32_t face) const;
  Look look(const glm::dvec3& x, std::uint32_t face) const;
  Look look_at_sphere(const glm::dvec3& x, std::uint32_t face, const glm::dvec3& center, double radius) const;
  Look look_at_torus(const glm::dvec3& x, std::uint32_t face, const ToroidalPatch& torus) const;

  const Surface& surface_;
  std::vector<bool> barred_;
  std::vector<std::uint32_t> first_;  ///< per face, into sides_
  std::vector<Side> sides_;
};

}  // namespace meniscus
