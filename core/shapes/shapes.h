// SPDX-License-Identifier: BSD-3-Clause
// Shapes that are drawn in addition to a surface: spheres, cylinders and triangles, each with an atom that gives it its
// colour; and the cartoon of proteins and nucleic acids: ribbons, arrows and tubes along the backbone, bases as filled
// rings, and sugars as the solid symbols of the SNFG.
#pragma once

#include "core/structure/structure.h"

namespace meniscus {

struct Ball;

struct SphereShape {
  glm::dvec3 center;   ///< Å
  double radius;       ///< Å
  std::uint32_t atom;  ///< index into Structure::atoms
};

/// The lateral surface of a cylinder, with ends that are covered by spheres of at least its radius. The half at `from`
/// has the colour of `from_atom`, the other half that of `to_atom`.
struct CylinderShape {
  glm::dvec3 from, to;               ///< Å; not the same point
  double radius;                     ///< Å
  std::uint32_t from_atom, to_atom;  ///< indices into Structure::atoms
};

/// A closed mesh with triangles that are counter-clockwise seen from outside.
struct MeshShape {
  std::vector<glm::dvec3> positions;                    ///< Å
  std::vector<glm::vec3> normals;                       ///< per vertex: unit outward normal, interpolated for shading
  std::vector<std::uint32_t> atoms;                     ///< per vertex: index into Structure::atoms
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of vertices
};

struct Shapes {
  std::vector<SphereShape> spheres;
  std::vector<CylinderShape> cylinders;
  MeshShape mesh;

  bool empty() const { return spheres.empty() && cylinders.empty() && mesh.triangles.empty(); }
};

/// The default radius of sticks in Å, as in most programs.
inline constexpr double kStickRadius = 0.25;
inline constexpr double kThinStickRadius = 0.15;
inline constexpr double kDashRadius = 0.1;
/// The radius of balls as a share of the van der Waals radius.
inline constexpr double kBallShare = 0.25;

/// In the following functions `selected` has one entry for each atom of the structure, and `bonds` are pairs of indices
/// into Structure::atoms (bonds.h), which are drawn if both atoms are selected. Radii are in Å.

/// Returns a cylinder for each bond, and a sphere of its radius for each atom. An atom without a drawn bond becomes a
/// ball of kBallShare, but no thinner than a stick.
Shapes sticks(const Structure& structure, const std::vector<bool>& selected, std::span<const Bond> bonds,
              double radius = kStickRadius);

/// Returns cylinders and balls: a ball has a share of the van der Waals radius, but is no thinner than a stick.
Shapes balls_and_sticks(const Structure& structure, const std::vector<bool>& selected, std::span<const Bond> bonds,
                        double ball_share = kBallShare, double stick_radius = kThinStickRadius);

/// Returns a sphere for each atom, with a share of its van der Waals radius.
Shapes spheres(const Structure& structure, const std::vector<bool>& selected, double share = 1.0);

/// Returns dashed lines between the atoms of each pair: short cylinders with round ends, one each 0.5 Å.
Shapes dashes(const Structure& structure, std::span<const Bond> pairs, double radius = kDashRadius);

/// Adds a flat body: the polygon, counter-clockwise around the unit normal, extended by `half_thickness` (Å) to both
/// sides. Each point of the polygon must be visible from its middle. All triangles get this atom.
void add_plate(MeshShape& mesh, std::span<const glm::dvec3> polygon, const glm::dvec3& normal, double half_thickness,
               std::uint32_t atom);

/// Appends the second shapes to the first.
void append(Shapes& shapes, const Shapes& more);

/// Returns balls that together hold all shapes, for framing.
std::vector<Ball> balls_around(const Shapes& shapes);

/// The radius of tubes, Å. Ribbons are 0.6 times as thick.
inline constexpr double kTubeRadius = 0.45;

/// Returns a closed mesh for each unbroken piece of at least two residues, and a sphere for each single one. A residue
/// is represented by its selected CA atom, in nucleotides by P or else O5' or C4', in Martini models by BB.
///
/// Helices are ribbons with a width of 6 radii, along the direction of the peptide planes (M. Carson and C. E. Bugg, J.
/// Mol. Graph. 4, 121, 1986; computed from O, if present). Strands have a width of 5.6 radii and end in arrows. Nucleic
/// acids are bands as wide as strands, with their flat side to the bases (to C1', if present). All else is a tube. The
/// middle line is a Catmull-Rom spline through these atoms, smoothed in strands. Atom::secondary says
/// which residues are helices and strands, else secondary_structure() of these atoms. Pieces end where the chain, model
/// or copy changes and where neighbours are farther apart than 4.5 Å (CA) or 8.5 Å (P). Each vertex has the atom of the
/// nearer residue. `radius` is in Å, above 0.
Shapes backbone(const Structure& structure, const std::vector<bool>& selected, double radius = kTubeRadius);

/// A point of the middle line of backbone().
struct MiddlePoint {
  glm::dvec3 position;  ///< Å
  std::uint32_t atom;   ///< index into Structure::atoms of the atom of the nearer residue
};

/// Returns the middle lines of all nucleotides of the structure, piece by piece, with eight points per residue.
std::vector<MiddlePoint> nucleic_middle_lines(const Structure& structure);

/// Returns the indices of the atoms, copy by copy, in the order of their file.
std::vector<std::uint32_t> file_order(std::span<const Atom> atoms);

/// Returns the shapes of each nucleotide with a selected base: its rings as plates with round rims, twice the radius
/// (Å) thick, and a rung from there by C1' to the middle line of backbone(). Rings are recognised by the numbers of
/// their atoms, so that modified bases have them, too; a ring that is incomplete or not closed is left out. Plates have
/// the colour of C4, and rims the colours of their atoms.
Shapes bases(const Structure& structure, const std::vector<bool>& selected, double radius = kStickRadius);

/// Returns backbone() and, for the nucleotides of polymers among the selected atoms, bases(). Radii are in Å.
Shapes cartoon(const Structure& structure, const std::vector<bool>& selected, double tube_radius = kTubeRadius,
               double base_radius = kStickRadius);

/// Half the height (Å) of a symbol, which is about as large as the ring.
inline constexpr double kSymbolRadius = 2.0;

/// Returns a symbol (core/structure/sugars.h) for each sugar with all ring atoms selected. It is in the middle of the
/// ring, upright along the line from the far side of the ring to its anomeric carbon, and has round edges. Sticks
/// (`radius` in Å) lead to the symbols that it is linked to, and to CA of a linked amino acid. Symbols have the colour
/// of the anomeric carbon, their white halves that of the first atom outside of the ring; By::snfg colours both.
Shapes sugar_symbols(const Structure& structure, const std::vector<bool>& selected, double radius = kStickRadius);

}  // namespace meniscus
