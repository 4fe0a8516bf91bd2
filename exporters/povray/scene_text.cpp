// SPDX-License-Identifier: BSD-3-Clause
// Writes numbers and vectors in the notation of POV-Ray.
#include "exporters/povray/scene_text.h"

#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/base/error.h"

namespace meniscus::povray {
namespace {

constexpr int kLengthDecimals = 6;
constexpr int kRatioDecimals = 7;

void require_finite(double value) {
  if (!std::isfinite(value)) throw Error("POV-Ray export: a number of the surface is not finite");
}

}  // namespace

SceneText& SceneText::literal(std::string_view text) {
  text_ += text;
  return *this;
}

SceneText& SceneText::fixed(double value, int decimals) {
  require_finite(value);
  const std::size_t begin = text_.size();
  fmt::format_to(std::back_inserter(text_), "{:.{}f}", value, decimals);
  text_.erase(text_.find_last_not_of('0') + 1);
  if (text_.back() == '.') text_.pop_back();
  if (std::string_view(text_).substr(begin) == "-0") text_.erase(begin, 1);
  return *this;
}

SceneText& SceneText::length(double value) { return fixed(value, kLengthDecimals); }

SceneText& SceneText::ratio(double value) { return fixed(value, kRatioDecimals); }

SceneText& SceneText::full(double value) {
  require_finite(value);
  fmt::format_to(std::back_inserter(text_), "{:.17g}", value);
  return *this;
}

SceneText& SceneText::count(std::size_t value) {
  fmt::format_to(std::back_inserter(text_), "{}", value);
  return *this;
}

SceneText& SceneText::point(const glm::dvec3& p) {
  return literal("<").length(p.x).literal(",").length(p.y).literal(",").length(p.z).literal(">");
}

SceneText& SceneText::direction(const glm::dvec3& d) {
  return literal("<").ratio(d.x).literal(",").ratio(d.y).literal(",").ratio(d.z).literal(">");
}

SceneText& SceneText::full_vector(const glm::dvec3& v) {
  return literal("<").full(v.x).literal(",").full(v.y).literal(",").full(v.z).literal(">");
}

SceneText& SceneText::plane(const Plane& p, const glm::dvec3& anchor) {
  // POV-Ray normalizes the normal that it reads, so the rounded normal is normalized here, too.
  const double scale = std::pow(10.0, kRatioDecimals);
  glm::dvec3 rounded(std::round(p.normal.x * scale), std::round(p.normal.y * scale), std::round(p.normal.z * scale));
  rounded = glm::normalize(rounded);
  const double offset = p.offset + glm::dot(rounded - p.normal, anchor);
  return literal("plane{").direction(p.normal).literal(",").length(offset).literal("}");
}

}  // namespace meniscus::povray
