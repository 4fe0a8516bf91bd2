// SPDX-License-Identifier: BSD-3-Clause
// Flat, angle-preserving maps of spheres and tori, in which their faces are triangulated.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus {

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

}  // namespace meniscus
