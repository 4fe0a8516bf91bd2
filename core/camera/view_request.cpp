// SPDX-License-Identifier: BSD-3-Clause
// Places the camera that a request for a view describes.
#include "core/camera/view_request.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/camera/camera_json.h"
#include "core/camera/foreign_cameras.h"
#include "core/math/ball.h"

namespace meniscus {
namespace {

glm::dvec3 middle_of(std::span<const Ball> balls) {
  glm::dvec3 sum(0.0);
  for (const Ball& ball : balls) sum += ball.center;
  return sum / static_cast<double>(balls.size());
}

/// The camera with these axes, as far from the pivot as it was and in the same place before it.
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
  if (request.camera_file.starts_with('{')) return parse_camera(request.camera_file, "--camera");
  return read_any_camera(request.camera_file, request.aspect());
}

ViewBasis aimed_basis(const ViewRequest& request, const std::optional<Camera>& given, const ViewedBalls& balls) {
  if (given) return turned(view_basis(*given), request.turns);
  if (!request.direction) return turned(broad_side(balls.shown), request.turns);
  return turned(view_basis(*request.direction, balls.shown, balls.symmetry), request.turns);
}

Camera view_camera(const ViewRequest& request, const std::optional<Camera>& given, const ViewedBalls& balls) {
  if (given && !request.zoom_to) {
    if (request.turns.empty()) return *given;
    return swung(*given, aimed_basis(request, given, balls), middle_of(balls.shown));
  }
  Camera lens;
  lens.projection = request.projection;
  return frame_camera(balls.framed, aimed_basis(request, given, balls), request.aspect(), given.value_or(lens));
}

bool sees_nothing(const Camera& camera, double aspect, std::span<const Ball> balls, double reach) {
  const ViewBasis basis = view_basis(camera);
  const glm::dvec2 half = half_extent(camera, aspect);
  const bool perspective = camera.projection == Projection::perspective;
  // Outside of one side of the picture, or behind the camera.
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
