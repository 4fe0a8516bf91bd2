// SPDX-License-Identifier: BSD-3-Clause
// A folder with a POV-Ray 3.7 scene of surfaces: the analytic patches themselves, never triangles.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/color/color_scale.h"
#include "core/base/output_file.h"
#include "core/camera/camera.h"
#include "core/queries/surface_object.h"

namespace meniscus::povray {

enum class Material {
  opaque,
  ghost,  ///< see-through; only the sides that face the viewer are drawn
  glass,  ///< refracts as one solid
  wax     ///< light scatters below the surface
};

struct SceneOptions {
  std::string name = "surface";    ///< of all files; letters, digits, '-' and '_' only, since it stands in the scene
  int width = 1280, height = 960;  ///< pixels
  Material material = Material::opaque;  ///< the scene's default; every scene holds all four
  glm::vec3 background{1.0f};            ///< sRGB
  Existing existing = Existing::refuse;
  std::optional<glm::dvec3> origin;  ///< Å: where coordinates of the scene begin; nothing: the middle of all atoms
  std::optional<ColorKey> colors;    ///< what the colours mean, for <name>_objects.json
};

/// What was written and what was not.
struct SceneReport {
  std::vector<std::filesystem::path> files;
  std::size_t object_count = 0;    ///< primitives, copies not counted; atoms of several colours may share a patch
  std::vector<std::string> notes;  ///< sentences: what was left out, what will be slow; empty when all is shown
  glm::dvec3 origin{0.0};          ///< scene coordinates + origin = molecule coordinates
  std::string command;             ///< for a POSIX shell: renders the picture from any folder
};

/// Writes <name>.ini, <name>.pov, <name>_style.inc, <name>_aov.inc, <name>_geometry.inc and <name>_objects.json into
/// `folder`, all or none. One unit is 1 Å; coordinates are relative to options.origin. The camera shows the
/// same pixels as the ray caster's. Each object with its copies is a union object_1, object_2, ...; the names they came
/// with stand in the .json only. Points of hidden atoms are left out.
/// Throws OutputError (exists, not writable), Error (nothing is shown, bad name or size, a number that is not finite).
SceneReport write_scene(std::span<const SurfaceObject> objects, const Camera& camera, const SceneOptions& options,
                        const std::filesystem::path& folder);

}  // namespace meniscus::povray
