// SPDX-License-Identifier: BSD-3-Clause
// Shapes in addition to a surface: atoms drawn as sticks, balls, spheres, a backbone, bases or sugars; their colours.
#pragma once

#include "core/color/color_schemes.h"
#include "core/queries/surface_object.h"
#include "core/structure/formats/read_structure.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"

namespace meniscus {

/// Some atoms, drawn in one way. They need not be atoms of the surface.
struct RepresentationRequest {
  enum class Kind { sticks, balls_and_sticks, spheres, backbone, bases, sugar_symbols, hydrogen_bonds, distance };
  Kind kind = Kind::sticks;
  Selection atoms;
  std::string lack{};  ///< message of the error if there are no such atoms; empty: the usual one
};

/// The words of kinds in scene files; each is the name of the property that requests it.
inline constexpr const char* kShapeWords[] = {"sticks", "balls",   "spheres",        "tube",
                                              "bases",  "glycans", "hydrogen_bonds", "distance"};
constexpr const char* shape_word(RepresentationRequest::Kind kind) { return kShapeWords[static_cast<int>(kind)]; }

/// True if a shape consists of dashed lines. They are objects of their own (FigureObjectRequest).
constexpr bool draws_dashes(RepresentationRequest::Kind kind) {
  return kind >= RepresentationRequest::Kind::hydrogen_bonds;
}

/// True if a shape shows every atom, or the whole sugar, that it is made of.
constexpr bool draws_each_atom(RepresentationRequest::Kind kind) {
  using Kind = RepresentationRequest::Kind;
  return kind != Kind::backbone && kind != Kind::bases && !draws_dashes(kind);
}

/// Radii of shapes, Å; nothing: the default radii.
struct ShapeRadii {
  std::optional<double> stick_radius;  ///< applies to bases, too; default: kStickRadius, with balls kThinStickRadius
  std::optional<double> tube_radius;   ///< default: kTubeRadius
};

/// All requested representations, and their common radii.
struct Representations : ShapeRadii {
  std::vector<RepresentationRequest> requests;

  bool empty() const { return requests.empty(); }
  /// Makes read_structure mark the atoms, keep atoms that the surface leaves out, and find their bonds. Bonds are found
  /// once, at the positions that are read, so that they are the same in all frames of a run.
  void mark_atoms(ReadOptions& reading) const;
};

/// Returns the structure's atoms, followed by the atoms drawn in addition to the surface. The `atom` of a shape is a
/// place in this list.
std::vector<Atom> shown_atoms(const Structure& structure);
/// Returns shown_atoms() as a structure of their own.
Structure structure_of_shown(const Structure& structure);
/// Returns, per atom of structure_of_shown(), true if the selection in ReadOptions::shown with this index selects it.
std::vector<bool> marked_atoms(const Structure& all, std::size_t mark);

/// Returns the shapes of some atoms of structure_of_shown(). bonds: Structure::shown_bonds. Throws InputError if bases
/// or sugars are requested and there are none.
Shapes shapes_of_atoms(const Structure& all, RepresentationRequest::Kind kind, const std::vector<bool>& selected,
                       const std::vector<Bond>& bonds, const ShapeRadii& radii);

/// Returns the scheme for all shown atoms with the ranges that it has for the surface's atoms, so that a number has one
/// colour on everything that is drawn. shown: number of shown atoms. Numbers that are known for the surface's atoms
/// only are missing for others. By::automatic becomes resolved_scheme(). Throws RequestError for a map that gives each
/// number its own colour.
ColorScheme with_scale_of(const Structure& structure, std::size_t shown, ColorScheme scheme);

/// Returns the scheme that By::automatic means for shapes: `chain` for backbones, else `chain_element`. Returns any
/// other scheme as it is.
ColorScheme::By scheme_of_shapes(ColorScheme::By scheme, RepresentationRequest::Kind kind);

/// Returns with_scale_of() for shapes of one kind: opaque, and by element if the scheme applies to surfaces only.
ColorScheme extras_scheme(const Structure& structure, std::size_t shown, ColorScheme scheme,
                          RepresentationRequest::Kind kind);

/// Returns the shapes of shown_atoms() at the positions of the structure, with the colours of the surface: chains have
/// the same colours, numbers the same scale. A scheme for surfaces only (patch kinds, components) is replaced by
/// elements. structure: as read with mark_atoms(). Throws InputError for colours by a number that the atoms do not
/// have, and RequestError for an assembly of instances.
ColoredShapes shown_shapes(const Structure& structure, const Representations& representations,
                           const ColorScheme& scheme);

}  // namespace meniscus
