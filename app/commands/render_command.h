// SPDX-License-Identifier: BSD-3-Clause
// What the options of `meniscus render` say beside its scene, and what its pictures have in common.
#pragma once

#include <optional>
#include <string>

#include "app/options/scene_options.h"
#include "core/color/color_key.h"
#include "core/render/picture.h"
#include "core/render/image_output.h"
#include "core/render/legend.h"

namespace meniscus {

struct RenderCommand : SceneCommand {
  bool provenance = false;    ///< the command line is in the picture
  bool names_program = true;  ///< the program's version is, and of single pictures the scene
  bool stats = false;
};

/// The picture's size, from which the molecule has what the legend leaves.
struct PictureLayout {
  ViewRequest size;
  std::optional<Legend> legend;
  std::optional<Framebuffer> legend_alone;  ///< of --legend-file

  PictureLayout(const Scene& scene, const ColorKey& key);
};

/// On what pictures are made.
SurfaceRequest picture_request(const Scene& scene);
RenderSettings render_settings(const RenderCommand& command, const PictureLayout& layout);

/// How the pictures are written.
ImageSettings image_settings(const RenderCommand& command);

/// Pictures of what the view needs alone (--extent): of a molecule, or of the frames of a run.
void render_views(const RenderCommand& command);

}  // namespace meniscus
