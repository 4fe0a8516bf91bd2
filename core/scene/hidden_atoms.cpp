// SPDX-License-Identifier: BSD-3-Clause
// Marks atoms as hidden, for renderers and exporters.
#include "core/scene/hidden_atoms.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus {

std::vector<bool> hidden_atoms(const Selection& shown, const Structure& structure) {
  std::vector<bool> visible = shown.evaluate(structure);
  if (std::find(visible.begin(), visible.end(), true) == visible.end()) {
    throw InputError(structure.file, 0,
                     fmt::format("none of the {} atoms used is shown by {}; {}", with_thousands(structure.atoms.size()),
                                 in_quotes(shown.text()), shown.why_none(structure.atoms)));
  }
  visible.flip();
  return visible;
}

void hide(const std::vector<bool>& hidden, std::vector<SurfaceObject>& objects) {
  for (SurfaceObject& object : objects) {
    std::vector<bool>& of_object = object.coloring.hidden;
    of_object.resize(object.atom.size());
    for (std::size_t a = 0; a < of_object.size(); ++a) of_object[a] = of_object[a] || hidden[object.atom[a]];
  }
}

}  // namespace meniscus
