// SPDX-License-Identifier: BSD-3-Clause
// A further object of a figure with a look of its own: a surface, sticks, balls, spheres or a
// backbone.
#pragma once

#include "core/color/color_schemes.h"
#include "core/math/ball.h"
#include "core/queries/surface_object.h"
#include "core/render/annotation.h"
#include "core/render/picture.h"
#include "core/scene/cut.h"
#include "core/scene/representations.h"
#include "core/scene/surface_computer.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"

namespace meniscus {

/// Some atoms of the file, which need not be atoms of the molecule's surface, and how they are drawn.
struct FigureObjectRequest {
  Selection atoms;
  std::optional<RepresentationRequest::Kind> shapes{};  ///< nothing: the surface of these atoms, as if they were alone
  std::optional<Selection> partners{};   ///< atoms at the other ends of dashed lines; nothing: all that are drawn
  std::optional<ColorScheme> color{};    ///< nothing: the molecule's colours, or kDashColor
  std::vector<OpacityRule> opacities{};  ///< opacities of this object; the molecule's opacities do not apply to it
  MaterialRequest material{};
  std::optional<double> radius{};  ///< radius of sticks, backbones and dashes, Å; nothing: the default radius

  // These members apply to surfaces only.
  SurfaceKind kind = SurfaceKind::ses;
  double probe_radius = kUsualProbe;  ///< Å
  std::optional<Selection> show{};    ///< atoms of the object whose part of the surface is drawn; nothing: all
  std::vector<Cut> cuts{};
  CapStyle cap{};
  bool thickens = false;  ///< PictureObject::thickens

  bool is_companion = false;  ///< true for the object of all companions (Companions); users cannot request it

  /// True if its colours do not follow the molecule's scheme.
  bool has_own_colors() const { return color.has_value() || is_companion || is_dashed(); }
  bool is_dashed() const { return shapes && draws_dashes(*shapes); }
  /// Returns the name of the option that requests it, for option_name().
  std::string option() const {
    return !is_dashed() ? "object" : *shapes == RepresentationRequest::Kind::distance ? "distance" : "hydrogen-bonds";
  }
  /// Returns the text of the selection, which parse_dashes() reads.
  std::string text() const { return atoms.text() + (partners ? " to " + partners->text() : ""); }
};

inline constexpr double kCompanionRadius = 0.4;  ///< Å; radius of the sticks of companions

/// The colour of dashed lines without a colour of their own, sRGB.
inline constexpr glm::vec3 kDashColor{1.0f, 0.70f, 0.0f};

/// Reads the atoms of dashed lines: "EXPR to EXPR" or, for hydrogen bonds, also "EXPR". Throws RequestError and
/// SelectionError.
FigureObjectRequest parse_dashes(RepresentationRequest::Kind kind, std::string_view text);

/// A drawn object: a surface, or shapes. Atoms are places in shown_atoms().
struct FigureObject {
  std::optional<SurfaceObject> surface;
  ColoredShapes shapes;
  std::vector<PlaceLabel> lengths;  ///< the length of each dashed line: "2.9 Å"
  CutAtoms cut_atoms;               ///< atoms of FigureObjectRequest::cuts
};

/// Makes read_structure mark the atoms of the objects, after the sets that it already marks. Throws RequestError for
/// more sets than it can mark, and for copies as instances.
void mark_atoms(std::span<const FigureObjectRequest> objects, ReadOptions& reading);

/// Returns the request of the n-th object in a figure. After the objects of the requests comes the object of the
/// companions, if the structure has any: ligands as sticks and ions as spheres, coloured by element and by the rules of
/// the molecule's scheme.
const FigureObjectRequest& request_of(std::span<const FigureObjectRequest> objects, std::size_t n);

/// Returns the requests of all objects in a figure of this structure.
std::vector<FigureObjectRequest> all_requests(std::span<const FigureObjectRequest> objects, const Structure& structure);

/// Returns the objects of all_requests(). structure: read with mark_atoms(). first_mark: number of sets of atoms that
/// are marked for other purposes. scheme: the molecule's colours. Surfaces are computed on the CPU. Throws InputError
/// for a surface without atoms and for colours by a number that the atoms do not have, and the errors of computing a
/// surface (surface_objects).
std::vector<FigureObject> make_objects(std::span<const FigureObjectRequest> objects, const Structure& structure,
                                       std::size_t first_mark, const ColorScheme& scheme);

/// Updates the colours, opacities and shown parts of objects made by make_objects(). Their surfaces and shapes stay.
void color_objects(std::span<const FigureObjectRequest> requests, const Structure& structure, const ColorScheme& scheme,
                   std::vector<FigureObject>& objects);

/// Returns the colours of one object. shown: number of all shown atoms.
ColorScheme scheme_of(const FigureObjectRequest& request, const Structure& structure, std::size_t shown,
                      const ColorScheme& scheme);

/// Returns balls that enclose the object, for framing.
std::vector<Ball> balls_of(const FigureObject& object);

/// Returns the object for a picture. balls: as for clip_plane(). `object` and `request` must outlive the drawing.
PictureObject picture_object(const FigureObject& object, const FigureObjectRequest& request, const Camera& camera,
                             std::span<const Ball> balls);

}  // namespace meniscus
