// SPDX-License-Identifier: BSD-3-Clause
// A figure: a molecule with everything that is drawn with it, the meaning of its colours, and its motion.
#pragma once

#include "core/camera/camera.h"
#include "core/color/color_key.h"
#include "core/mesh/velocity.h"
#include "core/render/picture.h"
#include "core/scene/cut.h"
#include "core/scene/figure_object.h"
#include "core/scene/molecule.h"
#include "core/scene/representations.h"

namespace meniscus {

class FrameRun;
class StillRenderer;
struct Scene;

/// The motion of a figure from one frame to the next.
struct FigureMotion {
  std::vector<glm::dvec3> atoms;  ///< displacement of each of shown_atoms() to its place in the next frame, Å
  Camera camera;                  ///< camera of the next frame
};

/// Returns the displacement of each of merged(objects).surface.atoms. atoms: the displacements of shown_atoms().
std::vector<glm::dvec3> placed_ways(std::span<const SurfaceObject> objects, std::span<const glm::dvec3> atoms);

/// The motion of points in one picture. Points of a surface move as SurfaceVelocity says, points of shapes and caps
/// like their atom.
class PointMotion {
 public:
  /// The motion must outlive this object.
  PointMotion(const FigureMotion& motion, const Camera& camera, glm::ivec2 size)
      : motion_(motion), camera_(camera), size_(size) {}

  /// Adds the next object of the picture: a surface with the displacements of its atoms, or shapes. The surface must
  /// outlive this object.
  void add(const Surface& surface, std::span<const glm::dvec3> atoms);
  void add_shapes() { objects_.emplace_back(); }

  /// Returns the motion of a point in pixels, to the right and upwards.
  glm::vec2 at(const SeenPoint& point) const;

 private:
  struct Object {
    std::vector<glm::dvec3> atoms;
    std::vector<SurfaceVelocity> surface;  // one element, or none for shapes
  };

  const FigureMotion& motion_;
  const Camera camera_;
  const glm::dvec2 size_;
  std::vector<Object> objects_;
};

/// The parts of a molecule that are shown, and their looks.
struct FigureRequest {
  std::vector<Cut> cuts;            ///< cuts of the surface
  bool cuts_all = false;            ///< true: cuts also apply to everything drawn in addition to the surface
  CapStyle cap;                     ///< the look of cut faces
  bool thickens = false;            ///< PictureObject::thickens
  bool hides_surface = false;       ///< true: the surface is not drawn, only what is drawn in addition to it
  bool bare = false;                ///< true: companions (read_structure.h) are not drawn
  Representations representations;  ///< drawn in addition to the surface
  std::vector<FigureObjectRequest> objects;

  /// Makes read_structure mark and keep the atoms of everything drawn in addition to the surface, and companions.
  void mark_atoms(ReadOptions& reading) const;

  /// Throws RequestError if the surface is hidden and nothing else is drawn.
  void check() const;

  /// True if the figure is a surface and no more.
  bool plain() const {
    return cuts.empty() && !thickens && !hides_surface && representations.empty() && objects.empty();
  }
};

/// The shapes and objects that are drawn in addition to the molecule's surface, and the atoms that place its cuts.
/// Atoms are places in shown_atoms().
struct FigureExtras {
  ColoredShapes shapes;               ///< shapes of FigureRequest::representations
  std::vector<FigureObject> objects;  ///< one per FigureRequest::objects, and one for companions if there are any
  CutAtoms cut_atoms;                 ///< atoms of FigureRequest::cuts

  bool empty() const { return shapes.empty() && objects.empty(); }
  /// Returns balls around all of it, for framing.
  std::vector<Ball> balls() const;
  std::vector<PlaceLabel> lengths() const;
};

/// Everything in a figure, ready to be drawn.
struct Figure {
  Molecule molecule;
  FigureExtras extras;

