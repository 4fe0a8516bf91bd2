// SPDX-License-Identifier: BSD-3-Clause
// Turns a scene into the settings and the layout of its picture, and finds atoms that the picture hides.
#pragma once

#include "core/color/color_key.h"
#include "core/render/annotation.h"
#include "core/render/legend.h"
#include "core/render/picture.h"
#include "core/scene/figure.h"
#include "core/scene/run_framing.h"
#include "core/scene/scene.h"
#include "core/scene/view_aim.h"

namespace meniscus {

/// Returns the survey of a picture of the structure by this camera. It marks labels whose atoms are visible in no pixel
/// (PlaceLabel::is_hidden), and lengths behind what the picture shows. Copies count as one. If something is
/// transparent, no sentences are made. size: of the molecule's picture. sentences: gets one for each label, rule and
/// patch without visible atoms, with the turn that shows it; nullptr: none are made. All arguments but the size must
/// outlive the drawing of the picture.
Survey survey_of(const Scene& scene, const Structure& structure, const Camera& camera, glm::ivec2 size,
                 Annotations& annotations, std::vector<std::string>* sentences = nullptr);

/// The layout of a picture: the molecule gets the part that the legend and the strips above and below leave.
struct PictureLayout {
  ViewRequest size;
  Strips strips;
  std::optional<Legend> legend;
  std::optional<Legend> legend_apart;  ///< the legend of LegendRequest::file

  PictureLayout(const Scene& scene, const ColorKey& key);
};

/// Returns the strips above and below the molecule in a picture of this size, without its legend.
Strips scene_strips(const Scene& scene, glm::ivec2 size);

/// Returns the margin of a picture that ends at its molecule (ViewRequest::fits), in pixels. It has room for labels.
glm::ivec2 fitted_margin(const Scene& scene, glm::ivec2 size);

/// Returns the request for the surfaces of a picture, with the device on which pictures are made.
SurfaceRequest picture_request(const Scene& scene);

/// Returns the settings for drawing the molecule's part of the picture.
RenderSettings render_settings(const Scene& scene, const PictureLayout& layout);

/// Checks a scene before any file is read. Throws RequestError for a legend that has nothing to explain, for a picture
/// that shows nothing, for a size that cannot follow from the molecule, and for a font that cannot be used.
void check_picture(const Scene& scene);

/// Returns a whole picture of the molecule with its annotations and its legend. lacks_labels: unless nullptr, set to
/// true if labels that need not fit have no room, else to false. Throws RequestError if a title or a label that must
/// fit does not.
Framebuffer finished_picture(Framebuffer molecule, const Annotations& annotations, const PictureLayout& layout,
                             const Camera& camera, const std::optional<glm::vec3>& background,
                             bool* lacks_labels = nullptr);

/// A scene of one molecule, read and computed, before it is drawn.
struct SceneFigure {
  Scene scene;  ///< changed by freeze_selections()
  GivenCameras given;
  ViewAim aim;
  Figure figure;
};

/// Reads and computes a scene. scene: made by complete(). context: computes surfaces on GL; nullptr: on the CPU. Throws
/// RequestError for a run of frames and for a picture of a part of the surface; otherwise like reading and computing.
SceneFigure made_figure(const Scene& scene, const EglContext* context);

/// Returns the picture of a scene, as `meniscus render` makes it of one molecule. scene: made by complete(). context:
/// of the renderer, which also computes surfaces; nullptr: on the CPU. Throws like made_figure(), check_picture() and
/// drawing.
Framebuffer scene_picture(const Scene& scene, StillRenderer& renderer, const EglContext* context);

}  // namespace meniscus
