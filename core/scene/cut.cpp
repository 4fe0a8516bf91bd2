// SPDX-License-Identifier: BSD-3-Clause
// Parses cutting planes, and measures depths along the view.
#include "core/scene/cut.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::optional<glm::dvec3> parse_direction(std::string_view text) {
  if (text == "depth") return glm::dvec3(0.0);
  if (text == "x") return glm::dvec3(1.0, 0.0, 0.0);
  if (text == "y") return glm::dvec3(0.0, 1.0, 0.0);
  if (text == "z") return glm::dvec3(0.0, 0.0, 1.0);
  glm::dvec3 direction;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t comma = text.find(',');
    if ((axis < 2) != (comma != std::string_view::npos)) return {};
    const std::optional<double> value = parse_number(text.substr(0, comma));
    if (!value) return {};
    direction[axis] = *value;
    if (axis < 2) text.remove_prefix(comma + 1);
  }
  const double length = glm::length(direction);
  if (!(length > 1e-150) || !std::isfinite(length)) return {};
  return direction;
}

}  // namespace

Cut parse_cut(std::string_view text) {
  std::string tight(text);
  std::erase(tight, ' ');
  const std::size_t sign = tight.find_first_of("<>");
  const auto refuse = [&](const char* why) {
    return RequestError(
        fmt::format("{} is not a plane: {}; write one such as x<20, 1,1,0>35 or depth>0.5", in_quotes(text), why));
  };
  if (sign == std::string::npos) throw refuse("there is no < or >");
  const std::optional<glm::dvec3> direction = parse_direction(std::string_view(tight).substr(0, sign));
  if (!direction) throw refuse("expected x, y, z, depth or a direction of three numbers before < or >");
  const std::optional<double> bound = parse_number(std::string_view(tight).substr(sign + 1));
  if (!bound) throw refuse("expected one number after < or >");
  return {*direction, tight[sign] == '<', *bound};
}

std::string cut_text(const Cut& cut) {
  const glm::dvec3& d = cut.direction;
  std::string axis = fmt::format("{},{},{}", d.x, d.y, d.z);
  if (d == glm::dvec3(0.0)) axis = "depth";
  for (int c = 0; c < 3; ++c) {
    glm::dvec3 unit(0.0);
    unit[c] = 1.0;
    if (d == unit) axis = std::string(1, static_cast<char>('x' + c));
  }
  return fmt::format("{}{}{}", axis, cut.keeps_less ? '<' : '>', cut.bound);
}

ClipPlane clip_plane(const Cut& cut, const Camera& camera, std::span<const Ball> atoms) {
  glm::dvec3 normal = cut.direction;
  double offset = cut.bound;
  if (normal == glm::dvec3(0.0)) {
    normal = view_basis(camera).forward;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Ball& ball : atoms) {
      const double depth = glm::dot(ball.center, normal);
      low = std::min(low, depth - ball.radius);
      high = std::max(high, depth + ball.radius);
    }
    offset = low + cut.bound * (high - low);
  }
  const double length = glm::length(normal) * (cut.keeps_less ? 1.0 : -1.0);
  return {normal / length, offset / length};
}

std::vector<ClipPlane> clip_planes(std::span<const Cut> cuts, const Camera& camera, std::span<const Ball> atoms) {
  std::vector<ClipPlane> planes;
  for (const Cut& cut : cuts) planes.push_back(clip_plane(cut, camera, atoms));
  return planes;
}

std::vector<std::string> idle_cuts(std::span<const Cut> cuts, const Camera& camera, std::span<const Ball> atoms,
                                   std::span<const Ball> balls) {
  std::vector<std::string> sentences;
  for (const Cut& cut : cuts) {
    const ClipPlane plane = clip_plane(cut, camera, atoms);
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Ball& ball : balls) {
      const double along = glm::dot(plane.normal, ball.center);
      least = std::min(least, along - ball.radius);
      most = std::max(most, along + ball.radius);
    }
    const bool keeps_all = most <= plane.offset;
    if (!keeps_all && least < plane.offset) continue;
    std::string where = "0 is its nearest point, 1 its farthest";
    if (cut.direction != glm::dvec3(0.0)) {
      // The plane's normal has the length 1, and points to what is cut away.
      const double scale = glm::length(cut.direction) * (cut.keeps_less ? 1.0 : -1.0);
      const std::string axis = cut_text(cut);
      where = fmt::format("its {} is {:.1f} to {:.1f}", axis.substr(0, axis.find_first_of("<>")),
                          std::min(scale * least, scale * most), std::max(scale * least, scale * most));
    }
    sentences.push_back(
        fmt::format("{} {} of the surface: {}", cut_text(cut), keeps_all ? "cuts nothing" : "leaves nothing", where));
  }
  return sentences;
}

}  // namespace meniscus
