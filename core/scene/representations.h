// SPDX-License-Identifier: BSD-3-Clause
// Shapes beside a surface: the atoms drawn as sticks, balls, spheres, a backbone, bases or sugars, and their colours.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/color/color_schemes.h"
#include "core/queries/surface_object.h"
#include "core/structure/formats/read_structure.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"

namespace meniscus {

/// Some atoms, drawn in one way. They need not be atoms of the surface.
struct RepresentationRequest {
  enum class Kind { sticks, balls_and_sticks, spheres, backbone, bases, sugar_symbols };
  Kind kind = Kind::sticks;
  Selection atoms;
};

/// The words of kinds in scene files, each the name of the property that asks for it.
inline constexpr const char* kShapeWords[] = {"sticks", "balls", "spheres", "tube", "bases", "glycans"};
constexpr const char* shape_word(RepresentationRequest::Kind kind) { return kShapeWords[static_cast<int>(kind)]; }

/// Å; nothing: the usual ones.
struct ShapeRadii {
  std::optional<double> stick_radius;  ///< of bases, too; kStickRadius, kThinStickRadius with balls
  std::optional<double> tube_radius;   ///< kTubeRadius
};

/// All that are asked for, and what they have in common.
struct Representations : ShapeRadii {
  std::vector<RepresentationRequest> requests;

  bool empty() const { return requests.empty(); }
  /// Makes read_structure mark the atoms, keep those that the surface leaves out, and find their bonds: once, at the
  /// positions that it reads, so that they are the same in all frames of a run.
  void ask_for(ReadOptions& reading) const;
};

/// The structure's atoms, and after them those beside the surface: what `atom` of shapes is a place in.
std::vector<Atom> shown_atoms(const Structure& structure);
/// The same as a structure of its own.
Structure structure_of_shown(const Structure& structure);
/// Of its atoms, those that the n-th of ReadOptions::shown selects.
std::vector<bool> marked_atoms(const Structure& all, std::size_t mark);

/// Some atoms of structure_of_shown(). bonds: Structure::shown_bonds. Throws InputError where bases or sugars are asked
/// for and there are none.
Shapes shapes_of_atoms(const Structure& all, RepresentationRequest::Kind kind, const std::vector<bool>& selected,
                       const std::vector<Bond>& bonds, const ShapeRadii& radii);

/// The scheme with the ranges that it has for the surface's atoms, for all shown atoms, so many: a number has one
/// colour, whatever it is drawn on; what is known of the surface's atoms alone is missing of others. Throws
/// RequestError where each number has a colour of its own.
ColorScheme with_scale_of(const Structure& structure, std::size_t shown, ColorScheme scheme);

/// The same for shapes: opaque, and by element where colours are of surfaces alone.
ColorScheme scheme_beside(const Structure& structure, std::size_t shown, ColorScheme scheme);

/// The shapes of shown_atoms(), where the atoms of the structure are, coloured as the surface is: chains have the
/// colours they have there, numbers the same scale; where the scheme is of surfaces only (patch kinds, components), by
/// element. Structure: as read with ask_for(). Throws as color_object does; RequestError for an assembly of instances.
ColoredShapes shown_shapes(const Structure& structure, const Representations& representations,
                           const ColorScheme& scheme);

}  // namespace meniscus
