// SPDX-License-Identifier: BSD-3-Clause
// The colours of a mesh: of its triangles and vertices, of points by the atom they touch, and of points on caps.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "core/color/coloring.h"
#include "core/math/ball.h"
#include "core/math/ball_grid.h"
#include "core/surface/primitives.h"

namespace meniscus {

struct TriangleMesh;

/// sRGB of a triangle: that of its patch kind or of its atom.
glm::vec3 triangle_color(const TriangleMesh& mesh, const Coloring& coloring, std::size_t triangle);

/// sRGB per vertex: the mean of the triangles around it, which blends colours over one triangle; with a volume map its
/// colour there.
std::vector<glm::vec3> vertex_colors(const TriangleMesh& mesh, const Coloring& coloring);

/// Per vertex what the map says there; NaN outside of it.
std::vector<float> vertex_map_values(const TriangleMesh& mesh, const VolumePaint& volume);

/// Per vertex the atom of one of its triangles (the one with the lowest index), for scalars of atoms.
std::vector<std::uint32_t> vertex_atoms(const TriangleMesh& mesh);

/// The middle of the mesh's bounding box rounded to whole Å: coordinates written in single precision are relative to
/// it, so that rounding costs less than 1e-5 Å anywhere within 150 Å of it, wherever the molecule lies.
glm::dvec3 mesh_origin(const TriangleMesh& mesh);

/// A touched atom and the unit direction from the probe to its contact.
struct ContactDirection {
  std::uint32_t atom = kNone;
  glm::dvec3 direction{0.0};
};

/// The contacts of a fixed probe.
std::vector<ContactDirection> contact_directions(const Surface& surface, const ConcavePatch& patch);

/// The tube angle of a torus point: 0 faces the axis, positive towards atom[1]; x = probe + p (-cos e_rho + sin axis).
double tube_angle(const ToroidalPatch& patch, const glm::dvec3& position);
/// The tube angles of the contact circles of atom[0] and atom[1].
std::array<double, 2> contact_angles(const Surface& surface, const ToroidalPatch& patch);

/// The two contacts of a probe that rolls along a torus, at the place of this side of it.
std::vector<ContactDirection> contact_directions(const Surface& surface, const ToroidalPatch& patch,
                                                 const glm::dvec3& probe);

/// The parameters in (0, sweep) of a border of the probe's sphere where the nearest contact changes, ascending.
std::vector<double> color_changes(const std::vector<ContactDirection>& contacts, const glm::dvec3& probe,
                                  const Border& border);

/// The atoms that caps are coloured by: at each point the one whose van der Waals sphere is nearest, of equally near
/// ones the first.
class CapAtoms {
 public:
  /// part: one per atom. Where atoms of two parts are equally near, triangles of caps end.
  CapAtoms(std::vector<Ball> atoms, double probe_radius, std::vector<std::uint32_t> part);

  struct Nearest {
    std::uint32_t atom = kNone;
    double distance = 0.0;  ///< Å from its sphere, negative within
    double gap = 0.0;       ///< Å: atoms of other parts are farther by so much at least
  };
  Nearest nearest(const glm::dvec3& point) const;
  /// Å from the sphere of an atom.
  double distance(std::uint32_t atom, const glm::dvec3& point) const;

  std::uint32_t part(std::uint32_t atom) const { return part_[atom]; }
  bool has_parts() const { return has_parts_; }
  /// Å: no point of the solid is farther from the nearest sphere.
  double farthest() const { return probe_radius_; }

 private:
  std::vector<Ball> atoms_;
  std::vector<std::uint32_t> part_;
  double probe_radius_ = 0.0, largest_ = 0.0;
  bool has_parts_ = false;
  BallGrid grid_;
};

}  // namespace meniscus
