// SPDX-License-Identifier: BSD-3-Clause
// A molecule with its surface and its oracle, and the comparison of rendered pixels for a camera.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/camera/camera.h"
#include "core/surface/compute_surface.h"
#include "exporters/povray/povray_scene.h"
#include "tests/export/povray/buffer_comparison.h"
#include "tests/export/povray/patch_molecules.h"

namespace meniscus::testing {

/// Changes the geometry's text before POV-Ray sees it.
using Mutation = std::function<std::string(const std::string&)>;

class ExportedScene {
 public:
  /// Computes the surface for the molecule's own probe. Atoms get `color_count` colours in turn.
  explicit ExportedScene(const NamedBalls& molecule, int color_count = 3);

  const Surface& surface() const { return object_.surface; }

  /// Writes the scene, renders its buffers and compares every pixel with the oracle. Expects a clean parse: no warning,
  /// no infinite object, as many objects as the exporter says. Prints the difference.
  BufferDifference difference(const Camera& camera, int width, int height, const Mutation& mutation = {}) const;

  povray::SceneReport write(const Camera& camera, int width, int height, const std::filesystem::path& folder) const;

 private:
  NamedBalls molecule_;
  std::vector<int> colors_;
  SurfaceObject object_;
  SphereTracer tracer_;
};

/// Returns a camera whose direction, in the molecule's axes, is no symmetry of anything; turn picks one of several.
Camera oblique_camera(const Surface& surface, Projection projection, double aspect, int turn = 0);

}  // namespace meniscus::testing
