// SPDX-License-Identifier: BSD-3-Clause
// Turns annotations and legends into shapes of a page, and passes them to the writer of its format.
#include "core/render/vector_page.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>
#include <utility>

#include "core/base/system_file.h"

namespace meniscus {
namespace {

PageText page_text(const Font& font, const std::string& text, const glm::ivec2& place) {
  return {text, font.height(), {place.x, font.baseline(place.y)}, font.letters(text)};
}

/// Returns the shape of a stroke of the annotations that is wider by `around` on all sides.
PageShape shape_of(const InkStroke& stroke, double around, const AnnotationLayer& annotations) {
  PageShape shape;
  if (const auto* const text = std::get_if<InkText>(&stroke)) {
    shape.text = page_text(annotations.font_of(*text), text->text, text->place);
    shape.line = 2.0 * around;
  } else if (const auto* const line = std::get_if<InkLine>(&stroke)) {
    shape.from = line->from;
    shape.to = line->to;
    shape.line = line->width + 2.0 * around;
    shape.opacity = line->share;
  } else if (const auto* const box = std::get_if<PixelBox>(&stroke)) {
    shape.from = glm::dvec2(box->low) - around;
    shape.to = glm::dvec2(box->high) + around;
  }
  return shape;
}

bool reaches_into(const InkStroke& stroke, int first_row, int end_row) {
  double low = 0.0, high = 0.0;
  if (const auto* const text = std::get_if<InkText>(&stroke)) {
    const double half = 0.56 * text->height;  // with accents, or with what is below the line
    low = text->place.y - half;
    high = text->place.y + half;
  } else if (const auto* const line = std::get_if<InkLine>(&stroke)) {
    low = std::min(line->from.y, line->to.y) - line->width;
    high = std::max(line->from.y, line->to.y) + line->width;
  } else if (const auto* const box = std::get_if<PixelBox>(&stroke)) {
    low = box->low.y;
    high = box->high.y;
  }
  return low < end_row && high > first_row;
}

}  // namespace

std::vector<PageShape> shapes_of(const AnnotationLayer& annotations, int first_row, int end_row) {
  std::vector<PageShape> shapes;
  const auto add = [&](const InkStroke& stroke, double around, std::string_view group, const glm::vec3& color) {
    const auto* const text = std::get_if<InkText>(&stroke);
    if (text && text->text.empty()) return;  // the length of a hidden line
    PageShape& shape = shapes.emplace_back(shape_of(stroke, around, annotations));
    shape.group = group;
    shape.color = color;
  };
  const std::span<const InkStroke> strokes = annotations.strokes();
  const Inks& inks = annotations.inks();
  for (const InkStroke& stroke : strokes)
    if (reaches_into(stroke, first_row, end_row)) add(stroke, annotations.rim_width(), kHalos, inks.rim);
  for (std::size_t n = 0; n < strokes.size(); ++n) add(strokes[n], 0.0, annotations.group_of(n), inks.ink);
  return shapes;
}

std::vector<PageShape> shapes_of(const Legend& legend, const std::optional<glm::vec3>& background) {
  constexpr const char* kGroup = "legend";
  std::vector<PageShape> shapes;
  const glm::vec3 ink = legend.inks(background).ink;
  for (const LegendBox& box : legend.boxes()) {
    if (box.colors.front().x < 0.0f) continue;  // "+3 more" has no colour
    const glm::dvec2 low(box.low), high(box.high), frame(legend.frame_width());
    shapes.push_back({kGroup, ink, low - frame, high + frame});
    const bool upright = high.y - low.y > high.x - low.x;
    // Each colour extends to the end of the bar, so that no paper is visible between two colours.
    for (std::size_t n = 0; n < box.colors.size(); ++n) {
      if (n > 0 && box.colors[n] == box.colors[n - 1]) continue;
      const double along = static_cast<double>(n);
      shapes.push_back({kGroup, box.colors[n], upright ? low : glm::dvec2(low.x + along, low.y),
                        upright ? glm::dvec2(high.x, high.y - along) : high});
    }
  }
  for (const LegendText& text : legend.texts())
    shapes.push_back({kGroup, ink, {}, {}, page_text(legend.font(), text.text, text.place)});
  return shapes;
}

namespace {

std::string extension_in_small_letters(const std::filesystem::path& path) {
  std::string extension = text_of_path(path.extension());
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

}  // namespace

bool is_page(const std::filesystem::path& path) {
  const std::string extension = extension_in_small_letters(path);
  return extension == ".svg" || extension == ".pdf";
}

PageFile::PageFile(const std::filesystem::path& path, const PageLayout& layout, const ImageSettings& settings) {
  encoder_ = (extension_in_small_letters(path) == ".svg" ? svg_encoder : pdf_encoder)(path, layout, settings);
}

PageFile::~PageFile() = default;

void PageFile::add(const Framebuffer& rows) { encoder_->add(rows); }

void PageFile::commit(std::span<const PageShape> shapes) { encoder_->commit(shapes); }

}  // namespace meniscus
