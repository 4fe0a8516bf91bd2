// SPDX-License-Identifier: BSD-3-Clause
// The views of a page with names that readers choose (--named-view).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/commands/command_run.h"
#include "app/options/scene_options.h"
#include "core/camera/camera.h"
#include "core/scene/figure.h"
#include "exporters/page/page_file.h"

namespace meniscus {

/// The views of --named-view NAME=FILE. FILE is a camera, as for --camera, or a scene, which provides its camera, its
/// cuts and the opacity of all atoms.
class NamedViews {
 public:
  /// Reads the files and protects them from being replaced by outputs. trusts_scenes: scenes may name any files. Throws
  /// UsageError, and the errors of reading.
  NamedViews(const std::vector<std::string>& texts, const SceneCommand& page, bool trusts_scenes);

  /// Finds the cameras. Throws like FigureRun::camera_for(), with the name of the view.
  void aim(FigureRun& run);
  /// Returns the views of a figure with its objects; call aim() first. Throws like cut_atoms(), with the name of the
  /// view.
  std::vector<page::PageView> of(const Scene& page, const Figure& figure) const;

 private:
  struct View {
    std::string name;
    Scene scene;                   ///< with the size of the page
    std::optional<Camera> camera;  ///< from a file, until the view is aimed
  };
  std::vector<View> views_;
};

}  // namespace meniscus
