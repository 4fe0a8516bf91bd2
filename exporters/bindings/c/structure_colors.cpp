// SPDX-License-Identifier: BSD-3-Clause
// Colours atoms by the schemes that need the data of their file.
#include "exporters/bindings/c/structure_colors.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/base/text.h"
#include "core/color/color_atoms.h"
#include "core/color/color_schemes.h"
#include "core/color/coloring.h"
#include "exporters/bindings/c/c_calls.h"

namespace meniscus::c_api {

std::vector<glm::vec3> structure_colors(const Structure& structure, std::string_view scheme) {
  using By = ColorScheme::By;
  constexpr std::array kOfMore{By::kind,          By::component, By::buried,       By::rmsf,
                               By::accessibility, By::file,      By::conservation, By::lipophilicity};
  const std::optional<ColorScheme> by = parse_color_scheme(scheme);
  if (!by) refuse(MENISCUS_USAGE, "scheme: {} is not one of {}", in_quotes(scheme), color_scheme_words());
  if (std::ranges::find(kOfMore, by->by) != kOfMore.end())
    refuse(MENISCUS_USAGE, "scheme: {} needs more than the atoms of a file; a scene has it", in_quotes(scheme));
  return color_atoms(structure, *by).atom;
}

}  // namespace meniscus::c_api
