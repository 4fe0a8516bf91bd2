// SPDX-License-Identifier: BSD-3-Clause
// From a scene and its figure to the page that shows them.
#pragma once

#include "core/camera/camera.h"
#include "core/color/coloring.h"
#include "core/render/look.h"
#include "core/render/picture.h"
#include "core/scene/figure.h"
#include "core/scene/scene.h"
#include "core/structure/structure.h"
#include "core/surface/primitives.h"
#include "exporters/page/page_file.h"

namespace meniscus::page {

/// Makes a file of a picture for readers whose browser cannot draw the figure.
using EncodeStill = std::function<StillPicture(const Framebuffer& drawn, const Look& look)>;

/// As PNG: larger than JPEG, but made without a library for it.
StillPicture png_still(const Framebuffer& drawn, const Look& look);

/// Before anything is computed. Throws RequestError for what a page cannot show though the scene has it.
void check_scene(const Scene& scene);

/// Colours that readers can choose instead of the figure's, of the molecule or of all frames of a run.
struct OtherColors {
  std::string name;
  ColorScheme scheme;
  ColorKey key;
};

/// Those schemes that need nothing but the file. structure: with all atoms that any frame may have. measure: takes from
/// all frames what the colours of a scheme mean in each; nothing: there is one frame.
std::vector<OtherColors> other_colors(const Structure& structure, const ColorScheme& requested,
                                      const std::function<void(ColorScheme&)>& measure = {});

/// What a page has of a scene at one frame, beside the figure.
struct SceneFrame {
  Camera camera;
  std::vector<PageView> views;
  ColorKey key;
  std::vector<OtherColors> others;
  std::string moment;  ///< as in PageFigure, like the next
  std::optional<glm::dvec3> origin{};
  std::vector<std::pair<std::string, std::string>> facts{};  ///< of the run, behind those of the figure
};

/// A figure as a page has it. scene: what the figure was made of, its selections settled. encode: nothing: no still
/// picture. Throws as pack_frame() and picture_objects() do.
PackedFrame scene_frame(const Scene& scene, Figure figure, const SceneFrame& frame, const EncodeStill& encode);

/// The same of a figure whose surface is apart from it, where it stands, one copy.
PackedFrame scene_frame(const Scene& scene, const Figure& figure, const SurfaceObject& surface, const SceneFrame& frame,
                        const EncodeStill& encode, Packing packing);

/// The page of a scene, as `meniscus export page` makes it but for its still picture, a PNG. scene: complete(). On the
/// CPU. Throws RequestError as check_scene() does and for a run of frames, else what reading and computing throw.
std::string scene_page(const Scene& scene);

/// The page of a surface that no scene made, with the look of one. colors: a colour an atom. structure: names the atoms
/// that readers pick, in the same order, and has other colours for them; nullptr: they are counted.
std::string surface_page(const Surface& surface, const Coloring& colors, const Structure* structure, const Scene& look,
                         const Camera& camera, const EncodeStill& encode);

}  // namespace meniscus::page
