// SPDX-License-Identifier: BSD-3-Clause
// Declares the look options and checks what they say.
#include "app/options/look_options.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/options/picture_options.h"
#include "app/options/value_words.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

glm::vec3 direction_of(const std::vector<float>& values) {
  const bool complete = values.size() == 3;
  const glm::vec3 given = complete ? glm::vec3(values[0], values[1], values[2]) : glm::vec3(0.0f);
  const float length = std::hypot(given.x, given.y, given.z);
  if (!std::isfinite(length) || length < 1e-6f)
    throw CLI::ValidationError("--light", "is no direction: give three numbers that are not all 0, such as -1,1,1");
  return given;
}

}  // namespace

void add_look_options(CLI::App& command, LookRequest& look, ViewRequest& picture) {
  const std::map<std::string, LookPreset> presets{{"publication", LookPreset::publication},
                                                  {"cover", LookPreset::cover},
                                                  {"flat", LookPreset::flat},
                                                  {"soft", LookPreset::soft},
                                                  {"classic", LookPreset::classic}};
  const auto usual = std::ranges::find(presets, look.preset, [](const auto& entry) { return entry.second; });
  command
      .add_option("--preset", look.preset,
                  fmt::format("A look, which the next options change whatever their order: publication (shade, thin "
                              "lines, colours as given), cover (studio light, highlights), flat (constant colours and "
                              "lines), soft (matt, no lines), classic (studio light alone); where colours stand for "
                              "numbers or a legend explains them, light changes their lightness alone [{}]",
                              usual->first))
      ->transform(one_of(presets))
      ->type_name("WORD");
  command
      .add_option_function<std::vector<float>>(
          "--light", [&look](const std::vector<float>& values) { look.light_direction = direction_of(values); },
          "Towards the lamp: right, up, towards the viewer [-0.45,0.65,0.75]")
      ->delimiter(',')
      ->expected(3)
      ->type_name("X,Y,Z");
  const auto number = [&](const char* name, std::optional<float>& value, float low, float high, const char* what,
                          const char* unit) {
    command.add_option(name, value, what)->check(CLI::Range(low, high).description(""))->type_name(unit);
  };
  number("--light-strength", look.light_strength, 0.0f, 10.0f, "Of the lamp, 0 to 10 [1]", "F");
  number("--ambient", look.ambient, 0.0f, 1.0f, "Share of light from everywhere, 0 to 1 (exactly the colours given)",
         "F");
  number("--roughness", look.roughness, 0.0f, 1.0f, "From wax (0), which is darker at the sides, to chalk (1)", "F");
  number("--specular", look.specular, 0.0f, 1.0f, "Strength of highlights, 0 (none) to 1", "F");
  number("--shininess", look.shininess, 1.0f, 1000.0f, "How small they are: their exponent, 1 to 1000", "F");
  number("--ambient-occlusion", look.ambient_occlusion, 0.0f, 1.0f,
         "Shade in pockets and clefts, 0 (none) to 1, by what the picture shows around them", "F");
  number("--ambient-occlusion-radius", look.ambient_occlusion_radius, 0.1f, 1000.0f, "How far shade is cast", "Å");
  const auto width = [&](const char* name, std::optional<float>& value, const char* what) {
    command
        .add_option_function<std::string>(
            name,
            [name, &value, &picture](const std::string& text) {
              const double pixels = pixels_of(name, text, picture);
              if (!(pixels >= 0.0 && pixels <= kWidestSilhouette))
                throw CLI::ValidationError(name, fmt::format("{} makes {:.4g} pixels; a line has 0 to {}",
                                                             in_quotes(text), pixels, kWidestSilhouette));
              value = static_cast<float>(pixels);
            },
            what)
        ->type_name("WIDTH");
  };
  width("--silhouettes", look.silhouettes,
        "Width of black lines around what stands in front, and between chains: pixels, or 0.5pt, 0.2mm; 0: none");
  width("--outer-lines", look.outer_lines, "Of those around the whole, if not as all");
  width("--inner-lines", look.inner_lines, "Of those where something stands in front");
  width("--part-lines", look.part_lines, "Of those where chains meet");
  number("--depth-cue", look.depth_cue, 0.0f, 1.0f,
         "How far the farthest fades into the background, or into white if that is transparent, 0 to 1; not by itself "
         "where colours stand for numbers or a legend explains them",
         "F");
  command.add_flag(
      "--linear-alpha", look.linear_alpha,
      "Edges of transparent .png and .tif for programs that blend in linear light; without it they look on "
      "a page as they do on white");
}

}  // namespace meniscus
