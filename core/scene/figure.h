// SPDX-License-Identifier: BSD-3-Clause
// A figure: a molecule with everything that is drawn with it, and its motion to the next frame.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/camera/camera.h"
#include "core/mesh/velocity.h"
#include "core/render/picture.h"
#include "core/scene/cut.h"
#include "core/scene/figure_object.h"
#include "core/scene/molecule.h"
#include "core/scene/representations.h"

namespace meniscus {

struct SurfaceObject;

/// The motion of a figure from one frame to the next.
struct FigureMotion {
  std::vector<glm::dvec3> atoms;  ///< of shown_atoms(): to where each is then, Å
  Camera camera;                  ///< by which that frame is seen
};

/// The ways of merged(objects).surface.atoms. atoms: those of shown_atoms().
std::vector<glm::dvec3> placed_ways(std::span<const SurfaceObject> objects, std::span<const glm::dvec3> atoms);

/// The points of one picture. Points of a surface move as SurfaceVelocity says, those of shapes and caps as their atom.
class PointMotion {
 public:
  /// motion: must stay.
  PointMotion(const FigureMotion& motion, const Camera& camera, glm::ivec2 size)
      : motion_(motion), camera_(camera), size_(size) {}

  /// The next object of the picture: a surface with the ways of its atoms, or shapes. It must stay.
  void add(const Surface& surface, std::span<const glm::dvec3> atoms);
  void add_shapes() { objects_.emplace_back(); }

  /// Returns the motion of a point in pixels, to the right and upwards.
  glm::vec2 at(const SeenPoint& point) const;

 private:
  struct Object {
    std::vector<glm::dvec3> atoms;
    std::vector<SurfaceVelocity> surface;  // one, or none
  };

  const FigureMotion& motion_;
  const Camera camera_;
  const glm::dvec2 size_;
  std::vector<Object> objects_;
};

class StillRenderer;

/// What is shown of a molecule, and how.
struct FigureRequest {
  std::vector<Cut> cuts;            ///< of the surface
  bool cuts_all = false;            ///< they cut what is drawn beside it, too
  CapStyle cap;                     ///< where they cut
  bool thickens = false;            ///< PictureObject::thickens
  bool hides_surface = false;       ///< it is not drawn, only what is drawn beside it
  Representations representations;  ///< beside the surface
  std::vector<FigureObjectRequest> objects;

  /// Makes read_structure mark and keep the atoms of all that is beside the surface.
  void ask_for(ReadOptions& reading) const;

  /// Throws RequestError if the surface is hidden and nothing is asked for beside it.
  void check() const;

  /// Whether it is a surface and no more.
  bool plain() const {
    return cuts.empty() && !thickens && !hides_surface && representations.empty() && objects.empty();
  }
};

/// What is drawn beside the molecule's surface, ready to be drawn, and what its cuts go by. Atoms are places in
/// shown_atoms().
struct BesideSurface {
  ColoredShapes shapes;               ///< of FigureRequest::representations
  std::vector<FigureObject> objects;  ///< one for each of FigureRequest::objects
  CutAtoms cut_atoms;                 ///< of FigureRequest::cuts

  bool empty() const { return shapes.empty() && objects.empty(); }
  /// For framing.
  std::vector<Ball> balls() const;
};

/// Everything of a figure, ready to be drawn.
struct Figure {
  Molecule molecule;
  BesideSurface beside;

  /// For framing: atoms of the surface at all places, and what is drawn beside it.
  std::vector<Ball> balls() const;
};

/// What stands beside the surface of a structure that was read with request.ask_for(). scheme: the molecule's colours.
/// Throws as shown_shapes and make_objects do.
BesideSurface make_beside(const Structure& structure, const FigureRequest& request, const ColorScheme& scheme);

/// The same of the same atoms in other colours, opacities and with other parts shown; surfaces are not computed again.
void color_beside(const Structure& structure, const FigureRequest& request, const ColorScheme& scheme,
                  BesideSurface& beside);

/// The molecule with what is drawn beside it. Throws as make_beside does.
Figure make_figure(Molecule molecule, const FigureRequest& request);

/// The planes that cut the surface, seen by this camera. cut_atoms: of request.cuts. objects: of all the surface, with
/// their copies.
std::vector<ClipPlane> surface_planes(const FigureRequest& request, const CutAtoms& cut_atoms, const Camera& camera,
                                      std::span<const SurfaceObject> objects);

/// A sentence for each cut of the molecule's surface, and of those beside it, that takes nothing away or leaves
/// nothing; and one if cuts leave something beside the surface that lies beyond them.
std::vector<std::string> idle_cuts(const FigureRequest& request, const Figure& figure, const Camera& camera);

/// What a picture shows of one surface: cut and seen through as asked, and what is drawn beside it (nullptr: nothing,
/// and no cuts by atoms).
/// atoms: of all that the picture shows, for cuts along the view. All must stay. Throws RequestError if there is
/// nothing to be shown.
std::vector<PictureObject> picture_objects(const Surface& surface, const Coloring& coloring,
                                           const FigureRequest& request, const BesideSurface* beside,
                                           const Camera& camera, std::span<const Ball> atoms);

/// The surface among those beside the molecule's that an object of a picture shows; nullptr: none of them.
const SurfaceObject* surface_beside(const BesideSurface& beside, const PictureObject& shown);

/// Casts another picture of the figure that is about to be drawn: one ray a pixel, with its AOVs.
using CastSurvey = std::function<Framebuffer(const Camera& camera, glm::ivec2 size)>;
/// What looks at such pictures first.
using Survey = std::function<void(const CastSurvey& cast)>;

/// Renders the figure. The AOV `atom` is the place in the file (Atom::index), as everywhere; copies share it.
/// Framebuffer::seen has places in shown_atoms(). motion: for settings.motion, to the next frame. Throws as
/// StillRenderer::render() does.
Framebuffer draw(StillRenderer& renderer, Figure figure, const FigureRequest& request, const Camera& camera,
                 const RenderSettings& settings, const Survey& survey = {}, const FigureMotion* motion = nullptr);

}  // namespace meniscus
