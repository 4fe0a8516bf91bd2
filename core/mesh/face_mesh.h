// SPDX-License-Identifier: BSD-3-Clause
// Triangles of one face between samples of its borders: conformal maps to the plane, points inside,
// triangles.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/mesh/border_samples.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// Unit directions and the counter-clockwise triangles between them (seen from outside).
struct SphereLattice {
  std::vector<glm::dvec3> directions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Each edge of the icosahedron in `frequency` >= 1 parts: 10 frequency^2 + 2 directions.
SphereLattice sphere_lattice(int frequency);

/// The smallest frequency whose edges are all at most `angle` radian long.
int lattice_frequency(double angle);

/// A mesh vertex of one face. `angles` is used on tori only: (theta about the axis from the patch's start, tube angle).
struct FacePoint {
  glm::dvec3 position{0.0};
  glm::dvec2 angles{0.0};
};

/// A map of the face's sphere or torus to the plane; counter-clockwise there is counter-clockwise seen from the
/// solvent.
class FaceDomain {
 public:
  virtual ~FaceDomain() = default;
  virtual glm::dvec2 flat(const FacePoint& point) const = 0;
  /// Whether a point of the sphere or torus is on the patch, not merely between the chords of its rim.
  virtual bool contains(const FacePoint& /*point*/) const { return true; }
  /// The point of the exact surface "between" given ones with weights that sum to 1.
  virtual FacePoint between(const std::array<const FacePoint*, 3>& points,
                            const std::array<double, 3>& weights) const = 0;
  /// How far (Å) the flat triangle is from the exact surface at most (spheres) or at the places looked at (tori).
  virtual double deviation(const FacePoint& a, const FacePoint& b, const FacePoint& c) const = 0;
  /// The exact unit normal, towards the solvent.
  virtual glm::dvec3 normal(const FacePoint& point) const = 0;
  /// The same in the corner of a triangle; differs only at the tip of a spindle, which has a cone of normals.
  virtual glm::dvec3 corner_normal(const FacePoint& point, const FacePoint& /*next*/, const FacePoint& /*last*/) const {
    return normal(point);
  }
};

/// Stereographic projection from `pole`, a unit direction outside the face.
class SphereDomain final : public FaceDomain {
 public:
  /// inwards: the solvent is inside (concave patches).
  SphereDomain(const glm::dvec3& center, double radius, std::span<const Plane> planes, const glm::dvec3& pole,
               bool inwards);
  glm::dvec2 flat(const FacePoint& point) const override;
  bool contains(const FacePoint& point) const override;
  FacePoint between(const std::array<const FacePoint*, 3>& points, const std::array<double, 3>& weights) const override;
  double deviation(const FacePoint& a, const FacePoint& b, const FacePoint& c) const override;
  glm::dvec3 normal(const FacePoint& point) const override;
  FacePoint at(const glm::dvec3& direction) const { return {center_ + radius_ * direction, {}}; }

 private:
  glm::dvec3 center_, pole_, right_, up_;
  std::span<const Plane> planes_;
  double radius_;
  bool inwards_;
};

/// A patch that does not reach its axis: (theta, conformal height). One that does: a sector of a disc around its tip.
class TorusDomain final : public FaceDomain {
 public:
  /// piece: which part of a patch that the axis cuts in two; ignored for others.
  TorusDomain(const ToroidalPatch& patch, double tube_radius, int piece);
  glm::dvec2 flat(const FacePoint& point) const override;
  FacePoint between(const std::array<const FacePoint*, 3>& points, const std::array<double, 3>& weights) const override;
  double deviation(const FacePoint& a, const FacePoint& b, const FacePoint& c) const override;
  glm::dvec3 normal(const FacePoint& point) const override;
  glm::dvec3 corner_normal(const FacePoint& point, const FacePoint& next, const FacePoint& last) const override;
  FacePoint at(double theta, double tube) const;
  /// Distance from the axis at a tube angle.
  double axis_distance(double tube) const;
  bool spindle() const { return spindle_; }
  /// The signed tube angle of the tip of this half of a spindle.
  double tip_angle() const { return piece_ == 0 ? -tip_ : tip_; }

 private:
  ToroidalPatch patch_;
  double tube_radius_;
  int piece_;
  bool spindle_;
  double tip_ = 0.0;      ///< tube angle where the torus meets its axis, > 0; 0 if it does not
  double tan_tip_ = 0.0;  ///< tan(tip/2)
};

/// A piece of border between two samples, or of a seam (border kNone) that opens a ring-shaped face.
struct Segment {
  std::uint32_t border = kNone;
  std::uint32_t index = 0;
};

/// What has to be triangulated: the rim and points that may be used inside it.
struct FaceOutline {
  std::unique_ptr<FaceDomain> domain;
  std::vector<FacePoint> points;          ///< of the rim
  std::vector<BorderPoint> names;         ///< of the rim points; on a seam border kSeam, both sides alike
  std::vector<std::array<int, 2>> edges;  ///< directed, the face on their left
  std::vector<Segment> segments;          ///< what each edge is part of
  std::vector<FacePoint> interior;
  std::size_t loop_count = 0;
};
inline constexpr std::uint32_t kSeam = kNone - 1;

/// Triangles over rim points (first) and interior points (after them).
struct FaceMesh {
  std::unique_ptr<FaceDomain> domain;
  std::vector<BorderPoint> rim;
  std::vector<std::array<int, 2>> rim_edges;
  std::vector<FacePoint> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> atom;                    ///< per triangle
  std::vector<std::array<std::uint32_t, 2>> bridges;  ///< inner edges between two rim points
  std::vector<Segment> too_coarse;                    ///< not empty: no triangles; split these segments and try again
};

/// The outline of a sphere face with at least one loop. The lattice gives the inner points, `edge` Å apart.
FaceOutline sphere_outline(const Surface& surface, const Face& face, const BorderSamples& samples,
                           const SphereLattice& lattice, double edge);

/// The outline of any piece of a torus. `piece`: which half of a spindle.
FaceOutline torus_outline(const Surface& surface, const Face& face, const BorderSamples& samples, const EdgeRule& rule);

/// Triangulates an outline within the tolerance (Å).
FaceMesh fill_outline(FaceOutline outline, double tolerance);

/// Last resort for rims that meet themselves within rounding: a fan about the middle. One loop only.
FaceMesh fan_outline(FaceOutline outline);

/// A whole sphere.
FaceMesh whole_sphere(const Surface& surface, const Face& face, const SphereLattice& lattice);

/// Splits inner edges until no two of them, nor one and the rim, join the same two named points: the two sides of a
/// seam are one line of vertices in the end.
void part_doubled_edges(FaceMesh& mesh);

/// Splits an inner edge in two, if the mesh still has it; the new vertex lies on the exact surface.
void split_edge(FaceMesh& mesh, std::uint32_t a, std::uint32_t b);

/// Gives each triangle its atom; with `split`, first cuts triangles along the lines where the nearest contact changes.
void color_face(const Surface& surface, const Face& face, FaceMesh& mesh, bool split);

}  // namespace meniscus
