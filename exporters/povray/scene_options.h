// SPDX-License-Identifier: BSD-3-Clause
// The options of a scene, and the report of what was written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/output_file.h"
#include "core/color/color_key.h"
#include "core/queries/colored_shapes.h"
#include "core/queries/surface_object.h"
#include "core/render/look.h"
#include "core/render/picture_object.h"

namespace meniscus::povray {

enum class Material {
  opaque,
  ghost,  ///< see-through; only the sides that face the viewer are drawn
  glass,  ///< refracts as one solid
  wax,    ///< light scatters below the surface
  flat    ///< colours as they are, without light
};

/// The planes that a surface is cut by.
struct SurfaceCut {
  std::vector<ClipPlane> planes;  ///< none: it is whole
  CapStyle style;
};

/// Something more in a scene: a surface or shapes, with what is its own. What it points to must stay until it is
/// written.
struct SceneObject {
  const SurfaceObject* surface = nullptr;  ///< this one, standing in one place, not moved,
  const ColoredShapes* shapes = nullptr;   ///< or these
  SurfaceCut cut;                          ///< of the surface
  bool film = false;                       ///< PictureObject::thickens
  MaterialRequest material;                ///< what differs from the scene's
};

struct SceneOptions {
  std::string name = "surface";          ///< of all files; letters, digits, '-' and '_' only, since it is in the scene
  int width = 1280, height = 960;        ///< pixels
  Material material = Material::opaque;  ///< the scene's default; every scene holds all of them
  glm::vec3 background{1.0f};            ///< sRGB
  float shadows = 0.0f;                  ///< Look::shadows
  float shadow_softness = 0.0f;          ///< Look::shadow_softness
  Existing existing = Existing::refuse;
  std::optional<glm::dvec3> origin;  ///< Å: where coordinates of the scene begin; nothing: the middle of all atoms
  const ColoredShapes* shapes = nullptr;  ///< beside the surface; nothing, or none: no file of them
  std::vector<SceneObject> objects;       ///< likewise
  SurfaceCut cut;                         ///< of the surface; of a run only the style counts
  bool film = false;                      ///< a surface that is seen through is denser where the view grazes it
  std::optional<ColorKey> colors;         ///< what the colours mean: for <name>_objects.json, and beside the colours
  /// Nothing, or a name for each of the atoms that SurfaceObject::atom counts: pieces then have comments that tell
  /// their kind and atoms. Of a run each frame has its own. They may come from a molecule file; what is not harmless
  /// (scene_report.h) is left out.
  std::vector<std::string> atom_names;
};

/// What was written and what was not.
struct SceneReport {
  std::vector<std::filesystem::path> files;
  std::size_t object_count = 0;    ///< primitives, copies not counted; atoms of several colours may share a patch
  std::vector<std::string> notes;  ///< sentences: what was left out, what will be slow; empty when all is shown
  glm::dvec3 origin{0.0};          ///< scene coordinates + origin = molecule coordinates
  std::string command;             ///< for a POSIX shell: renders the picture from any folder
};

}  // namespace meniscus::povray
