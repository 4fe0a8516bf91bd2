// SPDX-License-Identifier: BSD-3-Clause
// From a scene to the settings and the layout of its picture, and the atoms that it hides.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/color/color_key.h"
#include "core/render/annotation.h"
#include "core/render/legend.h"
#include "core/render/picture.h"
#include "core/scene/figure.h"
#include "core/scene/run_framing.h"
#include "core/scene/scene.h"
#include "core/scene/view_aim.h"

namespace meniscus {

/// The survey of a picture of the structure by this camera: marks labels of whose atoms no pixel shows any
/// (PlaceLabel::is_hidden). Copies count as one, and where something is seen through nothing is said. size: of the
/// molecule's picture. sentences: get one for each label, rule and patch of which nothing is seen, with the turn that
/// shows it; nullptr: none is made. All but the size must stay until the picture is drawn.
Survey survey_of(const Scene& scene, const Structure& structure, const Camera& camera, glm::ivec2 size,
                 Annotations& annotations, std::vector<std::string>* sentences = nullptr);

/// The picture's size, from which the molecule has what the legend and the strips above and below leave.
struct PictureLayout {
  ViewRequest size;
  Strips strips;
  std::optional<Legend> legend;
  std::optional<Legend> legend_apart;  ///< of LegendRequest::file

  PictureLayout(const Scene& scene, const ColorKey& key);
};

/// What is kept above and below the molecule in a picture of this size, its legend aside.
Strips scene_strips(const Scene& scene, glm::ivec2 size);

/// On what pictures are made.
SurfaceRequest picture_request(const Scene& scene);

/// How the part of the picture is drawn that the molecule has.
RenderSettings render_settings(const Scene& scene, const PictureLayout& layout);

/// Before anything is read. Throws RequestError for a legend that has nothing to explain, and for a picture that shows
/// nothing.
void check_picture(const Scene& scene);

/// A whole picture of the molecule with what is written into it, and its legend. lacks_labels: where to
/// tell that labels have no room which need not fit. Throws as annotate() does.
Framebuffer finished_picture(Framebuffer molecule, const Annotations& annotations, const PictureLayout& layout,
                             const Camera& camera, const std::optional<glm::vec3>& background,
                             bool* lacks_labels = nullptr);

/// What a scene of one molecule comes to before anything is drawn.
struct SceneFigure {
  Scene scene;  ///< its selections settled
  GivenCameras given;
  ViewAim aim;
  Figure figure;
};

/// Reads and computes. scene: complete(). context: in which surfaces are computed; nullptr: on the CPU. Throws
/// RequestError for a run of frames and for a picture of a part of the surface, else what reading and computing throw.
SceneFigure made_figure(const Scene& scene, const EglContext* context);

/// The picture of a scene, as `meniscus render` makes it of one molecule: read, computed, seen and drawn. scene:
/// complete(). context: of the renderer, in which surfaces are computed, too; nullptr: on the CPU. Throws as
/// made_figure(), check_picture() and drawing do.
Framebuffer scene_picture(const Scene& scene, StillRenderer& renderer, const EglContext* context);

}  // namespace meniscus
