// SPDX-License-Identifier: BSD-3-Clause
// The finished solvent-excluded surface: analytic patches, and the borders, faces and components that tie them
// together.
//
// Two views of one surface, both plain data without GL:
//  * the patch tables (convex, toroidal, concave) say which quadric or quartic is clipped by which planes;
//    ray casters and constructive exporters need only these;
//  * the boundary representation (vertices, borders, loops, faces) says where patches meet; every border is an arc of
//    a circle, shared by exactly two faces. Meshes, areas, volumes and the certificate rest on it.
//
// Lengths are in Å, angles in radian, normals point out of the solid (towards the solvent).
// Terms: Connolly 1983; Sanner, Olson & Spehner 1996; Krone, Dachsbacher & Ertl 2010.
#pragma once

#include <array>
#include <functional>
#include <memory>

#include "core/base/constants.h"
#include "core/math/ball.h"

namespace meniscus {

struct ReducedSurface;

/// The choice when a surface lists the clip planes of its convex patches (ConvexPatch::planes), a fifth of the work.
enum class ClipPlanes {
  listed,    ///< listed at once, so that the surface can be drawn, exported and divided
  deferred,  ///< listed when list_convex_planes() is called; until then `left_out`
  left_out   ///< never listed: for numbers, borders and areas; the certificate is as strict
};

/// A half-space: a point x (Å) is inside where dot(normal, x) <= offset.
struct Plane {
  glm::dvec3 normal{0.0};  ///< unit vector
  double offset = 0.0;     ///< Å
};

/// The kind of a patch and of its faces.
enum class PatchKind : std::uint8_t { convex = 0, toroidal = 1, concave = 2 };

/// Contact patch: the vdW sphere of one atom inside all its planes (theorem 1.1).
/// `planes` is a subset of the atom's contact circles that bounds exactly the patch and nothing else.
struct ConvexPatch {
  std::uint32_t atom = 0;         ///< index into Surface::atoms
  std::uint32_t first_plane = 0;  ///< into Surface::planes
  std::uint32_t plane_count = 0;
  std::uint32_t first_face = 0;  ///< into Surface::faces: the patch's connected pieces
  std::uint32_t face_count = 0;
};

/// Saddle patch: the probe rolling in contact with two atoms (an RS edge).
/// The SAS circle has `center`, unit `axis` (from atom[0] to atom[1]) and `radius`; the probe rolls counter-clockwise
/// about the axis from center + radius*start over the angle `sweep`. The torus has major radius `radius`, minor radius
/// probe_radius. On a spindle (see crosses_axis) the part past the axis is cut off and two pieces remain.
struct ToroidalPatch {
  std::array<std::uint32_t, 2> atom{};               ///< atom[0] < atom[1]
  std::array<std::uint32_t, 2> probe{kNone, kNone};  ///< fixed probes at start and end; kNone for a free edge
  glm::dvec3 center{0.0};                            ///< Å
  glm::dvec3 axis{0.0};                              ///< unit vector
  double radius = 0.0;                               ///< Å
  glm::dvec3 start{0.0};                             ///< unit vector, perpendicular to axis
  double sweep = 0.0;                                ///< radians, in (0, 2 pi]; exactly 2 pi for a free edge
  std::uint32_t first_face = 0;
  std::uint32_t face_count = 0;  ///< 1, or 2 for a spindle (the piece of atom[0], then that of atom[1])
  /// For a spindle: which of its two pieces exist. Both exist except in a part of a surface (SurfacePart).
  std::array<bool, 2> has_piece{true, true};
  bool free() const { return probe[0] == kNone; }
  /// Returns the piece of a spindle that its n-th face is.
  int piece(std::uint32_t n) const { return has_piece[0] ? static_cast<int>(n) : 1; }
};

/// True where the patch crosses its axis or, with a circle as large as the probe, touches it in one point.
inline bool touches_axis(const ToroidalPatch& t, std::span<const Ball> atoms, double probe_radius) {
  return t.radius <= probe_radius && glm::dot(t.axis, atoms[t.atom[0]].center - t.center) < 0 &&
         glm::dot(t.axis, atoms[t.atom[1]].center - t.center) > 0;
}

/// True where the patch crosses its axis: the circle is smaller than the probe and its centre lies between the atoms
/// (beyond a nearly swallowed atom both contacts are on one side, and the patch never comes to the axis).
inline bool crosses_axis(const ToroidalPatch& t, std::span<const Ball> atoms, double probe_radius) {
  return t.radius < probe_radius && touches_axis(t, atoms, probe_radius);
}

/// Re-entrant patch: the sphere of one fixed probe (an RS face) inside all its planes. First come `side_count` planes
/// through the probe and two neighbouring contacts, then `cut_count` bisectors towards the probes in `cuts`, then
/// `parting_count` planes that separate it from faces that are not in a part of a surface (SurfacePart).
struct ConcavePatch {
  glm::dvec3 center{0.0};           ///< centre of the probe, Å
  std::uint32_t first_contact = 0;  ///< into Surface::contacts: touched atoms, counter-clockwise seen from the probe
  std::uint32_t contact_count = 0;  ///< 3, or more for a degenerate probe
  std::uint32_t first_plane = 0;    ///< into Surface::planes: side planes (contact n and n+1), then bisectors
  std::uint32_t side_count = 0;     ///< equals contact_count
  std::uint32_t cut_count = 0;
  std::uint32_t parting_count = 0;
  std::uint32_t first_cut = 0;  ///< into Surface::cuts: the fixed probes behind the bisectors; kNone: not in the part
  std::uint32_t first_face = 0;
  std::uint32_t face_count = 0;  ///< 0 when other probes cut everything away
  std::uint32_t plane_count() const { return side_count + cut_count + parting_count; }
};

/// The kind of curve that a border is.
enum class BorderKind : std::uint8_t {
  contact,  ///< contact circle: convex | toroidal
  edge,     ///< side of a concave patch: toroidal | concave
  cusp      ///< intersection of two fixed probes: concave | concave
};

/// An arc of a circle where exactly two faces meet.
/// Points: center + radius*(cos t * start + sin t * cross(axis, start)), t in [0, sweep].
struct Border {
  BorderKind kind = BorderKind::contact;
  glm::dvec3 center{0.0};                             ///< Å
  glm::dvec3 axis{0.0};                               ///< unit vector
  double radius = 0.0;                                ///< Å
  glm::dvec3 start{0.0};                              ///< unit vector, perpendicular to axis
  double sweep = 0.0;                                 ///< radians
  std::array<std::uint32_t, 2> vertex{kNone, kNone};  ///< start and end; kNone twice for a whole circle
  std::array<std::uint32_t, 2> face{kNone, kNone};  ///< left and right of the forward direction, seen from the solvent
};

/// A border walked in one direction: border index * 2 + (1 if backwards).
using HalfBorder = std::uint32_t;

/// A closed chain of half-borders with the face on its left, seen from the solvent.
struct Loop {
  std::uint32_t first_half_border = 0;  ///< into Surface::half_borders
  std::uint32_t half_border_count = 0;
};

/// A connected piece of one patch: a sphere with `loop_count` holes (0: a whole sphere), or a piece of torus.
/// The piece of a free spindle torus is a disc around `tip`, the cusp point on the axis.
struct Face {
  PatchKind kind = PatchKind::convex;
  std::uint32_t patch = 0;  ///< index into the patch table of its kind
  std::uint32_t first_loop = 0;
  std::uint32_t loop_count = 0;
  std::uint32_t component = 0;
  std::uint32_t tip = kNone;  ///< vertex inside the face, only for free spindle tori
  double area = 0.0;          ///< Å²
};

/// The kind of a component: the outside of a solid, or a cavity in it.
enum class ComponentKind : std::uint8_t { outer, cavity };

/// One closed, connected part of the surface.
struct Component {
  ComponentKind kind = ComponentKind::outer;
  double area = 0.0;    ///< Å², positive
  double volume = 0.0;  ///< Å³, by the divergence theorem: positive for outer components, negative for cavities
  int euler = 2;        ///< Euler characteristic V - E + F
};

/// Returns the key by which components are sorted. Areas that differ only by rounding, which varies between systems,
/// have equal keys.
inline float area_rank(double area) { return static_cast<float>(area); }

/// The result of the conditions of theorem 3 (certificate.h).
struct Certificate {
  bool closed = false;
  std::vector<std::uint32_t> open_atoms;  ///< atoms at which the surface is not closed; empty when closed
  double grown_by = 0.0;      ///< largest growth of radii, Å, that resolved ties (compute_surface.h); 0 as a rule
  double exact_within = 0.0;  ///< the surface is exact for radii that differ from the given ones by at most this, Å; 0:
                              ///< for the given ones
};

/// The counts that users and papers quote.
struct SurfaceCounts {
  std::size_t convex = 0;        ///< atoms with a convex patch
  std::size_t toroidal = 0;      ///< saddle patches: arcs + free edges
  std::size_t concave = 0;       ///< fixed probes with a part on the surface
  std::size_t free_edges = 0;    ///< full circles
  std::size_t spindle = 0;       ///< toroidal patches that cross their axis
  std::size_t fixed_probes = 0;  ///< distinct positions; probes closer than 1e-6 Å are one probe with n contacts
  std::size_t arcs = 0;          ///< RS edges with two ends; 2*arcs = sum of contacts over fixed probes
  SurfaceCounts& operator+=(const SurfaceCounts& more);
};

/// The sums over the tables of a surface that was computed block by block and released some tables (blocks.h).
struct SurfaceSums {
  SurfaceCounts counts;
  double accessible = 0.0;                            ///< Å²: the solvent-accessible area
  std::vector<double> atom_surface, atom_accessible;  ///< Å², one per atom: AtomAreas
};

/// The complete solvent-excluded surface of one set of balls. Patches are sorted by their atom indices.
struct Surface {
  double probe_radius = 0.0;  ///< Å
  std::vector<Ball> atoms;    ///< every atom given, in input order, exposed or not

