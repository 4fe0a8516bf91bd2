// SPDX-License-Identifier: BSD-3-Clause
// Places texts and lines, and blends them into pixels by the share that they cover.
#include "core/render/annotation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/image/color_space.h"
#include "core/render/text_raster.h"
#include "core/camera/camera.h"

namespace meniscus {
namespace {

/// Whole rows of a picture.
struct RowRange {
  int first, end;

  bool meet(int low, int high) const { return low < end && high >= first; }
};

/// Shares of pixels that ink covers, of some rows of a picture. Places are those in the whole picture.
class InkMask {
 public:
  InkMask(int width, const RowRange& rows)
      : rows_(rows), size_(width, rows.end - rows.first), shares_(static_cast<std::size_t>(size_.x) * size_.y, 0.0f) {}

  void text(const Font& font, const std::string& text, glm::ivec2 place) {
    const int reach = 2 * font.height();  // of letters above and below
    if (rows_.meet(place.y - reach, place.y + reach))
      font.draw(text, place - glm::ivec2(0, rows_.first), shares_, size_);
  }

  /// share: of each pixel within; the more of several counts.
  void line(const glm::dvec2& from, const glm::dvec2& to, double width, double share) {
    const double margin = 0.5 * width + 1.0;
    const glm::ivec2 low = glm::max(glm::ivec2(glm::floor(glm::min(from, to) - margin)), glm::ivec2(0, rows_.first));
    const glm::ivec2 high =
        glm::min(glm::ivec2(glm::ceil(glm::max(from, to) + margin)), glm::ivec2(size_.x, rows_.end) - 1);
    const glm::dvec2 along = to - from;
    const double square = std::max(glm::dot(along, along), 1e-12);
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) {
        const glm::dvec2 here = glm::dvec2(x, y) + 0.5 - from;
        const double t = std::clamp(glm::dot(here, along) / square, 0.0, 1.0);
        cover(x, y,
              static_cast<float>(share * std::clamp(0.5 * width + 0.5 - glm::length(here - t * along), 0.0, 1.0)));
      }
  }

  void box(glm::ivec2 low, glm::ivec2 high) {
    for (int y = std::max(low.y, rows_.first); y < std::min(high.y, rows_.end); ++y)
      for (int x = std::max(low.x, 0); x < std::min(high.x, size_.x); ++x) cover(x, y, 1.0f);
  }

  /// Lays ink over rows of the picture that are among these, and a rim of another colour around it where the picture is
  /// covered already. Within the rim's width of them all rows that the picture has are to be among these.
  void lay_over(Framebuffer& picture, int first_row, const glm::vec3& ink, const glm::vec3& rim, int rim_width) const {
    const std::vector<float> rims = thickened(rim_width);
    const std::size_t before = index(0, first_row);
    for (std::size_t n = 0; n < picture.color.size(); ++n) {
      const float rim_share = rims[before + n], ink_share = shares_[before + n];
      if (rim_share == 0.0f) continue;
      glm::vec4& pixel = picture.color[n];
      const float share = rim_share * pixel.w;
      pixel = glm::vec4(rim * share, share) + (1.0f - share) * pixel;
      pixel = glm::vec4(ink * ink_share, ink_share) + (1.0f - ink_share) * pixel;
    }
  }

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y - rows_.first) * size_.x + x; }

  void cover(int x, int y, float share) {
    float& covered = shares_[index(x, y)];
    covered = std::max(covered, std::clamp(share, 0.0f, 1.0f));
  }

  /// Each pixel as covered as the most covered one around, less towards the rim's width.
  std::vector<float> thickened(int width) const {
    std::vector<float> result = shares_;
    for (int y = rows_.first; y < rows_.end; ++y)
      for (int x = 0; x < size_.x; ++x) {
        const float share = shares_[index(x, y)];
        if (share == 0.0f) continue;
        for (int v = std::max(y - width, rows_.first); v <= std::min(y + width, rows_.end - 1); ++v)
          for (int u = std::max(x - width, 0); u <= std::min(x + width, size_.x - 1); ++u) {
            const float distance = std::hypot(static_cast<float>(u - x), static_cast<float>(v - y));
            float& there = result[index(u, v)];
            there = std::max(there, share * std::clamp(static_cast<float>(width) + 0.5f - distance, 0.0f, 1.0f));
          }
      }
    return result;
  }

  RowRange rows_;
  glm::ivec2 size_;
  std::vector<float> shares_;
};

using Stroke = std::function<void(InkMask& mask)>;

/// A text's box in the picture.
struct TextBox {
  glm::ivec2 low{0}, high{0};

  bool meets(const TextBox& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
  }
};

}  // namespace

