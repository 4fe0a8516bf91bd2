// SPDX-License-Identifier: BSD-3-Clause
// A further object of a figure with a look of its own: a surface, sticks, balls, spheres or a
// backbone.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/color/color_schemes.h"
#include "core/math/ball.h"
#include "core/queries/surface_object.h"
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
  std::optional<ColorScheme> color{};                   ///< nothing: the molecule's
  std::vector<OpacityRule> opacities{};                 ///< the object's own; those of the molecule do not count here
  MaterialRequest material{};
  std::optional<double> radius{};  ///< Å, of sticks and backbones; nothing: the usual one

  // Of surfaces.
  SurfaceKind kind = SurfaceKind::ses;
  double probe_radius = kUsualProbe;  ///< Å
  std::optional<Selection> show{};    ///< of the atoms, those whose part of the surface is drawn
  std::vector<Cut> cuts{};
  CapStyle cap{};
  bool thickens = false;  ///< PictureObject::thickens
};

/// What is drawn of them: a surface, or shapes. Atoms are places in shown_atoms().
struct FigureObject {
  std::optional<SurfaceObject> surface;
  ColoredShapes shapes;
  CutAtoms cut_atoms;  ///< of FigureObjectRequest::cuts
};

/// Makes read_structure mark the atoms of the objects, behind those it marks already. Throws RequestError for more than
/// it can mark, or for copies as instances.
void ask_for(std::span<const FigureObjectRequest> objects, ReadOptions& reading);

/// The objects, one each. structure: as read with ask_for(). first_mark: how many sets of atoms are marked for others.
/// scheme: the molecule's colours. Surfaces are computed on the CPU. Throws what surface_objects and color_object
/// throw; InputError for a surface without atoms.
std::vector<FigureObject> make_objects(std::span<const FigureObjectRequest> objects, const Structure& structure,
                                       std::size_t first_mark, const ColorScheme& scheme);

/// Colours, opacities and shown parts of objects as make_objects makes them; their atoms, surfaces and shapes stay.
void color_objects(std::span<const FigureObjectRequest> requests, const Structure& structure, const ColorScheme& scheme,
                   std::vector<FigureObject>& objects);

/// The colours of one object. shown: the number of all atoms.
ColorScheme scheme_of(const FigureObjectRequest& request, const Structure& structure, std::size_t shown,
                      const ColorScheme& scheme);

/// What encloses it, for framing.
std::vector<Ball> balls_of(const FigureObject& object);

/// The object in a picture; `balls` as for clip_plane. Both must stay until the picture is made.
PictureObject picture_object(const FigureObject& object, const FigureObjectRequest& request, const Camera& camera,
                             std::span<const Ball> balls);

}  // namespace meniscus
