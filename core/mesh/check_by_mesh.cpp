// SPDX-License-Identifier: BSD-3-Clause
// Checks areas and volumes of a surface against meshes of it, at one tolerance after another.
#include "core/mesh/check_by_mesh.h"

#include <array>

#include "core/base/error.h"
#include "core/base/message.h"
#include "core/mesh/tessellate.h"

namespace meniscus {
namespace {

constexpr std::array kTolerances{0.1, 0.03, 0.01};  // Å, the finer ones after the others have failed

}  // namespace

void check_by_mesh(const Surface& surface) {
  for (const double tolerance : kTolerances) {
    try {
      tessellate(surface, {tolerance, false});
      return;
    } catch (const OpenSurfaceError& error) {
      if (tolerance == kTolerances.back()) throw OpenSurfaceError(message("@verify@: {}", error.what()));
    }
  }
}

}  // namespace meniscus