/// Puts things into the corners and beside the places they name.
class AnnotationLayer::Writer {
 public:
  Writer(const glm::ivec2& size, const Camera& camera)
      : camera_(camera),
        size_(size),
        side_(std::min(size_.x, size_.y)),
        font_(std::max(9, side_ / 25)),
        large_(std::max(12, side_ / 16)),
        small_(std::max(8, side_ / 36)) {}

  /// What lies in these rows.
  InkMask mask(const RowRange& rows) const {
    InkMask mask(size_.x, rows);
    for (const Stroke& stroke : strokes_) stroke(mask);
    return mask;
  }
  int height() const { return size_.y; }
  int rim_width() const { return std::max(1, font_.height() / 9); }

  void panel(const std::string& text) {
    const int half = large_.height() / 2;
    write(large_, text, {half, 2 * half}, 2 * half);
  }

  void time(const std::string& text) {
    const int em = font_.height();
    write(font_, text, {size_.x - em - font_.width(text), em}, em);
  }

  void scale_bar(const std::optional<double>& asked) {
    const double unit = angstroms_per_pixel(camera_, size_);
    const double length = asked.value_or(round_length(0.25 * size_.x * unit));
    const int em = font_.height(), thickness = std::max(2, em / 5),
              pixels = static_cast<int>(std::lround(length / unit));
    if (pixels < 1 || pixels > size_.x - 2 * em)
      throw RequestError(
          fmt::format("--scale-bar: {:g} Å are {} pixels of {}; give another length", length, pixels, size_.x));
    const glm::ivec2 low(em, size_.y - em - thickness), high(em + pixels, size_.y - em);
    strokes_.emplace_back([=](InkMask& mask) { mask.box(low, high); });
    const std::string text = fmt::format("{:g} Å", length);
    const int left = std::max(em, em + (pixels - font_.width(text)) / 2);
    write(font_, text, {left, low.y - em}, em);
    taken_.push_back({low, high});
  }

  /// From the least of its numbers to the greatest, which are at its left; the present one is above.
  void curve(const Curve& curve) {
    const auto ends = std::ranges::minmax(curve.values);
    const double least = ends.min, greatest = ends.max;
    const double range = greatest - least, em = font_.height(), line = std::max(1.0, em / 12.0);
    const int decimals = range > 0.0 ? std::clamp(static_cast<int>(std::ceil(2.0 - std::log10(range))), 0, 9) : 3;
    const auto number = [&](double value) { return fmt::format("{:.{}f}", value, decimals); };
    const glm::dvec2 high(size_.x - em, size_.y - em),
        low(high.x - 0.3 * size_.x, high.y - std::max(3.0 * em, 0.1 * size_.y));
    const auto place = [&](std::size_t n) {
      const double across =
          curve.values.size() > 1 ? static_cast<double>(n) / static_cast<double>(curve.values.size() - 1) : 0.5;
      const double up = range > 0.0 ? (curve.values[n] - least) / range : 0.5;
      return glm::dvec2(low.x + across * (high.x - low.x), high.y - up * (high.y - low.y));
    };
    draw_line({low.x, low.y}, {low.x, high.y}, line, 0.5);
    draw_line({low.x, high.y}, {high.x, high.y}, line, 0.5);
    for (std::size_t n = 1; n < curve.values.size(); ++n)
      draw_line(place(n - 1), place(n), n <= curve.now ? 1.8 * line : line, n <= curve.now ? 1.0 : 0.45);
    draw_line(place(curve.now), place(curve.now), 0.5 * em);
    const int row = static_cast<int>(em), left = static_cast<int>(low.x), right = static_cast<int>(high.x),
              above = static_cast<int>(low.y - em);
    const auto width = [&](double value) { return font_.width(number(value)); };
    // The title stays where it is while the number changes.
    const int widest = std::max({width(least), width(greatest), width(curve.values[curve.now])});
    write(font_, curve.title, {right - widest - row / 2 - font_.width(curve.title), above}, row);
    write(font_, number(curve.values[curve.now]), {right - width(curve.values[curve.now]), above}, row);
    for (const double end : {least, greatest}) {
      const std::string text = number(end);
      const double y = end == greatest ? low.y : high.y;
      write(small_, text, {left - small_.height() / 2 - small_.width(text), static_cast<int>(y)}, small_.height());
    }
    taken_.push_back({glm::ivec2(low), glm::ivec2(high)});
  }

  void label(const PlaceLabel& label) {
    const std::optional<glm::dvec2> seen = place_in_picture(camera_, size_, label.position);
    if (!seen || seen->x < 0.0 || seen->y < 0.0 || seen->x > size_.x || seen->y > size_.y) return;
    // Away from the middle, where there is room.
    const glm::dvec2 middle = 0.5 * glm::dvec2(size_), out = *seen - middle;
    const double distance = glm::length(out);
    const glm::dvec2 direction = distance > 1.0 ? out / distance : glm::normalize(glm::dvec2(1.0, -1.0));
    const TextBox box = free_box(label.text, *seen + direction * (0.14 * side_));
    taken_.push_back(box);
    draw_text(font_, label.text, {box.low.x, (box.low.y + box.high.y) / 2});
    const double gap = 0.25 * font_.height(), width = std::max(1.0, font_.height() / 14.0);
    const glm::dvec2 near = glm::clamp(*seen, glm::dvec2(box.low) - gap, glm::dvec2(box.high) + gap);
    draw_line(near, *seen, width);
    draw_line(*seen, *seen, 4.0 * width);
  }

