// SPDX-License-Identifier: BSD-3-Clause
// Checks of cameras.
#include "tests/fuzz/camera_checks.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "tests/fuzz/target.h"

namespace meniscus::fuzz {
namespace {

constexpr double kRounding = 1e-6;

bool is_unit(const glm::dvec3& v) { return std::abs(glm::length(v) - 1.0) < kRounding; }

}  // namespace

void check_camera(const Camera& camera) {
  try {
    validate_camera(camera, "the camera");
  } catch (const InputError& error) {
    throw PropertyError(std::string("a camera that was accepted is valid: ") + error.what());
  }
  const ViewBasis basis = view_basis(camera);
  require(is_unit(basis.right) && is_unit(basis.up) && is_unit(basis.forward), "axes of a view have length 1");
  require(
      std::abs(glm::dot(basis.right, basis.up)) < kRounding && std::abs(glm::dot(basis.up, basis.forward)) < kRounding,
      "axes of a view are at right angles");
  for (const glm::dvec2 pixel : {glm::dvec2(0.0), glm::dvec2(640.0, 480.0)})
    require(is_unit(pixel_ray(camera, {640.0, 480.0}, pixel).direction), "rays have a direction");
}

bool same_camera(const Camera& a, const Camera& b) {
  return a.position == b.position && a.target == b.target && a.up == b.up && a.projection == b.projection &&
         (a.projection == Projection::perspective ? a.vertical_fov == b.vertical_fov : a.height == b.height);
}

}  // namespace meniscus::fuzz
