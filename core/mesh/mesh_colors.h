// SPDX-License-Identifier: BSD-3-Clause
// The colours and the numbers of a mesh: of its triangles and vertices, of points by the atom that they touch, and of
// points on caps.
#pragma once

#include "core/color/coloring.h"
#include "core/math/ball.h"
#include "core/queries/surface_parts.h"
#include "core/surface/primitives.h"

namespace meniscus {

struct TriangleMesh;

/// Returns the sRGB colour of a triangle: that of its patch kind or of its atom.
glm::vec3 triangle_color(const TriangleMesh& mesh, const Coloring& coloring, std::size_t triangle);

/// Returns the sRGB colour of each vertex: the mean of the triangles around it, which blends colours over one triangle,
/// or the colour of the volume map there if a map colours the atom.
std::vector<glm::vec3> vertex_colors(const TriangleMesh& mesh, const Coloring& coloring);

/// Returns the value of the map at each vertex; NaN outside of the map.
std::vector<float> vertex_map_values(const TriangleMesh& mesh, const VolumePaint& volume);

/// Returns for each vertex the atom with the lowest number among its triangles, for scalars of atoms.
std::vector<std::uint32_t> vertex_atoms(const TriangleMesh& mesh);

/// Returns the centre of the mesh's bounding box, rounded to whole Å. Coordinates written in single precision are
/// relative to it, so that rounding costs less than 1e-5 Å anywhere within 150 Å of it, wherever the molecule lies.
glm::dvec3 mesh_origin(const TriangleMesh& mesh);

/// A touched atom and the unit direction from the probe to its contact.
struct ContactDirection {
  std::uint32_t atom = kNone;
  glm::dvec3 direction{0.0};
};

/// Returns the contacts of a fixed probe.
std::vector<ContactDirection> contact_directions(const Surface& surface, const ConcavePatch& patch);

/// Returns the tube angle (radian) of a point on a torus: 0 towards the axis, positive towards atom[1]; x = probe + p
/// (-cos e_rho + sin axis).
double tube_angle(const ToroidalPatch& patch, const glm::dvec3& position);
/// Returns the tube angles (radian) of the contact circles of atom[0] and atom[1].
std::array<double, 2> contact_angles(const Surface& surface, const ToroidalPatch& patch);

/// Returns the two contacts of a probe that rolls along a torus and has its centre at `probe`.
std::vector<ContactDirection> contact_directions(const Surface& surface, const ToroidalPatch& patch,
                                                 const glm::dvec3& probe);

/// Returns, ascending, the parameters in (0, sweep) at which the nearest contact changes along a border on the probe's
/// sphere.
std::vector<double> color_changes(const std::vector<ContactDirection>& contacts, const glm::dvec3& probe,
                                  const Border& border);

/// The atoms that caps are coloured by: at each point the atom with the nearest van der Waals sphere, of equally near
/// ones the first.
class CapAtoms {
 public:
  /// `part` gives the part of each atom; triangles of caps end where atoms of two parts are equally near. Throws Error
  /// if there are no atoms, or not as many parts as atoms.
  CapAtoms(std::vector<Ball> atoms, double probe_radius, std::vector<std::uint32_t> part);

  struct Nearest {
    std::uint32_t atom = kNone;
    double distance = 0.0;  ///< Å from its sphere, negative inside
    double gap = 0.0;       ///< Å; atoms of other parts are farther by at least this much
  };
  Nearest nearest(const glm::dvec3& point) const;
  /// Returns the distance (Å) of a point from the sphere of an atom, negative inside.
  double distance(std::uint32_t atom, const glm::dvec3& point) const;

  std::uint32_t part(std::uint32_t atom) const { return part_[atom]; }
  bool has_parts() const { return has_parts_; }
  /// Returns the distance (Å) from the nearest sphere that no point of the solid exceeds.
  double farthest() const { return probe_radius_; }

 private:
  std::vector<Ball> atoms_;
  std::vector<std::uint32_t> part_;
  double probe_radius_ = 0.0, largest_ = 0.0;
  bool has_parts_ = false;
  BallGrid grid_;
};

struct TriangleMesh;

/// The radius (Å) around a vertex over which curvature is averaged.
inline constexpr double kSmoothingRadius = 2.0;

/// Returns the averaged curvature at each vertex of a closed mesh. The curvature measures of the normal cycle (D.
/// Cohen-Steiner and J.-M. Morvan, "Restricted Delaunay triangulations and normal cycle", SoCG 2003, section 4: angles
/// between triangles along edges, and angle deficits to 2 pi at vertices) are summed over the vertices that lie within
/// `radius` (Å) and can be reached along edges between such vertices, and divided by their area. Cusps count, too, with
/// their angles. Runs on all cores that TBB may use.
std::vector<Curvature> smoothed_curvatures(const TriangleMesh& mesh, double radius = kSmoothingRadius);

/// Returns sky_visibility() at each vertex of a mesh of the surface.
std::vector<float> vertex_open_sky(const Surface& surface, const TriangleMesh& mesh);

/// Returns for each of Surface::atoms the mean visibility of the sky over its triangles, weighted by area; 0 for atoms
/// without triangles.
std::vector<double> atom_open_sky(const Surface& surface, const TriangleMesh& mesh);

}  // namespace meniscus
