// SPDX-License-Identifier: BSD-3-Clause
// The text of all files of a POV-Ray scene except the geometry: main file, style, buffers, .ini, and the include for a
// user's own scene.
#pragma once

#include "core/camera/camera.h"
#include "core/color/color_maps.h"
#include "core/math/box.h"
#include "exporters/povray/povray_options.h"
#include "exporters/povray/scene_text.h"

namespace meniscus::povray {

/// The look of one frame, in addition to its camera.
struct FrameLook {
  glm::vec3 background{1.0f};    ///< SceneOptions::background
  float shadows = 0.0f;          ///< SceneOptions::shadows
  float shadow_softness = 0.0f;  ///< SceneOptions::shadow_softness
};

/// The frames of a scene.
struct SceneFrames {
  std::vector<std::uint64_t> numbers;  ///< frame numbers of the trajectory, in the order of the scene
  std::uint32_t palette = 0;           ///< checksum that distinguishes colours and origin from those of other runs
  std::span<const FrameLook> looks;    ///< one per frame; empty if all frames have the look of the options
};

/// The properties of the file of one further object that the main file needs.
struct ObjectPart {
  bool is_surface = false;  ///< true for patches, which share an interior; false for shapes
  bool single = false;      ///< true if the geometry of a surface is one item
};

/// The properties of the other files that the main file needs.
struct SceneParts {
  bool surface = true;       ///< true if there is geometry of the surface
  bool single = false;       ///< true if that geometry is one item
  bool caps = false;         ///< true if there is a file of caps, or one per frame
  bool shapes = false;       ///< true if there is a file of shapes, or one per frame
  bool translucent = false;  ///< true if the opacity of some colour is less than 1
  std::vector<ObjectPart> objects = {};
};

/// The content of the style file.
struct SceneStyle {
  const std::vector<SceneColor>* colors = nullptr;  ///< nullptr: each frame has a file with colours of its own
  const VolumePaint* map = nullptr;                 ///< the map of colours with SceneColor::by_map, or nullptr
  std::vector<MaterialRequest> materials = {};      ///< of objects: SceneColor::finish n is the n-th, from 1
};

/// Returns the text of <name>.pov. cameras: one, or one per frame. frames: nullptr for a single surface.
std::string main_text(std::span<const Camera> cameras, const SceneOptions& options, const glm::dvec3& origin,
                      const SceneParts& parts, const SceneFrames* frames = nullptr);
/// Returns the text of <name>_style.inc. origin: the origin of the scene's coordinates, in Å.
std::string style_text(const SceneStyle& style, const SceneOptions& options, const glm::dvec3& origin);
/// Returns lists with an entry for each colour, for <name>_style.inc or <name>_colors_#####.inc. meaning: the key whose
/// names become comments.
std::string colors_text(const std::vector<SceneColor>& colors, const std::optional<ColorKey>& meaning);
/// Returns the text of <name>_aov.inc. colors: SceneStyle::colors. e: the box of everything shown, in Å.
std::string buffer_text(const std::vector<SceneColor>* colors, const SceneOptions& options, const Box& e,
                        const glm::dvec3& origin);
/// Returns the text of <name>.ini. frames: the frame numbers of the run; empty for a single surface.
std::string ini_text(const SceneOptions& options, std::span<const std::uint64_t> frames = {});
/// Returns the command that renders all frames, for a POSIX shell in the folder of the scene.
std::string render_command(const SceneOptions& options, std::span<const std::uint64_t> frames);

/// Returns the text of <name>.inc, which includes <name>.pov. It declares Meniscus_Surface, Meniscus_Shapes,
/// Meniscus_Object_1, ... as far as the scene has them, and places nothing. Names that were declared before it stay as
/// they were; all other names are undefined at its end. texts: the text of <name>.pov and of the files it includes,
/// except the templates for caps, shapes and maps and the lists of colours, which are always searched for names. maps:
/// true if each frame of a run may have a volume map.
std::string own_scene_text(std::string_view name, std::span<const std::string_view> texts, bool maps = false);

}  // namespace meniscus::povray
