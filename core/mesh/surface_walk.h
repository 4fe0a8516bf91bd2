// SPDX-License-Identifier: BSD-3-Clause
// Projects points near a surface onto it by walking from face to face, without a search.
#pragma once

#include <optional>
#include <utility>

#include "core/surface/primitives.h"

namespace meniscus {

/// A point of the exact surface.
struct SurfacePoint {
  glm::dvec3 position{0.0};    ///< Å
  std::uint32_t face = kNone;  ///< into Surface::faces
};

/// Projects points onto a surface, along the line to the nearest place of the probe's centre. The cones, wedges and
/// tetrahedra over the patches (theorem 1) tile the solid below the surface, and their walls stand on the borders. A
/// walk that crosses a wall continues on the face on its other side. Points have to be nearer to the surface than its
/// radii of curvature.
class SurfaceWalk {
 public:
  /// `surface` must outlive the walk. Walks may cross all borders at first.
  explicit SurfaceWalk(const Surface& surface);
  /// Bars walks from crossing borders; `barred` is true for each border that is barred.
  void bar(std::vector<bool> barred) { barred_ = std::move(barred); }

  /// Returns the point of the surface under x for a walk that starts at `face`; nothing if the walk leads nowhere or to
  /// a barred border.
  std::optional<SurfacePoint> below(const glm::dvec3& x, std::uint32_t face) const;
  /// Returns the point of a border's circle nearest to x; nothing if it is not on the arc.
  std::optional<glm::dvec3> on_border(const glm::dvec3& x, std::uint32_t border) const;
  /// Returns the point nearest to x on the cusps of a face and of its neighbours; nothing if there are none.
  std::optional<SurfacePoint> on_near_cusp(const glm::dvec3& x, std::uint32_t face) const;
  /// Returns the unit normal towards the solvent at a point of a face.
  glm::dvec3 normal(const SurfacePoint& point) const;
  /// Returns the touched atom with the contact nearest to a point of a face.
  std::uint32_t nearest_atom(const SurfacePoint& point) const;
  /// Returns the radius (Å) of the face's sphere, or of its torus' tube.
  double radius(std::uint32_t face) const;

 private:
  enum class Wall : std::uint8_t { plane, tube_low, tube_high, start, end };
  /// One side of a face: the wall over a border, and the face beyond it.
  struct Side {
    glm::dvec3 normal{0.0};  ///< plane: unit normal, away from the face
    double offset = 0.0;     ///< plane: its offset (Å); tube: its angle (radian)
    std::uint32_t border = kNone, beyond = kNone;
    Wall wall = Wall::plane;
  };
  /// The projection of x seen from a face: the foot on its sphere or torus, and the wall that x is farthest beyond.
  struct Projection {
    glm::dvec3 foot{0.0};
    const Side* crossed = nullptr;  ///< null: x is beyond no wall
    bool is_lost = false;  ///< true if there is no foot: x is in the middle of a sphere, or past the tip of a spindle
  };

  void list_sides(std::uint32_t face);
  bool on_patch(const glm::dvec3& foot, std::uint32_t face) const;
  Projection project(const glm::dvec3& x, std::uint32_t face) const;
  Projection project_to_sphere(const glm::dvec3& x, std::uint32_t face, const glm::dvec3& center, double radius) const;
  Projection project_to_torus(const glm::dvec3& x, std::uint32_t face, const ToroidalPatch& torus) const;

  const Surface& surface_;
  std::vector<bool> barred_;
  std::vector<std::uint32_t> first_;  ///< per face: the start of its sides in sides_, followed by their end
  std::vector<Side> sides_;
};

}  // namespace meniscus
