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

/// How panels stand on their page, and whether they share a camera.
struct PanelArrangement {
  int columns = 0;                   ///< 0: one row of up to three panels, else about as many columns as rows
  int gap = 0;                       ///< between panels, pixels
  std::optional<int> width, height;  ///< of the page, pixels; nothing: by the size and the shape of the first panel
  PanelLetters letters = PanelLetters::upper;  ///< of panels whose scenes have none
  bool one_camera = false;                     ///< that of the first panel, which shows what is in any
};

/// A figure, ready to be drawn.
struct Panel {
  Scene scene;  ///< complete; of one molecule
  Figure figure;
  ViewAim aim;
  std::optional<Camera> given;  ///< instead of one that shows everything
};

/// Gives the colours of all scenes one range, from the least number of any to the greatest. structures: one each.
/// Throws RequestError for a scene whose colours have no scale, or that of other numbers; InputError for numbers that
/// come with the surface.
void share_range(std::span<Scene> scenes, std::span<const Structure> structures);

class PanelPage {
 public:
  /// At least one panel. Throws RequestError when they have no room, and what Legend throws.
  PanelPage(std::vector<Panel> panels, const PanelArrangement& arrangement);

  glm::ivec2 size() const { return size_; }
  /// That of all panels; nothing: none asks for one, or colours differ, so that those that ask draw their own.
  const std::optional<Legend>& legend() const { return legend_; }
  /// Where panels disagree in what a colour means (color_conflicts).
  const std::string& conflicts() const { return conflicts_; }
  const Camera& camera(std::size_t panel) const { return panels_[panel].camera; }

  /// Draws panel after panel, and writes the page, one row of them after another. image: its background is behind all
  /// panels. done: called after each. Throws as ImageWriter and annotate() do. Once.
  void write(const std::filesystem::path& path, StillRenderer& renderer, const ImageSettings& image,
             const std::function<void()>& done = {});

 private:
  struct Placed {
    Panel panel;
    PictureLayout layout;
    glm::ivec2 place;  ///< of its first pixel
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
