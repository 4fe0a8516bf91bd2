// SPDX-License-Identifier: BSD-3-Clause
// The figure of a preview as tables for a page that casts it in the browser.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "app/preview/preview_state.h"
#include "app/preview/shown_molecule.h"
#include "core/math/ball.h"
#include "core/queries/surface_object.h"

namespace meniscus {

namespace page {
struct PackedFrame;
}

/// Packs what a state shows as `meniscus export page` packs the same scene, and keeps the complete surface, which
/// depends on the atoms and the probe alone. Used by one thread.
class FigureTables {
 public:
  /// Returns the frame, packed plainly, with the colours of the figure and no others. stop: called before each stage of
  /// a surface and after the last one; if it returns true, the figure is given up and the result is nullptr. Throws
  /// RequestError with a plain sentence if pages cannot show the figure, and OpenSurfaceError and CapacityError.
  std::shared_ptr<const page::PackedFrame> packed(const PreviewState& state, const ShownMolecule& molecule,
                                                  const std::function<bool()>& stop);

 private:
  bool compute(const PreviewState& state, const ShownMolecule& molecule, const std::function<bool()>& stop);
  void color(const Structure& structure, const PreviewState& state, const ShownMolecule& molecule);

  std::vector<Ball> balls_;  ///< of the surface
  SurfaceObject object_;     ///< the surface of the last figure that had one, with its colours
};

}  // namespace meniscus
