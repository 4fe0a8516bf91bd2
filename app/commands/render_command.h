// SPDX-License-Identifier: BSD-3-Clause
// The options of `meniscus render` besides its scene, and what its pictures have in common.
#pragma once

#include "app/options/scene_options.h"
#include "core/render/image_output.h"
#include "core/scene/scene_picture.h"

namespace meniscus {

struct RenderCommand : SceneCommand {
  bool provenance = false;    ///< the command line is in the picture
  bool names_program = true;  ///< the program's version is, and of single pictures the scene
  bool keeps_scene = false;   ///< the scene is
  bool stats = false;
  bool is_draft = false;
  bool resumes = false;  ///< pictures of a run that are there stay
  std::string made_of;   ///< made_of() of a run that resumes
};

/// As render_settings(), with times of stages where they are said.
RenderSettings picture_settings(const RenderCommand& command, const PictureLayout& layout);

/// How the pictures are written.
ImageSettings image_settings(const RenderCommand& command);

/// Pictures of what the view needs alone (--extent): of a molecule, or of the frames of a run.
void render_views(const RenderCommand& command);

}  // namespace meniscus
