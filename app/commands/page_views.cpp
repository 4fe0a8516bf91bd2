// SPDX-License-Identifier: BSD-3-Clause
// Reads named views from cameras and scenes, and aims them at the contents of a page.
#include "app/commands/page_views.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "app/commands/shared_scenes.h"
#include "app/process/program_main.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/image/png_file.h"
#include "core/scene/cut.h"
#include "core/scene/scene_values.h"

namespace meniscus {
namespace {

/// True for a picture, or a text that is a scene.
bool is_scene(const std::string& file) {
  std::error_code unreadable;
  if (file.starts_with('{') || !std::filesystem::is_regular_file(path_of_text(file), unreadable)) return false;
  return is_png(file) || read_scene_text(file).find("\"meniscus_scene\"") != std::string::npos;
}

/// Returns the opacity of all atoms; 1 if some differ.
float opacity_of(const Scene& scene) {
  const std::vector<OpacityRule>& rules = scene.molecule.color.opacities;
  return rules.size() == 1 && !rules.front().atoms ? rules.front().opacity : 1.0f;
}

/// Adds the name of the view to errors.
template <typename Work>
void named(const std::string& name, const Work& work) {
  try {
    work();
  } catch (const RequestError& error) {
    throw RequestError(fmt::format("--named-view {}: {}", in_quotes(name), error.what()));
  }
}

}  // namespace

NamedViews::NamedViews(const std::vector<std::string>& texts, const SceneCommand& page, bool trusts_scenes) {
  const auto refuse = [](const std::string& text, const std::string& why) {
    throw UsageError(fmt::format("--named-view {}: {}", in_quotes(text), why));
  };
  for (const std::string& text : texts) {
    const std::size_t sign = std::min(text.find('='), text.size());
    const std::string file = text.substr(std::min(sign + 1, text.size()));
    View view{text.substr(0, sign), {}, {}};
    if (view.name.empty() || file.empty()) refuse(text, "write NAME=FILE, such as 'Active site=site.json'");
    if (std::ranges::any_of(views_, [&](const View& other) { return other.name == view.name; }))
      refuse(text, "there is a view of this name before it; choose another");
    if (is_scene(file)) {
      std::vector<std::string> words{page.scene.molecule.file};
      if (trusts_scenes) words.push_back("--trust-scene");
      view.scene = prepared_scene(read_scene_file(file, std::move(words), page.reporting).scene);
    } else {
      view.scene.picture.camera_file = file;
    }
    view.scene.picture.width = page.scene.picture.width;
    view.scene.picture.height = page.scene.picture.height;
    view.camera = given_camera(view.scene.picture);
    if (view.scene.figure.cuts.size() > page::kMostPlanes)
      refuse(text, fmt::format("pages show at most {} planes, and its scene has {}", page::kMostPlanes,
                               view.scene.figure.cuts.size()));
    views_.push_back(std::move(view));
  }
}

void NamedViews::aim(FigureRun& run) {
  for (View& view : views_) named(view.name, [&] { view.camera = run.camera_for(view.scene.picture, view.camera); });
}

std::vector<page::PageView> NamedViews::of(const Scene& page, const Figure& figure) const {
  std::vector<page::PageView> shown;
  for (const View& view : views_) {
    page::PageView& made = shown.emplace_back(page::PageView{view.name, view.camera.value()});
    if (page.figure.hides_surface) continue;
    const FigureRequest& requested = view.scene.figure;
    named(view.name, [&] {
      made.clip = surface_planes(requested, cut_atoms(requested.cuts, figure.molecule.structure), made.camera,
                                 figure.molecule.objects);
    });
    made.opacity = opacity_of(view.scene);
    made.looks_inside = uses_atoms(requested.cuts);
  }
  return shown;
}

}  // namespace meniscus
