// SPDX-License-Identifier: BSD-3-Clause
// What the options of `meniscus render` say, and its two ways: one picture, or a run of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/film/film_format.h"
#include "app/options/annotation_options.h"
#include "app/options/figure_command.h"
#include "app/options/picture_options.h"
#include "core/render/image_output.h"
#include "core/render/legend.h"
#include "core/render/look_presets.h"
#include "core/render/surface_renderer.h"
#include "core/visible_surface/extent.h"

namespace meniscus {

struct RenderCommand : FigureCommand {
  LookRequest look;
  int samples = 9;
  bool aovs = false;
  bool provenance = false;    ///< the command line is in the picture
  bool names_program = true;  ///< the program's version is, and of single pictures the scene
  std::string scene;          ///< scene_text() of the options, for pictures
  LegendRequest legend;
  AnnotationRequest annotations;
  std::optional<glm::vec3> background;
  std::optional<Extent> extent;  ///< nothing: the complete surface, computed and certified before the picture
  bool stats = false;
  double frames_per_second = 25.0;  ///< of a film
  FilmFormat film;
};

/// The picture's size, of which the molecule takes what the legend leaves.
struct PictureLayout {
  ViewRequest size;
  std::optional<Legend> legend;
  std::optional<Framebuffer> legend_alone;  ///< of --legend-file

  PictureLayout(const RenderCommand& command, const ColorKey& key);
};

/// On what pictures are made.
SurfaceRequest picture_request(const RenderCommand& command);
RenderSettings render_settings(const RenderCommand& command, const PictureLayout& layout);

/// How the pictures are written.
ImageSettings image_settings(const RenderCommand& command);

/// Of --extent.
DeviceChoice gl_device(const RenderCommand& command);

/// Pictures of all frames of a run, or a film of them.
void render_frames(const RenderCommand& command);

}  // namespace meniscus
