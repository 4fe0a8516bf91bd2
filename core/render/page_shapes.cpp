// SPDX-License-Identifier: BSD-3-Clause
// Turns what is written into pictures, and their legends, into paths.
#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/render/vector_page.h"

namespace meniscus {
namespace {

using Kind = PathStep::Kind;

std::vector<PathStep> box_path(const glm::dvec2& low, const glm::dvec2& high) {
  return {{Kind::move, {low}},
          {Kind::line, {glm::dvec2(high.x, low.y)}},
          {Kind::line, {high}},
          {Kind::line, {glm::dvec2(low.x, high.y)}},
          {Kind::close}};
}

std::vector<PathStep> line_path(const glm::dvec2& from, const glm::dvec2& to) {
  return {{Kind::move, {from}}, {Kind::line, {to}}};
}

/// Of four cubic curves, within 0.03 % of its radius.
std::vector<PathStep> circle_path(const glm::dvec2& middle, double radius) {
  const double handle = 0.5522847498 * radius;
  std::vector<PathStep> path{{Kind::move, {middle + glm::dvec2(radius, 0.0)}}};
  glm::dvec2 from(1.0, 0.0);
  for (int n = 0; n < 4; ++n) {
    const glm::dvec2 to(-from.y, from.x);
    path.push_back(
        {Kind::curve,
         {middle + radius * from + handle * to, middle + radius * to + handle * from, middle + radius * to}});
    from = to;
  }
  path.push_back({Kind::close});
  return path;
}

/// `around` on all sides more than the stroke itself.
std::vector<PageShape> shapes_of(const InkStroke& stroke, const glm::vec3& color, double around, FontShelf& fonts) {
  std::vector<PageShape> shapes;
  if (const auto* const text = std::get_if<InkText>(&stroke)) {
    PageShape shape{fonts.of(*text).outline(text->text, text->place), color};
    if (around == 0.0) shape.text = text->text;
    shapes.push_back(shape);
    if (around > 0.0) shape.line = 2.0 * around, shapes.push_back(shape);
  } else if (const auto* const line = std::get_if<InkLine>(&stroke)) {
    const double width = line->width + 2.0 * around;
    if (line->from == line->to)
      shapes.push_back({circle_path(line->from, 0.5 * width), color, line->share});
    else
      shapes.push_back({line_path(line->from, line->to), color, line->share, width});
  } else if (const auto* const box = std::get_if<PixelBox>(&stroke)) {
    shapes.push_back({box_path(glm::dvec2(box->low) - around, glm::dvec2(box->high) + around), color});
  }
  return shapes;
}

bool reaches_into(const InkStroke& stroke, int first_row, int end_row) {
  double low = 0.0, high = 0.0;
  if (const auto* const text = std::get_if<InkText>(&stroke)) {
    low = text->place.y - text->height;
    high = text->place.y + text->height;
  } else if (const auto* const line = std::get_if<InkLine>(&stroke)) {
    low = std::min(line->from.y, line->to.y) - line->width;
    high = std::max(line->from.y, line->to.y) + line->width;
  } else if (const auto* const box = std::get_if<PixelBox>(&stroke)) {
    low = box->low.y;
    high = box->high.y;
  }
  return low < end_row && high > first_row;
}

void append(std::vector<PageShape>& shapes, std::vector<PageShape> more) {
  shapes.insert(shapes.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

std::vector<PageShape> shapes_of(const AnnotationLayer& annotations, int first_row, int end_row) {
  FontShelf fonts;
  std::vector<PageShape> shapes;
  const Inks& inks = annotations.inks();
  for (const InkStroke& stroke : annotations.strokes())
    if (reaches_into(stroke, first_row, end_row))
      append(shapes, shapes_of(stroke, inks.rim, annotations.rim_width(), fonts));
  for (const InkStroke& stroke : annotations.strokes()) append(shapes, shapes_of(stroke, inks.ink, 0.0, fonts));
  return shapes;
}

std::vector<PageShape> shapes_of(const Legend& legend, const std::optional<glm::vec3>& background) {
  std::vector<PageShape> shapes;
  const glm::vec3 ink = legend.inks(background).ink;
  for (const LegendBox& box : legend.boxes()) {
    if (box.colors.front().x < 0.0f) continue;  // "+3 more" has no colour
    const glm::dvec2 low(box.low), high(box.high), frame(legend.frame_width());
    shapes.push_back({box_path(low - frame, high + frame), ink});
    const bool upright = high.y - low.y > high.x - low.x;
    // Each colour reaches to the end of the bar, so that none of the paper is seen between two.
    for (std::size_t n = 0; n < box.colors.size(); ++n) {
      if (n > 0 && box.colors[n] == box.colors[n - 1]) continue;
      const double along = static_cast<double>(n);
      shapes.push_back(
          {upright ? box_path(low, {high.x, high.y - along}) : box_path({low.x + along, low.y}, high), box.colors[n]});
    }
  }
  for (const LegendText& text : legend.texts()) {
    PageShape shape{legend.font().outline(text.text, text.place), ink};
    shape.text = text.text;
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

}  // namespace meniscus
