// SPDX-License-Identifier: BSD-3-Clause
// Text in the POV-Ray scene language, built from numbers and from literals of this program only.
#pragma once

#include <string>
#include <string_view>

#include <glm/vec3.hpp>

#include "core/surface/primitives.h"

namespace meniscus::povray {

/// Collects scene text. Numbers are written independently of the locale, in fixed notation, without trailing zeros.
/// Every member throws Error for a number that is not finite, so that a scene never contains nan or inf.
class SceneText {
 public:
  /// Appends a piece of the scene language. Text from molecule files must not be passed, except as comments made by
  /// color_comment() and piece_comment().
  SceneText& literal(std::string_view text);
  /// Appends a length in Å, rounded to 1e-6.
  SceneText& length(double value);
  /// Appends a component of a unit vector, a colour or a ratio, rounded to 1e-7.
  SceneText& ratio(double value);
  /// Appends a number with all digits of a double.
  SceneText& full(double value);
  SceneText& count(std::size_t value);
  SceneText& point(const glm::dvec3& p);        ///< <x,y,z> as lengths
  SceneText& direction(const glm::dvec3& d);    ///< <x,y,z> as ratios
  SceneText& full_vector(const glm::dvec3& v);  ///< <x,y,z> with all digits
  /// Appends `plane{...}` whose inside is dot(normal, x) <= offset. The offset is adapted to the rounded normal, so
  /// that the error of the written plane is smallest near `anchor`, however far that is from the origin.
  SceneText& plane(const Plane& p, const glm::dvec3& anchor);

  const std::string& text() const { return text_; }
  void clear() { text_.clear(); }

 private:
  SceneText& fixed(double value, int decimals);
  std::string text_;
};

}  // namespace meniscus::povray
