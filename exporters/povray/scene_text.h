// SPDX-License-Identifier: BSD-3-Clause
// Text in POV-Ray's scene language: constant templates, and a writer for numbers and vectors.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

#include "core/base/text.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// Returns the templates of scenes, with the marks that are replaced in each:
///  main.pov      settings and lights, after the camera: NAME of the scene, SHADOWS, SOFTNESS;
///  surface.pov   a surface: GROUP ("union" or "object"), GEOMETRY and CAPS (#include statements for their files), and
///                HANDLE, the name it gets in a user's own scene;
///  map.inc       functions and colours of a volume map: FILE and the numbers that append_map() gives;
///  caps.inc      definitions before caps: DARK, the light of hatching;
///  shapes.inc    definitions before shapes;
///  frame.inc     the choice of a frame's include, after the list of frames of a run: NAME, PART, NAMED;
///  style.inc     lights and materials, after the colours;
///  buffers.inc   the buffers, after the extent of the molecule;
///  settings.ini  settings after the sizes: NAME, and PICTURE, the text between the name and the number of a picture;
///  film.ini      settings of a run, after settings.ini: NAME, COUNT of frames;
///  story.pov, story.ini  a film (story.h): NAME, WIDTH, HEIGHT, COUNT, RATE.
std::span<const TemplateFile> povray_templates();

}  // namespace meniscus

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
