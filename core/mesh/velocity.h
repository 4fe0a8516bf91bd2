// SPDX-License-Identifier: BSD-3-Clause
// Computes how the points of a surface move when its atoms do, for motion blur, although each frame has its own mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace meniscus {

enum class PatchKind : std::uint8_t;
struct Surface;
struct ToroidalPatch;
struct TriangleMesh;

/// The velocities of the points of one surface, in the unit of the velocities of its atoms (Å per frame).
///
/// A point of a convex patch moves with its atom. A probe at s that touches atoms c_i keeps |s - c_i| = r_i + p, so
/// (s - c_i) . (s' - c_i') = 0. Three atoms determine the velocity s' of a fixed probe (more: least squares). A rolling
/// probe touches two; a third equation gives its motion along its circle: that of the line through the atoms, plus a
/// part that varies linearly with the circle's angle between the values of the fixed probes at its ends. The directions
/// from the probe to its contacts turn with the angular velocity w that fits them best, and a point x of the probe's
/// sphere moves by s' + w x (x - s). The component along the normal is exact. Along the surface, where points have no
/// identity, the velocity is a choice that makes a rigid motion of all atoms a rigid motion of the surface.
///
/// A fixed probe about to slip between its atoms moves without bound. Its speed relative to its atoms is limited to its
/// diameter per frame.
class SurfaceVelocity {
 public:
  /// `atom_velocity` has one entry for each of Surface::atoms; Error is thrown otherwise. `surface` must outlive this
  /// object.
  SurfaceVelocity(const Surface& surface, std::span<const glm::dvec3> atom_velocity);

  /// Returns the velocity of the point x of a patch, where the unit normal is `normal`.
  glm::dvec3 at(PatchKind kind, std::uint32_t patch, const glm::dvec3& x, const glm::dvec3& normal) const;
  /// Returns the velocity of the centre of a fixed probe.
  const glm::dvec3& of_probe(std::uint32_t concave) const { return probe_[concave]; }
  /// Returns the velocity of the centre s, on its circle, of a rolling probe. At the ends of an arc it is that of the
  /// fixed probes.
  glm::dvec3 of_rolling_probe(std::uint32_t toroidal, const glm::dvec3& s) const;

 private:
  /// Returns the velocity of a rolling probe's centre that moves with the line through its atoms, without rolling.
  glm::dvec3 carried(const ToroidalPatch& t, const glm::dvec3& s) const;
  /// Returns the velocity of the point x on the sphere of a probe with centre s that touches these atoms.
  glm::dvec3 on_probe(const glm::dvec3& s, const glm::dvec3& velocity, std::span<const std::uint32_t> atoms,
                      const glm::dvec3& x) const;
  /// Returns a velocity limited, relative to the mean of these atoms, to a probe's diameter per frame.
  glm::dvec3 limited(const glm::dvec3& velocity, std::span<const std::uint32_t> atoms) const;

  const Surface& surface_;
  std::vector<glm::dvec3> atom_;   ///< velocity of each of Surface::atoms
  std::vector<glm::dvec3> probe_;  ///< velocity of each of Surface::concave
};

/// Returns the velocity of each vertex of the mesh. Where faces meet at an angle, a vertex keeps the normal component
/// of each of them.
std::vector<glm::dvec3> vertex_velocities(const Surface& surface, const TriangleMesh& mesh,
                                          std::span<const glm::dvec3> atom_velocity);

}  // namespace meniscus
