// SPDX-License-Identifier: BSD-3-Clause
// What a figure's colours mean.
#include "app/preview/preview_view.h"

namespace meniscus {

ColorScheme PreviewFigure::told_scheme() const {
  ColorScheme told = color;
  if (patch_kinds) {
    told.by = ColorScheme::By::kind;
    told.rules.clear();
  }
  return told;
}

}  // namespace meniscus
