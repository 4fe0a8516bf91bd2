// SPDX-License-Identifier: BSD-3-Clause
// Finds what panels share, places them on their page, and draws one row of panels after another.
#include "core/scene/panel_page.h"

#include <iterator>

#include "core/render/vector_page.h"

namespace meniscus {
namespace {

/// Returns "A" to "Z", then "AA" and so on; nothing for PanelLetters::none.
std::string letter_of(std::size_t panel, PanelLetters letters) {
  if (letters == PanelLetters::none) return {};
  const char first = letters == PanelLetters::upper ? 'A' : 'a';
  std::string text;
  for (std::size_t rest = panel + 1; rest > 0; rest = (rest - 1) / 26)
    text.insert(text.begin(), static_cast<char>(first + (rest - 1) % 26));
  return text;
}

/// Returns a key that explains the colours of both; nothing if a colour has different meanings in them.
std::optional<ColorKey> joined(ColorKey key, const ColorKey& more) {
  if (key.title != more.title || !is_same_scale(key.scale, more.scale)) return {};
  if (key.scale) key.scale->missing = std::max(key.scale->missing, more.scale->missing);
  for (const ColorClass& added : more.classes) {
    const auto same_name = std::ranges::find(key.classes, added.name, &ColorClass::name);
    const auto same_color = std::ranges::find(key.classes, added.color, &ColorClass::color);
    if (same_name != same_color) return {};
    if (same_name == key.classes.end()) key.classes.push_back(added);
  }
  for (const ColorKey& other : more.others) {
    const auto same = std::ranges::find(key.others, other.heading(), &ColorKey::heading);
    if (same == key.others.end()) {
      key.others.push_back(other);
      continue;
    }
    const std::optional<ColorKey> both = joined(*same, other);
    if (!both) return {};
    *same = *both;
  }
  return key;
}

void copy_into(Framebuffer& row, const Framebuffer& panel, int left) {
  for (int y = 0; y < panel.size.y; ++y)
    std::copy_n(panel.color.begin() + static_cast<std::ptrdiff_t>(y) * panel.size.x, panel.size.x,
                row.color.begin() + static_cast<std::ptrdiff_t>(y) * row.size.x + left);
}

Framebuffer empty_rows(int width, int count) {
  Framebuffer rows;
  rows.size = {width, count};
  rows.color.assign(static_cast<std::size_t>(width) * count, glm::vec4(0.0f));
  return rows;
}

/// Adds shapes that are moved by some pixels, with the prefix before the names of their groups.
void append_moved(std::vector<PageShape>& shapes, std::vector<PageShape> more, glm::ivec2 by,
                  const std::string& prefix) {
  for (PageShape& shape : more) {
    shape.from += glm::dvec2(by);
    shape.to += glm::dvec2(by);
    if (shape.text) shape.text->start += glm::dvec2(by);
    shape.group.insert(0, prefix);
    shapes.push_back(std::move(shape));
  }
}

}  // namespace

void share_range(std::span<Scene> scenes, std::span<const Structure> structures) {
  std::optional<ColorScale> first;
  std::array<double, 2> range{};
  for (std::size_t n = 0; n < scenes.size(); ++n) {
    const ColorScheme color = color_of(scenes[n].molecule);
    if (!color.has_scale())
      throw RequestError(
          message("@one-scale@: panel {} is not coloured by a number; leave it out, or choose another @color@", n + 1));
    const ColorScale scale = color_scale(structures[n], color);
    if (first && scale.title != first->title)
      throw RequestError(
          message("@one-scale@: panel 1 is coloured by {}, panel {} by {}", first->title, n + 1, scale.title));
    range = first ? std::array{std::min(range[0], scale.range[0]), std::max(range[1], scale.range[1])} : scale.range;
    if (!first) first = scale;
  }
  for (Scene& scene : scenes) scene.molecule.color.range = range;
}

// The layout of a page.

PanelPage::PanelPage(std::vector<Panel> panels, const PanelArrangement& arrangement) {
  const glm::ivec2 shape = panels.front().scene.picture.size();
  for (std::size_t n = 0; n < panels.size(); ++n) {
    Scene& scene = panels[n].scene;
    if (scene.annotations.panel.empty()) scene.annotations.panel = letter_of(n, arrangement.letters);
  }
  std::vector<ColorKey> keys;
  for (const Panel& panel : panels)
    keys.push_back(key_of(panel.figure.molecule, panel.scene.figure, panel.figure.extras));
  conflicts_ = color_conflicts(keys, "panel");
  arrange(arrangement, shape, panels.size());
  const int count = static_cast<int>(panels.size()), rows = (count + columns_ - 1) / columns_;
  const auto panel_in = [&](glm::ivec2 area) {
    return (area - gap_ * glm::ivec2(columns_ - 1, rows - 1)) / glm::ivec2(columns_, rows);
  };
  find_legend(panels, keys, panel_in(size_));
  panel_size_ = panel_in(legend_ ? legend_->molecule_size() : size_);
  constexpr int kLeast = 16;
  if (panel_size_.x < kLeast || panel_size_.y < kLeast)
    throw RequestError(message("{} panels in {} x {} pixels have {} x {} each; make the page larger, or @gap@ smaller",
                               count, size_.x, size_.y, panel_size_.x, panel_size_.y));
  for (int n = 0; n < count; ++n) {
    Scene& scene = panels[n].scene;
    scene.picture.width = panel_size_.x;
    scene.picture.height = panel_size_.y;
    PictureLayout layout(scene, keys[n]);
    const glm::ivec2 place = glm::ivec2(n % columns_, n / columns_) * (panel_size_ + gap_);
    panels_.push_back({std::move(panels[n]), std::move(layout), place, {}});
  }
  aim(arrangement.one_camera);
}

void PanelPage::arrange(const PanelArrangement& arrangement, glm::ivec2 shape, std::size_t count) {
  constexpr std::size_t kOneRow = 3;
  gap_ = arrangement.gap;
  columns_ = arrangement.columns > 0 ? arrangement.columns
             : count <= kOneRow      ? static_cast<int>(count)
                                     : static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
  columns_ = std::min(columns_, static_cast<int>(count));
  const int rows = (static_cast<int>(count) + columns_ - 1) / columns_;
  const glm::ivec2 counts(columns_, rows), gaps = gap_ * (counts - 1);
  const glm::ivec2 given(arrangement.width.value_or(0), arrangement.height.value_or(0));
  glm::dvec2 panel(shape);
  if (given.x > 0) panel *= static_cast<double>(given.x - gaps.x) / columns_ / shape.x;
  if (given.x == 0 && given.y > 0) panel *= static_cast<double>(given.y - gaps.y) / rows / shape.y;
  size_ = glm::ivec2(glm::round(panel * glm::dvec2(counts))) + gaps;
  if (given.x > 0) size_.x = given.x;
  if (given.y > 0) size_.y = given.y;
}

/// Makes the legend of the page if the keys of all panels agree: it is next to all panels, so it must be true of each.
void PanelPage::find_legend(std::vector<Panel>& panels, std::span<const ColorKey> keys, glm::ivec2 panel_size) {
  std::optional<ColorKey> all;
  for (const ColorKey& key : keys) {
    if (key.empty()) continue;
    all = all ? joined(*all, key) : key;
    if (!all) return;
  }
  const auto first = std::ranges::find_if(panels, [](const Panel& panel) { return panel.scene.legend.within; });
  if (first == panels.end() || !all) return;
  LegendStyle style = legend_style(first->scene.legend.style, first->scene.annotations.letters);
  // Its letters are as high as in a panel's own legend.
  constexpr int kShare = 30, kLeast = 9;
  if (!style.letters) style.letters = std::max(kLeast, std::min(panel_size.x, panel_size.y) / kShare);
  legend_.emplace(*all, size_, style);
  for (Panel& panel : panels) panel.scene.legend.within = false;
}

void PanelPage::aim(bool one_camera) {
  std::vector<Ball> shown, framed;
  for (Placed& placed : panels_) {
    const Panel& panel = placed.panel;
    const ViewedAtoms seen = panel.aim.viewed(panel.figure);
    placed.camera = view_camera(placed.layout.size, panel.given, panel.aim.viewed_balls(seen.shown, seen.framed));
    shown.insert(shown.end(), seen.shown.begin(), seen.shown.end());
    framed.insert(framed.end(), seen.framed.begin(), seen.framed.end());
  }
  if (!one_camera) return;
  const Placed& first = panels_.front();
  const Camera camera = view_camera(first.layout.size, first.panel.given, first.panel.aim.viewed_balls(shown, framed));
  for (Placed& placed : panels_) placed.camera = camera;
}

// The pixels and paths of a page.

/// Writes rows of panels to a picture or to a page. Groups of a page are named after their panel, "panel-1-labels".
class PanelPage::Output {
 public:
  Output(const std::filesystem::path& path, const PanelPage& page, const ImageSettings& image)
      : page_(page), image_(image), area_(page.legend_ ? page.legend_->molecule_size() : page.size_) {
    check_image_path(path);
    if (is_page(path))
      paths_ = std::make_unique<PageFile>(path, PageLayout{{}, page.size_, {0, 0}, area_}, image);
    else
      pixels_ = std::make_unique<ImageWriter>(path, page.size_, false, image);
  }

