// SPDX-License-Identifier: BSD-3-Clause
// Several figures side by side as one picture: panels of one size, lettered, with one legend where they share it.
#pragma once

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
  int columns = 0;  ///< 0: one row for up to three panels, and about as many columns as rows for more
  int gap = 0;      ///< pixels between neighbouring panels
  /// Pixels of the page. If one is missing, panels keep the shape of the first scene's picture; if both are, its size.
  std::optional<int> width, height;
  PanelLetters letters = PanelLetters::upper;  ///< letters of panels whose scenes set none
  bool one_camera =
      false;  ///< true: all have the first panel's camera: its Panel::given, or one that frames the contents of all
};

/// A figure that is ready to be drawn.
struct Panel {
  Scene scene;  ///< a completed scene (complete() in scene_values.h) with one molecule
  Figure figure;
  ViewAim aim;                  ///< chooses the atoms that the camera frames
  std::optional<Camera> given;  ///< replaces the camera that `aim` frames
};

/// Gives the colours of all scenes one range, from the least number in any scene to the greatest. `structures` has one
/// structure per scene, with the numbers of its atoms. Throws RequestError if the colours of a scene have no scale, or
/// if two scenes colour by different kinds of numbers. Throws InputError if the numbers of a scene cannot be found: a
/// file may lack them, or they may be known only after its surface is computed.
void share_range(std::span<Scene> scenes, std::span<const Structure> structures);

/// The page of several panels: their layout, cameras and common legend.
class PanelPage {
 public:
  /// `panels` must not be empty. Throws RequestError if the panels do not fit on the page, if the legend does not fit,
  /// if it renames an entry that does not exist, or if there is no font.
  PanelPage(std::vector<Panel> panels, const PanelArrangement& arrangement);

  glm::ivec2 size() const { return size_; }
  /// Returns the one legend for all panels. Returns nothing if no panel has a legend, or if the panels give one colour
  /// different meanings; then each panel that has a legend draws its own.
  const std::optional<Legend>& legend() const { return legend_; }
  /// Returns a sentence about colours with different meanings in different panels (color_conflicts); empty without such
  /// conflicts.
  const std::string& conflicts() const { return conflicts_; }
  const Camera& camera(std::size_t panel) const { return panels_[panel].camera; }

  /// Draws panel after panel, and writes the page, one row of panels after another. Must be called only once, because
  /// it uses up the figures. The background of `image` is used for all panels. `done` is called after each panel.
  /// Throws OutputError if the file cannot be written, and RequestError if a title or label does not fit.
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