 private:
  void draw_line(const glm::dvec2& from, const glm::dvec2& to, double width, double share = 1.0) {
    strokes_.emplace_back([=](InkMask& mask) { mask.line(from, to, width, share); });
  }

  void draw_text(const Font& font, const std::string& text, glm::ivec2 place) {
    strokes_.emplace_back([&font, text, place](InkMask& mask) { mask.text(font, text, place); });
  }

  void write(const Font& font, const std::string& text, glm::ivec2 place, int height) {
    draw_text(font, text, place);
    taken_.push_back({{place.x, place.y - height / 2}, {place.x + font.width(text), place.y + height / 2}});
  }

  /// A box for the text as close to `wanted` as the picture and the boxes there allow, in steps up and down.
  TextBox free_box(const std::string& text, const glm::dvec2& wanted) const {
    const int em = font_.height();
    const glm::ivec2 extent(font_.width(text), em + em / 4);
    const glm::ivec2 margin(em / 2), last = glm::max(size_ - extent - margin, margin);
    TextBox first;
    for (int n = 0; n < 2 * size_.y / extent.y; ++n) {
      const int step = (n + 1) / 2 * extent.y * (n % 2 ? 1 : -1);
      const glm::ivec2 low = glm::clamp(glm::ivec2(wanted) - extent / 2 + glm::ivec2(0, step), margin, last);
      const TextBox box{low, low + extent};
      if (n == 0) first = box;
      if (std::ranges::none_of(taken_, [&](const TextBox& other) { return other.meets(box); })) return box;
    }
    return first;
  }

  const Camera& camera_;
  glm::ivec2 size_;
  int side_;
  Font font_, large_, small_;
  std::vector<Stroke> strokes_;
  std::vector<TextBox> taken_;
};

double angstroms_per_pixel(const Camera& camera, glm::ivec2 size) {
  if (camera.projection == Projection::orthographic) return camera.height / size.y;
  const double angle = camera.vertical_fov * std::numbers::pi / 180.0;
  return 2.0 * std::tan(0.5 * angle) * glm::distance(camera.position, camera.target) / size.y;
}

std::optional<glm::dvec2> place_in_picture(const Camera& camera, glm::ivec2 size, const glm::dvec3& point) {
  const ViewBasis basis = view_basis(camera);
  const glm::dvec3 to = point - camera.position;
  const double depth = glm::dot(to, basis.forward);
  double unit = angstroms_per_pixel(camera, size);
  if (camera.projection == Projection::perspective) {
    if (depth <= 1e-9) return {};
    unit *= depth / glm::distance(camera.position, camera.target);
  }
  return 0.5 * glm::dvec2(size) + glm::dvec2(glm::dot(to, basis.right), -glm::dot(to, basis.up)) / unit;
}

double round_length(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= most) return factor * power;
  return power;
}

AnnotationLayer::AnnotationLayer(const Annotations& annotations, const Camera& camera, glm::ivec2 picture_size,
                                 const std::optional<glm::vec3>& background)
    : ink_(linear_from_srgb(ink_on(background))), rim_(linear_from_srgb(rim_on(background))) {
  if (!annotations.any()) return;
  auto writer = std::make_unique<Writer>(picture_size, camera);
  if (!annotations.panel.empty()) writer->panel(annotations.panel);
  if (!annotations.time.empty()) writer->time(annotations.time);
  if (annotations.curve) writer->curve(*annotations.curve);
  if (annotations.scale_bar) writer->scale_bar(annotations.bar_length);
  for (const PlaceLabel& label : annotations.labels) writer->label(label);
  writer_ = std::move(writer);
}

AnnotationLayer::~AnnotationLayer() = default;

void AnnotationLayer::lay_over(Framebuffer& rows, int first_row) const {
  if (!writer_) return;
  const int rim = writer_->rim_width();
  const RowRange around{std::max(first_row - rim, 0), std::min(first_row + rows.size.y + rim, writer_->height())};
  writer_->mask(around).lay_over(rows, first_row, ink_, rim_, rim);
}

void annotate(Framebuffer& picture, const Annotations& annotations, const Camera& camera,
              const std::optional<glm::vec3>& background) {
  AnnotationLayer(annotations, camera, picture.size, background).lay_over(picture, 0);
}

}  // namespace meniscus