  int width() const { return area_.x; }

  /// Returns the picture of a panel's molecule with its annotations; for a page, adds them as shapes instead.
  Framebuffer finish(const Placed& placed, const Annotations& annotations, Framebuffer molecule) {
    const PictureLayout& layout = placed.layout;
    if (!paths_) return finished_picture(std::move(molecule), annotations, layout, placed.camera, image_.background);
    const Strips& strips = layout.strips;
    const glm::ivec2 with_strips = layout.size.size() + glm::ivec2(0, strips.top + strips.bottom);
    const AnnotationLayer written(annotations, placed.camera, with_strips, image_.background, strips);
    const std::string prefix = fmt::format("panel-{}-", ++panels_);
    append_moved(shapes_, shapes_of(written, strips.top, with_strips.y - strips.bottom), placed.place, prefix);
    if (layout.legend) append_moved(shapes_, shapes_of(*layout.legend, image_.background), placed.place, prefix);
    return with_margin(molecule, page_.panel_size_, strips.top, false);
  }

  void add(Framebuffer rows) {
    const int count = rows.size.y;
    if (count == 0) return;
    if (paths_) {
      paths_->add(rows);
    } else {
      if (page_.legend_) rows = page_.legend_->rows(rows, row_, count, false, image_.background);
      pixels_->add(rows);
    }
    row_ += count;
  }

