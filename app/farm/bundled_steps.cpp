// SPDX-License-Identifier: BSD-3-Clause
// The table of commands that can be bundled, and their steps.
#include "app/farm/bundled_steps.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus::farm {

std::vector<Step> steps_of(const std::vector<std::string>& words) {
  const Step surface{"surface", Maker::meniscus, {}};
  const std::string command = fmt::format("{}", fmt::join(words, " "));
  if (command == "render") return {{"render", Maker::meniscus, {}}};
  if (command == "export povray") return {surface, {"render", Maker::povray, {}}};
  if (command == "export blender") return {surface, {"render", Maker::blender, {}}};
  if (command == "export mitsuba" || command == "export pbrt") return {surface};
  throw RequestError(
      fmt::format("{} cannot be bundled; render and export povray, blender, mitsuba and pbrt can", in_quotes(command)));
}

}  // namespace meniscus::farm
