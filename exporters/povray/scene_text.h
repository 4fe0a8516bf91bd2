// SPDX-License-Identifier: BSD-3-Clause
// Text of the POV-Ray scene language, built from numbers and literals of ours only.
#pragma once

#include <string>
#include <string_view>

#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus::povray {

/// Collects scene text. Numbers are written without locale, in fixed notation, with trailing zeros cut.
/// Throws Error when a number is not finite: a scene never holds nan or inf.
class SceneText {
 public:
  /// A piece of the scene language; of what came from a file nothing but comments of scene_report.h.
  SceneText& literal(std::string_view text);
  /// Å, to 1e-6.
  SceneText& length(double value);
  /// A component of a unit vector, a colour or a ratio, to 1e-7.
  SceneText& ratio(double value);
  /// All digits a double has.
  SceneText& full(double value);
  SceneText& count(std::size_t value);
  SceneText& point(const glm::dvec3& p);        ///< <x,y,z> as lengths
  SceneText& direction(const glm::dvec3& d);    ///< <x,y,z> as ratios
  SceneText& full_vector(const glm::dvec3& v);  ///< <x,y,z> with all digits
  /// `plane{...}` whose inside is dot(normal, x) <= offset. The offset is adapted to the rounded normal so that the
  /// written plane has its least error near `anchor`, however far that is from the origin.
  SceneText& plane(const Plane& p, const glm::dvec3& anchor);

  const std::string& text() const { return text_; }
  void clear() { text_.clear(); }

 private:
  SceneText& fixed(double value, int decimals);
  std::string text_;
};

}  // namespace meniscus::povray