  void commit() {
    add(empty_rows(area_.x, area_.y - row_));
    if (paths_) {
      if (page_.legend_) append_moved(shapes_, shapes_of(*page_.legend_, image_.background), {}, "");
      return paths_->commit(shapes_);
    }
    if (row_ < page_.size_.y) {  // the legend is below the panels
      Framebuffer nothing;
      nothing.size = {area_.x, 0};
      pixels_->add(page_.legend_->rows(nothing, row_, page_.size_.y - row_, false, image_.background));
    }
    pixels_->commit();
  }

 private:
  const PanelPage& page_;
  const ImageSettings& image_;
  const glm::ivec2 area_;                // size without the legend
  std::unique_ptr<ImageWriter> pixels_;  // set unless paths_ is
  std::unique_ptr<PageFile> paths_;
  std::vector<PageShape> shapes_;
  int row_ = 0, panels_ = 0;  // written so far
};

void PanelPage::write(const std::filesystem::path& path, StillRenderer& renderer, const ImageSettings& image,
                      const std::function<void()>& done) {
  Output output(path, *this, image);
  for (std::size_t first = 0; first < panels_.size(); first += columns_) {
    if (first > 0) output.add(empty_rows(output.width(), gap_));
    Framebuffer row = empty_rows(output.width(), panel_size_.y);
    for (std::size_t n = first; n < std::min(first + columns_, panels_.size()); ++n) {
      Placed& placed = panels_[n];
      const Scene& scene = placed.panel.scene;
      Figure& figure = placed.panel.figure;
      Annotations annotations = annotations_of(scene.annotations, figure.molecule.structure, figure.extras.lengths());
      const RenderSettings settings = render_settings(scene, placed.layout);
      const Survey survey = survey_of(scene, figure.molecule.structure, placed.camera, settings.size, annotations);
      Framebuffer molecule = draw(renderer, std::move(figure), scene.figure, placed.camera, settings, survey);
      copy_into(row, output.finish(placed, annotations, std::move(molecule)), placed.place.x);
      if (done) done();
    }
    output.add(std::move(row));
  }
  output.commit();
}

}  // namespace meniscus