  /// Returns balls for framing: the atoms of the surface at all their places, and balls around everything else.
  std::vector<Ball> balls() const;
};

/// Returns everything that is drawn in addition to the surface of a structure; the structure must have been read with
/// request.mark_atoms(). scheme: the molecule's colours. Throws InputError for colours by numbers that the atoms do
/// not have and for an object without atoms, RequestError for an assembly of instances, and the errors of computing a
/// surface (surface_objects).
FigureExtras make_extras(const Structure& structure, const FigureRequest& request, const ColorScheme& scheme);

/// Updates the colours, opacities and shown parts of `extras`, which must be made from the same atoms. Surfaces are not
/// computed again.
void color_extras(const Structure& structure, const FigureRequest& request, const ColorScheme& scheme,
                  FigureExtras& extras);

/// Returns the molecule with everything that is drawn in addition to its surface. Throws what make_extras() throws.
Figure make_figure(Molecule molecule, const FigureRequest& request);

/// Returns the planes that cut the surface, as seen by this camera. cut_atoms: returned by cut_atoms() for
/// request.cuts. objects: all objects of the surface, with their copies.
std::vector<ClipPlane> surface_planes(const FigureRequest& request, const CutAtoms& cut_atoms, const Camera& camera,
                                      std::span<const SurfaceObject> objects);

/// Returns a sentence for each cut, of the molecule's surface or of an additional one, that removes nothing or all.
/// Adds a sentence if cuts keep a shape or an additional object that lies beyond their planes.
std::vector<std::string> ineffective_cuts(const FigureRequest& request, const Figure& figure, const Camera& camera);

/// Returns the objects of a picture: one surface, with the requested cuts and opacities, and everything in `extras`
/// (nullptr: nothing, and no cuts by atoms).
/// atoms: all atoms in the picture, for cuts along the view. All arguments must outlive the objects. Throws
/// RequestError if nothing is shown.
std::vector<PictureObject> picture_objects(const Surface& surface, const Coloring& coloring,
                                           const FigureRequest& request, const FigureExtras* extras,
                                           const Camera& camera, std::span<const Ball> atoms);

/// Returns the additional surface in `extras` that an object of a picture shows; nullptr if it shows none of them.
const SurfaceObject* extra_surface(const FigureExtras& extras, const PictureObject& shown);

/// A function that casts a second picture of the figure to be drawn: one ray per pixel, with AOVs.
using CastSurvey = std::function<Framebuffer(const Camera& camera, glm::ivec2 size)>;
/// A function that looks at such pictures before the figure is drawn.
using Survey = std::function<void(const CastSurvey& cast)>;

/// Renders the figure. The AOV `atom` is the place in the file (Atom::index), as in all outputs; copies share it.
/// Framebuffer::seen has places in shown_atoms(). motion: to the next frame; needed if settings.motion is set. Throws
/// like StillRenderer::render().
Framebuffer draw(StillRenderer& renderer, Figure figure, const FigureRequest& request, const Camera& camera,
                 const RenderSettings& settings, const Survey& survey = {}, const FigureMotion* motion = nullptr);

/// Returns the key of the colours of the atoms in a picture. structure: read with request.mark_atoms() if anything
/// is drawn in addition to the surface. drawn: one truth value per atom of the surface. `extras`: made by make_extras()
/// from the same structure, request and scheme. Throws InputError if colours are by a number that the atoms do not have
/// (color_atoms).
ColorKey figure_key(const Structure& structure, const ColorScheme& scheme, DrawnAtoms drawn,
                    const FigureRequest& request, const FigureExtras& extras);

/// Returns the key of a molecule that is drawn, and of everything in `extras`. If a cut may open its surface, all atoms
/// count, else only atoms with a part of it.
ColorKey key_of(const Molecule& molecule, const FigureRequest& request = {}, const FigureExtras& extras = {});

/// Returns the key for all frames of a run. If the scene has no legend but may have additional surfaces, everything in
/// addition to the molecule's surface is left out.
ColorKey key_of(const FrameRun& run, const Scene& scene);

}  // namespace meniscus
