// SPDX-License-Identifier: BSD-3-Clause
// The options of a scene, and the report of what was written.
#pragma once

#include "core/base/output_file.h"
#include "core/color/color_key.h"
#include "core/queries/surface_object.h"
#include "core/render/look.h"
#include "core/render/picture.h"

namespace meniscus::povray {

/// The materials of a surface in POV-Ray.
enum class Material {
  opaque,
  ghost,  ///< translucent; only the sides that face the viewer are drawn
  glass,  ///< refracts as one solid
  wax,    ///< light scatters below the surface
  flat    ///< unlit colours
};

/// The planes that cut a surface, and the style of the caps.
struct SurfaceCut {
  std::vector<ClipPlane> planes;  ///< empty if the surface is not cut
  CapStyle style;
};

/// A further object of a scene: a surface or shapes, with its own cut and material. The objects that it points to must
/// live until the scene is written.
struct SceneObject {
  const SurfaceObject* surface = nullptr;  ///< a surface that is neither copied nor moved, or nullptr
  const ColoredShapes* shapes = nullptr;   ///< shapes, or nullptr; exactly one of the two pointers is set
  SurfaceCut cut;                          ///< planes that cut the surface
  bool film = false;                       ///< PictureObject::thickens
  MaterialRequest material;                ///< differences from the material of the scene
};

/// The settings of a POV-Ray scene.
struct SceneOptions {
  std::string name = "surface";           ///< begins all file names; letters, digits, '-' and '_' only
  int width = 1280, height = 960;         ///< pixels
  Material material = Material::opaque;   ///< the scene's default; every scene holds all of them
  glm::vec3 background{1.0f};             ///< sRGB
  float shadows = 0.0f;                   ///< Look::shadows
  float shadow_softness = 0.0f;           ///< Look::shadow_softness
  Existing existing = Existing::refuse;   ///< the action if a file exists
  std::optional<glm::dvec3> origin;       ///< origin of the scene's coordinates, Å; empty: the middle of all atoms
  const ColoredShapes* shapes = nullptr;  ///< shapes in addition to the surface; no file if nullptr or empty
  std::vector<SceneObject> objects;       ///< further objects in addition to the surface
  SurfaceCut cut;                         ///< planes that cut the surface; a run uses the style only
  bool film = false;                      ///< true if a translucent surface is denser at grazing angles
  std::optional<ColorKey> colors;         ///< the meaning of the colours, for <name>_objects.json and for comments
  /// Empty, or a name for each of the atoms that SurfaceObject::atom refers to. Pieces then have comments with their
  /// kind and atoms. In a run, each frame has names of its own (Shown::names). Names may come from a molecule file; a
  /// name that is not harmless (harmless_name()) is left out.
  std::vector<std::string> atom_names;
};

/// A report of the written files, and of things that could not be written.
struct SceneReport {
  std::vector<std::filesystem::path> files;  ///< paths of the written files
  std::size_t object_count = 0;  ///< number of primitives without copies; a patch of several colours counts more often
  std::vector<std::string> notes;  ///< sentences about things left out or slow; empty if everything is shown
  glm::dvec3 origin{0.0};          ///< scene coordinates + origin = molecule coordinates
  std::string command;             ///< for a POSIX shell: renders the picture from any folder
};

}  // namespace meniscus::povray
