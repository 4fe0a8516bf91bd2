// SPDX-License-Identifier: BSD-3-Clause
// Adds the options of the look: one for each number of a look, and preset, light and edges.
#include "app/options/look_options.h"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/options/picture_options.h"
#include "app/options/property_options.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

glm::vec3 direction_of(const std::vector<float>& values) {
  const bool complete = values.size() == 3;
  const glm::vec3 given = complete ? glm::vec3(values[0], values[1], values[2]) : glm::vec3(0.0f);
  const float length = std::hypot(given.x, given.y, given.z);
  if (!std::isfinite(length) || length < 1e-6f)
    throw CLI::ValidationError("--light", "expected a direction: three numbers that are not all 0, such as -1,1,1");
  return given;
}

/// A width in pixels or as a length on paper, within the property's range.
float width_of(const Property& property, const std::string& text, ViewRequest& picture) {
  const std::string option(property.option);
  const double pixels = pixels_of(option.c_str(), text, picture);
  if (!property.is_within(pixels))
    throw CLI::ValidationError(option, fmt::format("{} makes {:.4g} pixels; a line has {} to {}", in_quotes(text),
                                                   pixels, property.lowest, property.highest));
  return static_cast<float>(pixels);
}

}  // namespace

void add_look_options(CLI::App& command, LookRequest& look, ViewRequest& picture) {
  PropertyOptions options(command);
  options.add_word(
      "look.preset", look.preset,
      {LookPreset::publication, LookPreset::cover, LookPreset::flat, LookPreset::soft, LookPreset::classic});
  options
      .add_numbers("look.light",
                   [&look](const std::vector<float>& values) { look.light_direction = direction_of(values); })
      ->delimiter(',')
      ->expected(3);
  for (const LookNumber& number : look_numbers()) {
    const Property& property = property_of(number.key);
    std::optional<float>& asked = look.*number.asked;
    if (property.type == ValueType::number)
      options.add(number.key, asked);
    else
      options.add_parsed(number.key, [&property, &asked, &picture](const std::string& text) {
        asked = width_of(property, text, picture);
      });
  }
  options.add("look.linear_alpha", look.linear_alpha);
}

}  // namespace meniscus
