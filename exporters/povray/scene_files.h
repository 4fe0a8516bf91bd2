// SPDX-License-Identifier: BSD-3-Clause
// The text of a scene's files but for the geometry: for one surface, or for a run of frames.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/camera/camera.h"
#include "core/color/color_maps.h"
#include "core/math/box.h"
#include "exporters/povray/palette.h"
#include "exporters/povray/scene_options.h"

namespace meniscus::povray {

/// What a frame has of its own, beside its camera.
struct FrameLook {
  glm::vec3 background{1.0f};  ///< these three as in SceneOptions
  float shadows = 0.0f;
  float shadow_softness = 0.0f;
};

/// What a scene of several frames knows of them.
struct SceneFrames {
  std::vector<std::uint64_t> numbers;  ///< of the trajectory, in the order of the scene
  std::uint32_t palette = 0;           ///< tells colours and origin from those of other runs
  std::span<const FrameLook> looks;    ///< one a frame; none: all are as the options say
};

/// What the main file has to know of the file of one more object.
struct ObjectPart {
  bool is_surface = false;  ///< patches, which share an interior, else shapes
  bool single = false;      ///< of a surface: it is one item
};

/// What the main file has to know of the others.
struct SceneParts {
  bool surface = true;       ///< there is geometry of the surface
  bool single = false;       ///< the geometry is one item
  bool caps = false;         ///< there is a file of them, or one a frame
  bool shapes = false;       ///< likewise
  bool translucent = false;  ///< some colour is
  std::vector<ObjectPart> objects = {};
};

/// What the style is made of.
struct SceneStyle {
  const std::vector<SceneColor>* colors = nullptr;  ///< nothing: each frame has a file of its own
  const VolumePaint* map = nullptr;                 ///< of the colours that are by one
  std::vector<MaterialRequest> materials = {};      ///< of objects: SceneColor::finish n is the n-th, from 1
};

/// <name>.pov. cameras: one, or one a frame. frames: nothing for a single surface.
std::string main_text(std::span<const Camera> cameras, const SceneOptions& options, const glm::dvec3& origin,
                      const SceneParts& parts, const SceneFrames* frames = nullptr);
/// <name>_style.inc. origin: Å, of the scene's coordinates.
std::string style_text(const SceneStyle& style, const SceneOptions& options, const glm::dvec3& origin);
/// Of <name>_style.inc, or <name>_colors_#####.inc: lists with an entry for each colour.
std::string colors_text(const std::vector<SceneColor>& colors, const std::optional<ColorKey>& meaning);
/// <name>_aov.inc. colors: as of the style.
std::string buffer_text(const std::vector<SceneColor>* colors, const SceneOptions& options, const Box& e,
                        const glm::dvec3& origin);
/// <name>.ini. frames: of the run; none for a single surface.
std::string ini_text(const SceneOptions& options, std::span<const std::uint64_t> frames = {});
/// What renders all frames, as a line of a POSIX shell in the folder of the scene.
std::string render_command(const SceneOptions& options, std::span<const std::uint64_t> frames);

}  // namespace meniscus::povray