  std::vector<ConvexPatch> convex;
  std::vector<ToroidalPatch> toroidal;
  std::vector<ConcavePatch> concave;
  std::vector<Plane> planes;
  std::vector<std::uint32_t> contacts;
  std::vector<std::uint32_t> cuts;

  std::vector<glm::dvec3> vertices;
  std::vector<Border> borders;
  std::vector<HalfBorder> half_borders;
  std::vector<Loop> loops;
  std::vector<Face> faces;  ///< the faces of one patch are adjacent

  std::vector<Component> components;
  Certificate certificate;
  double area = 0.0;    ///< Å²
  double volume = 0.0;  ///< Å³ of the solid: outer components minus cavities
  /// The sums, if the tables from `cuts` to `faces` were released; patches then refer to none of them. Else null.
  std::shared_ptr<const SurfaceSums> sums;
  /// The reduced surface, which list_convex_planes() needs, if the surface was computed with ClipPlanes::deferred and
  /// has no planes yet. Else null.
  std::shared_ptr<const ReducedSurface> reduced;

  SurfaceCounts counts() const;
  bool spindle(const ToroidalPatch& t) const { return crosses_axis(t, atoms, probe_radius); }
};

/// Returns the lowest atom that a re-entrant patch touches.
inline std::uint32_t first_atom(const Surface& surface, const ConcavePatch& patch) {
  return surface.contacts[patch.first_contact];
}

/// Counts the patches with a lowest atom for which is_counted is true.
SurfaceCounts counts_of(const Surface& surface, const std::function<bool(std::uint32_t atom)>& is_counted);

}  // namespace meniscus
