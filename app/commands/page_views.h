// SPDX-License-Identifier: BSD-3-Clause
// Views that readers of a page choose by their names, as --named-view asks for them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/commands/figure_run.h"
#include "app/options/scene_options.h"
#include "core/camera/camera.h"
#include "core/scene/figure.h"
#include "exporters/page/page_file.h"

namespace meniscus {

/// The views that --named-view NAME=FILE asks for. FILE is a camera, as for --camera, or a scene, whose camera, cuts
/// and opacity of all atoms are taken.
class NamedViews {
 public:
  /// Reads the files, which no output replaces. trusts_scenes: they may name any files. Throws UsageError, and what
  /// reading them throws.
  NamedViews(const std::vector<std::string>& texts, const SceneCommand& page, bool trusts_scenes);

  /// Finds their cameras. Throws as FigureRun::camera_for(), the view named.
  void aim(FigureRun& run);
  /// As they show a figure, with its objects. Throws as cut_atoms() does, the view named. After aim().
  std::vector<page::PageView> of(const Scene& page, const Figure& figure) const;

 private:
  struct View {
    std::string name;
    Scene scene;                   ///< with the page's size
    std::optional<Camera> camera;  ///< by a file, until it is aimed
  };
  std::vector<View> views_;
};

}  // namespace meniscus
