// SPDX-License-Identifier: BSD-3-Clause
// Finds the axes of pictures, of inertia, symmetry or the file, and places the camera that a request describes.
#include "core/camera/view_request.h"

#include <tuple>

#include <glm/matrix.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/camera/camera_json.h"
#include "core/camera/open_side.h"
#include "core/math/ball.h"

namespace meniscus {
namespace {

using Frame = ViewDirection::Frame;

struct NamedDirection {
  std::string_view name;
  ViewDirection direction;
  bool has_opposite;  ///< true if it may follow a minus sign
};

constexpr std::array<NamedDirection, 16> kDirections{{
    {"front", {Frame::inertia, 2, false}, false},
    {"back", {Frame::inertia, 2, true}, false},
    {"top", {Frame::inertia, 1, false}, false},
    {"bottom", {Frame::inertia, 1, true}, false},
    {"right", {Frame::inertia, 0, false}, false},
    {"left", {Frame::inertia, 0, true}, false},
    {"x", {Frame::file, 0, false}, true},
    {"y", {Frame::file, 1, false}, true},
    {"z", {Frame::file, 2, false}, true},
    {"1", {Frame::inertia, 0, false}, true},
    {"2", {Frame::inertia, 1, false}, true},
    {"3", {Frame::inertia, 2, false}, true},
    {"symmetry", {Frame::symmetry, 2, false}, true},
    {"symmetry-side", {Frame::symmetry_side, 2, false}, true},
    {"open", {Frame::open, 2, false}, true},
    {"channel", {Frame::channel, 2, false}, true},
}};

/// Returns the axes seen from the direction `toward`, with `up` made perpendicular to it.
ViewBasis facing(const glm::dvec3& toward, const glm::dvec3& up) {
  const glm::dvec3 right = glm::normalize(glm::cross(up, toward));
  return {right, glm::cross(toward, right), -toward};
}

/// Returns a unit vector at a right angle to the axis: as near as possible to y of the file, or to z.
glm::dvec3 across(const glm::dvec3& axis) {
  const glm::dvec3 y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
  constexpr double kTooNear = 0.9;  // cosine
  const glm::dvec3 wanted = std::abs(glm::dot(axis, y)) < kTooNear ? y : z;
  return glm::normalize(wanted - axis * glm::dot(axis, wanted));
}

ViewBasis opposite_of(const ViewBasis& basis) { return {-basis.right, basis.up, -basis.forward}; }

/// Returns the axes of the broad side, or of the opposite one if the viewer looks rather in that direction.
ViewBasis usual_side(const ViewedBalls& balls) {
  const ViewBasis broad = broad_side(balls.shown);
  return balls.forward && glm::dot(*balls.forward, broad.forward) < 0.0 ? opposite_of(broad) : broad;
}

}  // namespace

ViewBasis view_basis(const ViewDirection& direction, const ViewedBalls& balls) {
  const glm::dvec3 symmetry = balls.symmetry.value_or(glm::dvec3(0.0, 0.0, 1.0));
  const double sign = direction.opposite ? -1.0 : 1.0;
  const glm::dvec3 y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
  if (direction.frame == Frame::open) {
    const ViewBasis open = open_side(balls.framed, balls.shown);
    return direction.opposite ? opposite_of(open) : open;
  }
  if (direction.frame == Frame::channel) {
    const std::optional<ViewBasis> end = channel_end(balls.framed, balls.shown);
    if (!end)
      throw RequestError(
          message("@view channel@: from no side can anything be seen through these atoms; a channel must be straight "
                  "and open, and @zoom-to@ may name the atoms around it"));
    return direction.opposite ? opposite_of(*end) : *end;
  }
  if (direction.frame == Frame::symmetry) return facing(sign * symmetry, across(symmetry));
  if (direction.frame == Frame::symmetry_side) return facing(sign * across(symmetry), symmetry);
  glm::dvec3 toward(0.0);
  if (direction.frame == Frame::file) {
    toward[direction.axis] = sign;
    return facing(toward, direction.axis == 1 ? -sign * z : y);
  }
  const ViewBasis broad = usual_side(balls);
  if (direction.axis == 0) return facing(sign * broad.right, broad.up);
  if (direction.axis == 1) return facing(sign * broad.up, sign * broad.forward);
  return facing(-sign * broad.forward, broad.up);
}

namespace {

/// An axis and the number of rotations about it.
struct AxisCount {
  glm::dvec3 axis;
  std::size_t count = 0;
};

/// Returns the axis of a rotation, upwards: towards +z, then +y, +x. Nothing for the identity.
std::optional<glm::dvec3> axis_of(const glm::dmat3& r) {
  constexpr double kNoTurn = 1e-3;  // radians; motions in files are rounded
  const double cosine = std::clamp(0.5 * (r[0][0] + r[1][1] + r[2][2] - 1.0), -1.0, 1.0);
  if (std::acos(cosine) < kNoTurn) return {};
  // (R + R^T)/2 - cos I is (1 - cos) times the outer product of the axis with itself: its longest column is the axis.
  const glm::dmat3 outer = 0.5 * (r + glm::transpose(r)) - cosine * glm::dmat3(1.0);
  glm::dvec3 axis = outer[0];
  for (int column = 1; column < 3; ++column)
    if (glm::length(outer[column]) > glm::length(axis)) axis = outer[column];
  axis = glm::normalize(axis);
  constexpr double kZero = 1e-4;
  const double sign = std::abs(axis.z) > kZero ? axis.z : std::abs(axis.y) > kZero ? axis.y : axis.x;
  return sign < 0.0 ? -axis : axis;
}

}  // namespace

std::optional<ViewDirection> parse_view_direction(std::string_view text) {
  const bool opposite = text.starts_with('-');
  if (opposite) text.remove_prefix(1);
  for (const NamedDirection& known : kDirections) {
    if (known.name != text || (opposite && !known.has_opposite)) continue;
    ViewDirection direction = known.direction;
    direction.opposite = direction.opposite != opposite;
    return direction;
  }
  return {};
}

std::vector<std::string> view_direction_words() {
  std::vector<std::string> words;
  for (const NamedDirection& known : kDirections) {
    words.emplace_back(known.name);
    if (known.has_opposite) words.push_back("-" + std::string(known.name));
  }
  return words;
}

std::optional<glm::dvec3> symmetry_axis(std::span<const RigidMotion> motions) {
  // Rotations are relative to only a few of the motions: they are a group as a rule, and capsids have 60, filaments
  // thousands.
  constexpr std::size_t kReferences = 4;
  constexpr double kSameAxis = 1e-2;  // sine
  std::vector<AxisCount> axes;
  for (std::size_t first = 0; first < std::min(kReferences, motions.size()); ++first) {
    const glm::dmat3 back = glm::transpose(motions[first].rotation);
    for (const RigidMotion& motion : motions) {
      const std::optional<glm::dvec3> axis = axis_of(motion.rotation * back);
      if (!axis) continue;
      const auto same = std::ranges::find_if(
          axes, [&](const AxisCount& known) { return glm::length(glm::cross(known.axis, *axis)) < kSameAxis; });
      if (same == axes.end())
        axes.push_back({*axis, 1});
      else
        ++same->count;
    }
  }
  if (axes.empty()) return {};
  // Among equal axes, the one nearest to z, then y, then -x. Coordinates are compared as rounded, because motions of a
  // file and of its copies differ in their last digits.
  const auto rank = [](const AxisCount& axis) {
    const auto rounded = [](double x) { return std::lround(x * 1e4); };
    return std::tuple(axis.count, rounded(axis.axis.z), rounded(axis.axis.y), -rounded(axis.axis.x));
  };
  return std::ranges::max_element(axes, {}, rank)->axis;
}

std::optional<Turn> parse_turn(std::string_view text) {
  constexpr std::string_view kAxes = "xyz";
  if (text.size() < 2 || kAxes.find(text.front()) == std::string_view::npos || text[1] == ' ') return {};
  Turn turn{static_cast<int>(kAxes.find(text.front())), 0.0};
  constexpr double kMost = 1e6;
  if (!parse_number(text.substr(1), turn.degrees) || std::abs(turn.degrees) > kMost) return {};
  return turn;
}

ViewBasis turned(ViewBasis basis, std::span<const Turn> turns) {
  for (const Turn& turn : turns) {
    const double angle = turn.degrees * (std::numbers::pi / 180.0), c = std::cos(angle), s = std::sin(angle);
    // The camera turns in the opposite sense.
    const glm::dvec3 right = basis.right, up = basis.up, toward = -basis.forward;
    if (turn.axis == 0) basis = {right, c * up - s * toward, -(c * toward + s * up)};
    if (turn.axis == 1) basis = {c * right + s * toward, up, -(c * toward - s * right)};
    if (turn.axis == 2) basis = {c * right - s * up, c * up + s * right, -toward};
  }
  return basis;
}

glm::dvec3 mean_center(std::span<const Ball> balls) {
  glm::dvec3 sum(0.0);
  for (const Ball& ball : balls) sum += ball.center;
  return sum / static_cast<double>(balls.size());
}

namespace {

/// Returns the camera with these axes, as far from the pivot as before, with the pivot at the same place in the
/// picture.
Camera swung(const Camera& camera, const ViewBasis& basis, const glm::dvec3& pivot) {
  const ViewBasis old = view_basis(camera);
  const auto carried = [&](const glm::dvec3& point) {
    const glm::dvec3 from = point - pivot;
    return pivot + basis.right * glm::dot(from, old.right) + basis.up * glm::dot(from, old.up) +
           basis.forward * glm::dot(from, old.forward);
  };
  Camera result = camera;
  result.position = carried(camera.position);
  result.target = carried(camera.target);
  result.up = basis.up;
  return result;
}

}  // namespace

std::optional<Camera> given_camera(const ViewRequest& request) {
  if (request.camera_file.empty()) return {};
  if (request.camera_file.starts_with('{')) return parse_camera(request.camera_file, option_name("camera"));
  return read_any_camera(request.camera_file, request.aspect());
}

ViewBasis aimed_basis(const ViewRequest& request, const std::optional<Camera>& given, const ViewedBalls& balls) {
  if (given) return turned(view_basis(*given), request.turns);
  if (!request.direction) return turned(usual_side(balls), request.turns);
  return turned(view_basis(*request.direction, balls), request.turns);
}

Camera view_camera(const ViewRequest& request, const std::optional<Camera>& given, const ViewedBalls& balls) {
  if (given && !request.zoom_to) {
    if (request.turns.empty()) return *given;
    return swung(*given, aimed_basis(request, given, balls), mean_center(balls.shown));
  }
  Camera lens;
  lens.projection = request.projection;
  return frame_camera(balls.framed, aimed_basis(request, given, balls), request.aspect(), given.value_or(lens));
}

bool sees_nothing(const Camera& camera, double aspect, std::span<const Ball> balls, double reach) {
  const ViewBasis basis = view_basis(camera);
  const glm::dvec2 half = half_extent(camera, aspect);
  const bool perspective = camera.projection == Projection::perspective;
  // True for a ball outside one side of the picture, or behind the camera.
  return std::ranges::all_of(balls, [&](const Ball& ball) {
    const glm::dvec3 from = ball.center - camera.position;
    const double x = std::abs(glm::dot(from, basis.right)), y = std::abs(glm::dot(from, basis.up)),
                 z = glm::dot(from, basis.forward), radius = ball.radius + reach;
    if (z + radius < 0.0) return true;
    if (!perspective) return x - radius > half.x || y - radius > half.y;
    return x - half.x * z > radius * std::sqrt(1.0 + half.x * half.x) ||
           y - half.y * z > radius * std::sqrt(1.0 + half.y * half.y);
  });
}

}  // namespace meniscus
