// SPDX-License-Identifier: BSD-3-Clause
// Several figures side by side as one picture: panels of one size, lettered, with one legend where they share it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "core/camera/camera.h"
#include "core/render/image_output.h"
#include "core/render/legend.h"
#include "core/scene/figure.h"
#include "core/scene/scene.h"
#include "core/scene/scene_picture.h"
#include "core/scene/view_aim.h"

namespace meniscus {

enum class PanelLetters { upper, lower, none };

/// The layout of panels on their page, and whether they share a camera.
struct PanelArrangement {
  int columns = 0;                   ///< 0: one row of up to three panels, else about as many columns as rows
  int gap = 0;                       ///< pixels between panels
  std::optional<int> width, height;  ///< pixels of the page; nothing: set by the size and shape of the first panel
  PanelLetters letters = PanelLetters::upper;  ///< letters of panels whose scenes set none
  bool one_camera = false;  ///< true: all have the first panel's camera, which then frames the contents of all
};

/// A figure, ready to be drawn.
struct Panel {
  Scene scene;  ///< made by complete(), with one molecule
  Figure figure;
  ViewAim aim;
  std::optional<Camera> given;  ///< replaces the camera that frames everything
};

/// Gives the colours of all scenes one range, from the least number in any scene to the greatest. structures: one per
/// scene. Throws RequestError for a scene whose colours have no scale, or a scale of another kind of number; InputError
/// for numbers that are known only with the surface.
void share_range(std::span<Scene> scenes, std::span<const Structure> structures);

class PanelPage {
 public:
  /// `panels` must not be empty. Throws RequestError if the panels do not fit on the page; otherwise like Legend.
  PanelPage(std::vector<Panel> panels, const PanelArrangement& arrangement);

  glm::ivec2 size() const { return size_; }
  /// Returns the legend of all panels. Returns nothing if no panel has a legend, or if colours differ: then each panel
  /// with a legend draws its own.
  const std::optional<Legend>& legend() const { return legend_; }
  /// Returns the conflicts between the meanings of colours in different panels (color_conflicts).
  const std::string& conflicts() const { return conflicts_; }
  const Camera& camera(std::size_t panel) const { return panels_[panel].camera; }

  /// Draws panel after panel, and writes the page, one row of panels after another. Must be called only once. image:
  /// its background is used for all panels. done: called after each panel. Throws like ImageWriter and annotate().
  void write(const std::filesystem::path& path, StillRenderer& renderer, const ImageSettings& image,
             const std::function<void()>& done = {});

 private:
  struct Placed {
    Panel panel;
    PictureLayout layout;
    glm::ivec2 place;  ///< place of its first pixel on the page
    Camera camera;
  };
  class Output;

  void arrange(const PanelArrangement& arrangement, glm::ivec2 shape, std::size_t count);
  void find_legend(std::vector<Panel>& panels, std::span<const ColorKey> keys, glm::ivec2 panel_size);
  void aim(bool one_camera);

  std::vector<Placed> panels_;
  std::optional<Legend> legend_;
  std::string conflicts_;
  int columns_ = 1, gap_ = 0;
  glm::ivec2 size_{0}, panel_size_{0};
};

}  // namespace meniscus
