// SPDX-License-Identifier: BSD-3-Clause
// Makes the page of a scene and its figure.
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

/// Encodes a picture as PNG, which is larger than JPEG but needs no library.
StillPicture png_still(const Framebuffer& drawn, const Look& look);

/// Checks a scene before anything is computed. Throws RequestError for settings that pages cannot show.
void check_scene(const Scene& scene);

/// Colours that readers can choose instead of the figure's, of the molecule or of all frames of a run.
struct OtherColors {
  std::string name;
  ColorScheme scheme;
  ColorKey key;
};

/// Returns the schemes that need only the file. structure: all atoms that any frame may have. measure: finds the
/// meaning of a scheme's colours in all frames; nothing: there is one frame.
std::vector<OtherColors> other_colors(const Structure& structure, const ColorScheme& requested,
                                      const std::function<void(ColorScheme&)>& measure = {});

/// The data of a page at one frame, in addition to the figure.
struct SceneFrame {
  Camera camera;
  std::vector<PageView> views;
  ColorKey key;
  std::vector<OtherColors> others;
  std::string moment;  ///< see PageFigure
  std::optional<glm::dvec3> origin{};
  std::vector<std::pair<std::string, std::string>> facts{};  ///< facts of the run, which follow the figure's facts
};

/// Returns the frame of a page with a figure. scene: the scene of the figure, with resolved selections. encode:
/// nothing: no still picture. Throws the errors of pack_frame() and picture_objects().
PackedFrame scene_frame(const Scene& scene, Figure figure, const SceneFrame& frame, const EncodeStill& encode);

/// Returns the frame of a figure whose surface is passed separately, as one copy in its final place.
PackedFrame scene_frame(const Scene& scene, const Figure& figure, const SurfaceObject& surface, const SceneFrame& frame,
                        const EncodeStill& encode, Packing packing);

/// Returns the page of a scene like `meniscus export page`, but with a PNG as still picture. scene: complete().
/// Computes on the CPU. Throws RequestError like check_scene() and for a run, and the errors of reading and computing.
std::string scene_page(const Scene& scene);

/// Returns the page of a surface that was not made from a scene, with the look of one. colors: one per atom. structure:
/// the names and other colours of the same atoms, in the same order; nullptr: atoms have numbers.
std::string surface_page(const Surface& surface, const Coloring& colors, const Structure* structure, const Scene& look,
                         const Camera& camera, const EncodeStill& encode);

}  // namespace meniscus::page
