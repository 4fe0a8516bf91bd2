// SPDX-License-Identifier: BSD-3-Clause
// How the points of a surface move when its atoms do: for motion blur, though each frame has a mesh of its own.
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

/// Velocities of the points of one surface, in the unit of those of its atoms (Å per frame).
///
/// A point of a convex patch moves as its atom. A probe at s that touches atoms c_i keeps |s - c_i| = r_i + p, so
/// (s - c_i) . (s' - c_i') = 0: three atoms give the velocity s' of a fixed probe (more: least squares). A rolling
/// probe touches two; the third equation says how it moves along its circle: as the line through the atoms does, plus a
/// part that goes linearly with the circle's angle between what the fixed probes at its ends have. The directions from
/// the probe to its contacts turn with the angular velocity w that fits them best, and a point x of the probe's sphere
/// moves by s' + w x (x - s). The component along the normal is exact; along the surface, where points have no
/// identity, it is a choice that makes a rigid motion of all atoms a rigid motion of the surface.
///
/// A fixed probe about to slip between its atoms moves without bound; it is taken to move no faster, as seen from its
/// atoms, than by its diameter in a frame.
class SurfaceVelocity {
 public:
  /// atom_velocity: one per Surface::atoms. Throws Error if there are not as many. `surface` must live as long.
  SurfaceVelocity(const Surface& surface, std::span<const glm::dvec3> atom_velocity);

  /// Of the point x of a patch, where its normal is `normal`.
  glm::dvec3 at(PatchKind kind, std::uint32_t patch, const glm::dvec3& x, const glm::dvec3& normal) const;
  /// Of the centre of a fixed probe.
  const glm::dvec3& of_probe(std::uint32_t concave) const { return probe_[concave]; }
  /// Of the centre s, on its circle, of a rolling probe; at the ends that of the fixed probes.
  glm::dvec3 of_rolling_probe(std::uint32_t toroidal, const glm::dvec3& s) const;

 private:
  /// Of a rolling probe's centre as the line through its atoms carries it, without rolling.
  glm::dvec3 carried(const ToroidalPatch& t, const glm::dvec3& s) const;
  glm::dvec3 on_probe(const glm::dvec3& s, const glm::dvec3& velocity, std::span<const std::uint32_t> atoms,
                      const glm::dvec3& x) const;
  glm::dvec3 limited(const glm::dvec3& velocity, std::span<const std::uint32_t> atoms) const;

  const Surface& surface_;
  std::vector<glm::dvec3> atom_;
  std::vector<glm::dvec3> probe_;  ///< one per Surface::concave
};

/// One per vertex of the mesh. Where faces meet at an angle, a vertex keeps the normal component of each of them.
std::vector<glm::dvec3> vertex_velocities(const Surface& surface, const TriangleMesh& mesh,
                                          std::span<const glm::dvec3> atom_velocity);

}  // namespace meniscus
