// SPDX-License-Identifier: BSD-3-Clause
// The triangulation of one face between samples of its borders: conformal maps, outlines, points and triangles.
#pragma once

#include <glm/vec2.hpp>

#include "core/mesh/border_samples.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// Unit directions and the triangles between them, counter-clockwise seen from outside.
struct SphereLattice {
  std::vector<glm::dvec3> directions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Returns the directions of an icosahedron with each edge divided into `frequency` >= 1 parts: 10 frequency^2 + 2.
SphereLattice sphere_lattice(int frequency);

/// Returns the smallest frequency with edges of at most `angle` radian.
int lattice_frequency(double angle);

/// A mesh vertex of one face, in Å. `angles` is used on tori only: theta about the axis, counted from the patch's
/// start, and the tube angle (both radian).
struct FacePoint {
  glm::dvec3 position{0.0};
  glm::dvec2 angles{0.0};
};

/// A map of the sphere or torus of a face to the plane. It preserves orientation: counter-clockwise in the plane is
/// counter-clockwise as seen from the solvent.
class FaceDomain {
 public:
  virtual ~FaceDomain() = default;
  /// Maps a point to the plane.
  virtual glm::dvec2 flat(const FacePoint& point) const = 0;
  /// True if a point of the sphere or torus lies on the patch, not merely between the chords of its rim.
  virtual bool contains(const FacePoint& /*point*/) const { return true; }
  /// Returns the point of the exact surface between the given ones, with weights that sum to 1.
  virtual FacePoint between(const std::array<const FacePoint*, 3>& points,
                            const std::array<double, 3>& weights) const = 0;
  /// Returns the distance (Å) of the flat triangle from the exact surface: the largest one on spheres, the largest at
  /// the sampled places on tori.
  virtual double deviation(const FacePoint& a, const FacePoint& b, const FacePoint& c) const = 0;
  /// Returns the exact unit normal, towards the solvent.
  virtual glm::dvec3 normal(const FacePoint& point) const = 0;
  /// Returns this normal in the corner of a triangle with the other corners `next` and `last`. It differs from normal()
  /// only at the tip of a spindle, which has a cone of normals.
  virtual glm::dvec3 corner_normal(const FacePoint& point, const FacePoint& /*next*/, const FacePoint& /*last*/) const {
    return normal(point);
  }
};

/// The stereographic projection from `pole`, a unit direction outside the face.
class SphereDomain final : public FaceDomain {
 public:
  /// `inwards` is true if the solvent is inside the sphere, as on concave patches. The memory of `planes` must outlive
  /// this object.
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

/// Maps a patch that does not reach its axis to (theta, conformal height), and one that does to a sector of a disc
/// around its tip.
class TorusDomain final : public FaceDomain {
 public:
  /// `piece` selects the part of a patch that the axis cuts in two; it is ignored for other patches.
  TorusDomain(const ToroidalPatch& patch, double tube_radius, int piece);
  glm::dvec2 flat(const FacePoint& point) const override;
  FacePoint between(const std::array<const FacePoint*, 3>& points, const std::array<double, 3>& weights) const override;
  double deviation(const FacePoint& a, const FacePoint& b, const FacePoint& c) const override;
  glm::dvec3 normal(const FacePoint& point) const override;
  glm::dvec3 corner_normal(const FacePoint& point, const FacePoint& next, const FacePoint& last) const override;
  /// Returns the point at these angles (radian).
  FacePoint at(double theta, double tube) const;
  /// Returns the distance (Å) from the axis at a tube angle (radian).
  double axis_distance(double tube) const;
  /// True if the axis cuts the patch in two, and this is a map of one half.
  bool is_spindle() const { return is_spindle_; }
  /// Returns the signed tube angle (radian) of the tip of this half of a spindle.
  double tip_angle() const { return piece_ == 0 ? -tip_ : tip_; }

 private:
  ToroidalPatch patch_;
  double tube_radius_;
  int piece_;
  bool is_spindle_;
  double tip_ = 0.0;      ///< tube angle (radian) where the torus meets its axis, above 0; 0 if it does not
  double tan_tip_ = 0.0;  ///< tan(tip/2)
};

/// A part of a border between two neighbouring samples, or, with border kNone, a part of a seam, which opens a
/// ring-shaped face.
struct Segment {
  std::uint32_t border = kNone;
  std::uint32_t index = 0;
};

/// The rim of a face that has to be triangulated, and points that may be used inside it.
struct FaceOutline {
  std::unique_ptr<FaceDomain> domain;
  std::vector<FacePoint> points;  ///< points of the rim
  /// Per rim point: its name; on a seam the border is kSeam, and both sides have the same names.
  std::vector<BorderPoint> names;
  std::vector<std::array<int, 2>> edges;  ///< directed; the face is on their left
  std::vector<Segment> segments;          ///< per edge: the segment that it is part of
  std::vector<FacePoint> interior;
  std::size_t loop_count = 0;
};
/// The border number of points inside a seam.
inline constexpr std::uint32_t kSeam = kNone - 1;

/// The triangles of a face. Their vertices are the rim points, followed by the interior points.
struct FaceMesh {
  std::unique_ptr<FaceDomain> domain;
  std::vector<BorderPoint> rim;
  std::vector<std::array<int, 2>> rim_edges;
  std::vector<FacePoint> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> atom;                    ///< per triangle: the touched atom with the nearest contact
  std::vector<std::array<std::uint32_t, 2>> bridges;  ///< inner edges between two rim points
  /// Segments to be split before the next try; there are no triangles if there are any.
  std::vector<Segment> too_coarse;
};

/// Returns the outline of a sphere face with at least one loop. The lattice provides inner points, `edge` Å apart.
FaceOutline sphere_outline(const Surface& surface, const Face& face, const BorderSamples& samples,
                           const SphereLattice& lattice, double edge);

/// Returns the outline of a toroidal face: a whole patch, or one half of a spindle.
FaceOutline torus_outline(const Surface& surface, const Face& face, const BorderSamples& samples, const EdgeRule& rule);

/// Triangulates an outline to within the tolerance (Å).
FaceMesh fill_outline(FaceOutline outline, double tolerance);

/// Triangulates an outline of one loop as a fan about its middle: the last resort for rims that nearly meet themselves.
FaceMesh fan_outline(FaceOutline outline);

FaceMesh whole_sphere(const Surface& surface, const Face& face, const SphereLattice& lattice);

/// Splits inner edges until no two of them, and no inner edge and the rim, join the same two named points. This is
/// necessary because the two sides of a seam become one line of vertices.
void split_doubled_edges(FaceMesh& mesh);

/// Splits an inner edge in two, if the mesh still has it; the new vertex lies on the exact surface.
void split_edge(FaceMesh& mesh, std::uint32_t a, std::uint32_t b);

/// Assigns each triangle its atom. With `split`, triangles are first cut along the lines where the nearest contact
/// changes.
void color_face(const Surface& surface, const Face& face, FaceMesh& mesh, bool split);

}  // namespace meniscus
