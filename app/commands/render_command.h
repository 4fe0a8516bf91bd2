// SPDX-License-Identifier: BSD-3-Clause
// The options of `meniscus render` in addition to its scene, and common parts of its pictures.
#pragma once

#include "app/options/scene_options.h"
#include "core/render/image_output.h"
#include "core/scene/scene_picture.h"

namespace meniscus {

struct RenderCommand : SceneCommand {
  bool provenance = false;    ///< true if the picture contains the command line
  bool names_program = true;  ///< true if the picture contains the program's version, and a single picture its scene
  bool keeps_scene = false;   ///< true if the picture contains the scene
  bool stats = false;
  bool is_draft = false;
  bool resumes = false;  ///< true if existing pictures of a run stay
  std::string made_of;   ///< made_of() for a run that resumes
};

/// Returns render_settings(), with times of stages if they are printed.
RenderSettings picture_settings(const RenderCommand& command, const PictureLayout& layout);

/// Returns the settings for writing pictures.
ImageSettings image_settings(const RenderCommand& command);

/// Makes pictures of only the part that the view needs (--extent): of a molecule, or of the frames of a run.
void render_views(const RenderCommand& command);

}  // namespace meniscus
