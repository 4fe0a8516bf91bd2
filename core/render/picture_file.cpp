// SPDX-License-Identifier: BSD-3-Clause
// Writes a picture to its file in slices of rows, with its annotations and its legend.
#include "core/render/picture_file.h"

#include "core/camera/camera.h"

namespace meniscus {
namespace {

constexpr int kSlice = 128;  // rows that are finished together

template <typename Value>
std::vector<Value> part_of(const std::vector<Value>& values, std::size_t first, std::size_t count) {
  if (values.empty()) return {};
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

Framebuffer slice_of(const Framebuffer& band, int first_row, int rows) {
  const auto each = static_cast<std::size_t>(layers_of(band).rays);
  const std::size_t width = static_cast<std::size_t>(band.size.x), first = width * first_row, count = width * rows;
  return {.size = {band.size.x, rows},
          .color = part_of(band.color, first, count),
          .z = part_of(band.z, first, count),
          .normal = part_of(band.normal, first, count),
          .position = part_of(band.position, first, count),
          .atom = part_of(band.atom, first, count),
          .kind = part_of(band.kind, first, count),
          .component = part_of(band.component, first, count),
          .object = part_of(band.object, first, count),
          .motion = part_of(band.motion, first, count),
          .seen = part_of(band.seen, first * each, count * each)};
}

}  // namespace

PictureFile::PictureFile(const std::filesystem::path& path, const PictureMargins& margins, const Camera& camera,
                         const ImageSettings& image, RenderSettings& settings)
    : margins_(margins),
      background_(image.background),
      layers_(settings.layers()),
      molecule_size_(settings.size),
      size_(margins.legend ? margins.legend->picture_size()
                           : settings.size + glm::ivec2(0, margins.strips.top + margins.strips.bottom)),
      annotations_(margins.annotations, camera,
                   settings.size + glm::ivec2(0, margins.strips.top + margins.strips.bottom), image.background,
                   margins.strips) {
  check_image_path(path);
  if (is_page(path))
    page_ = std::make_unique<PageFile>(path, PageLayout{{}, size_, {0, margins.strips.top}, molecule_size_}, image);
  else
    writer_ = std::make_unique<ImageWriter>(path, size_, layers_, seen_by(camera, image));
  settings.take_band = [this](const Framebuffer& band, int first_row) { take(band, first_row); };
}

ImageSettings PictureFile::seen_by(const Camera& camera, ImageSettings image) const {
  const glm::dvec2 molecule(molecule_size_), whole(size_);
  glm::dmat4 into_file(1.0);
  into_file[0][0] = molecule.x / whole.x;
  into_file[1][1] = molecule.y / whole.y;
  into_file[3][1] = margins_.strips.top / whole.y;
  image.exr.view = ViewMatrices{world_to_camera(camera), into_file * world_to_picture(camera, molecule.x / molecule.y)};
  return image;
}

void PictureFile::take(const Framebuffer& band, int first_row) {
  shows_something_ =
      shows_something_ || std::ranges::any_of(band.color, [](const glm::vec4& pixel) { return pixel.w > 0.0f; });
  if (first_row == 0) annotations_.hollow(margins_.annotations.labels);
  if (page_) return page_->add(band);
  const int top = margins_.strips.top;
  if (first_row == 0) write_strip(0, top);
  for (int row = 0; row < band.size.y; row += kSlice)
    write_molecule(slice_of(band, row, std::min(kSlice, band.size.y - row)), top + first_row + row);
}

void PictureFile::write_strip(int first_row, int count) {
  for (int row = 0; row < count; row += kSlice) {
    Framebuffer nothing;
    nothing.size = {molecule_size_.x, 0};
    write_molecule(with_margin(nothing, {molecule_size_.x, std::min(kSlice, count - row)}, 0, layers_),
                   first_row + row);
  }
}

void PictureFile::write_molecule(Framebuffer rows, int first_row) {
  annotations_.lay_over(rows, first_row);
  const int count = rows.size.y;
  write(std::move(rows), first_row, count);
}

void PictureFile::write(Framebuffer rows, int first_row, int count) {
  if (margins_.legend) rows = margins_.legend->rows(rows, first_row, count, layers_, background_);
  writer_->add(rows);
}

void PictureFile::commit() {
  const int bottom = margins_.strips.top + molecule_size_.y;
  if (page_) {
    std::vector<PageShape> shapes = shapes_of(annotations_, margins_.strips.top, bottom);
    if (margins_.legend) {
      const std::vector<PageShape> more = shapes_of(*margins_.legend, background_);
      shapes.insert(shapes.end(), more.begin(), more.end());
    }
    return page_->commit(shapes);
  }
  write_strip(bottom, margins_.strips.bottom);
  for (int row = bottom + margins_.strips.bottom; row < size_.y; row += kSlice) {  // a legend below
    Framebuffer nothing;
    nothing.size = {molecule_size_.x, 0};
    write(std::move(nothing), row, std::min(kSlice, size_.y - row));
  }
  writer_->commit();
}

void write_legend_picture(const std::filesystem::path& path, const Legend& legend, const ImageSettings& settings) {
  if (!is_page(path)) return write_image(path, legend.alone(settings.background), settings);
  check_image_path(path);
  PixelBox drawn{legend.picture_size(), {0, 0}};
  const auto add = [&](const glm::ivec2& low, const glm::ivec2& high) {
    drawn = {glm::min(drawn.low, low), glm::max(drawn.high, high)};
  };
  const int half = (legend.font().height() + 1) / 2;
  for (const LegendText& text : legend.texts())
    add(text.place - glm::ivec2(0, half), text.place + glm::ivec2(legend.font().width(text.text), half));
  for (const LegendBox& box : legend.boxes()) add(box.low - legend.frame_width(), box.high + legend.frame_width());
  drawn = drawn.grown(std::max(1, legend.font().height() / 2));
  PageFile(path, {drawn.low, drawn.high}, settings).commit(shapes_of(legend, settings.background));
}

}  // namespace meniscus
