// SPDX-License-Identifier: BSD-3-Clause
// Numbers of a scene's text: the shortest that read back as the same, without locale.
#pragma once

#include <string>
#include <string_view>

#include <glm/vec3.hpp>

namespace meniscus::path_tracers {

/// Throw Error for what is not finite: a scene never holds nan or inf.
std::string number_text(double value);
std::string number_text(float value);
/// Three of them.
std::string vector_text(const glm::dvec3& v, std::string_view between = " ");
std::string vector_text(const glm::vec3& v, std::string_view between = " ");

}  // namespace meniscus::path_tracers
