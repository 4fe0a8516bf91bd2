// SPDX-License-Identifier: BSD-3-Clause
// The options of `meniscus render` in addition to its scene, common parts of its pictures, and scenes that commands
// read from files: with the options that their command line sets for all, and as drafts.
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

/// Returns the options of the command line that hold for each scene, too, as words of `meniscus render`. but: keys of
/// those that do not.
std::vector<std::string> shared_words(const SceneOptions& options, std::span<const std::string_view> but);

/// Reads the scene of a file or a picture, as `meniscus render --scene FILE words...` does. Options without effect are
/// not reported. Throws like SceneOptions::take(); UsageError for a scene that does not show surfaces.
SceneCommand read_scene_file(const std::string& path, std::vector<std::string> words, const Reporting& reporting);

/// Turns the scene into a draft (--draft): half its width and height, with letters and lines, one ray per pixel and no
/// traced shade. It takes a fraction of the time.
void make_draft(Scene& scene);

}  // namespace meniscus
