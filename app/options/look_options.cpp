// SPDX-License-Identifier: BSD-3-Clause
// Declares the look options and checks what they say.
#include "app/options/look_options.h"

#include <cmath>
#include <string>
#include <vector>

namespace meniscus {
namespace {

void parse_direction(const std::vector<float>& values, glm::vec3& direction) {
  const glm::vec3 given(values[0], values[1], values[2]);
  const float length = std::hypot(given.x, given.y, given.z);
  if (!std::isfinite(length) || length < 1e-6f)
    throw CLI::ValidationError("--light", "is no direction: give three numbers that are not all 0, such as -1,1,1");
  direction = given;
}

}  // namespace

void add_look_options(CLI::App& command, Look& look) {
  command
      .add_option_function<std::vector<float>>(
          "--light", [&look](const std::vector<float>& values) { parse_direction(values, look.light_direction); },
          "Towards the lamp: right, up, towards the viewer [-0.45,0.65,0.75]")
      ->delimiter(',')
      ->expected(3)
      ->type_name("X,Y,Z");
  const auto number = [&](const char* name, float& value, float low, float high, const char* what, const char* unit) {
    command.add_option(name, value, what)->check(CLI::Range(low, high).description(""))->type_name(unit);
  };
  number("--light-strength", look.light_strength, 0.0f, 10.0f, "Of the lamp, 0 to 10 [1]", "F");
  number("--ambient-occlusion", look.ambient_occlusion, 0.0f, 1.0f,
         "Shade in pockets and clefts, 0 (none, default) to 1, by what the picture shows around them", "F");
  number("--ambient-occlusion-radius", look.ambient_occlusion_radius, 0.1f, 1000.0f,
         "How far shade is cast, in Å and at most 256 pixels [8]", "Å");
  number("--silhouettes", look.silhouettes, 0.0f, kWidestSilhouette,
         "Width in pixels of black lines around what stands in front, and between chains [0: none]", "PX");
  number("--depth-cue", look.depth_cue, 0.0f, 1.0f, "How far the farthest fades into the background, 0 (default) to 1",
         "F");
}

}  // namespace meniscus
