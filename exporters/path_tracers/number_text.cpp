// SPDX-License-Identifier: BSD-3-Clause
// Refuses what is no number, and leaves the rest to fmt.
#include "exporters/path_tracers/number_text.h"

#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"

namespace meniscus::path_tracers {
namespace {

template <class T>
std::string finite_text(T value) {
  if (!std::isfinite(value)) throw Error("export of a scene: a number of the surface is not finite");
  return fmt::format("{}", value == T(0) ? T(0) : value);  // no -0
}

template <class Vector>
std::string joined(const Vector& v, std::string_view between) {
  return fmt::format("{}{}{}{}{}", number_text(v.x), between, number_text(v.y), between, number_text(v.z));
}

}  // namespace

std::string number_text(double value) { return finite_text(value); }
std::string number_text(float value) { return finite_text(value); }
std::string vector_text(const glm::dvec3& v, std::string_view between) { return joined(v, between); }
std::string vector_text(const glm::vec3& v, std::string_view between) { return joined(v, between); }

}  // namespace meniscus::path_tracers
