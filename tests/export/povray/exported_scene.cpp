// SPDX-License-Identifier: BSD-3-Clause
// Exports a scene, renders it, and compares the result.
#include "tests/export/povray/exported_scene.h"

#include <array>
#include <iostream>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/run_program.h"

namespace meniscus::testing {

ExportedScene::ExportedScene(const NamedBalls& molecule, int color_count)
    : molecule_(molecule),
      object_{"surface",
              compute_surface_cpu(molecule.balls, molecule.probe_radius),
              turning_colors(molecule.balls.size(), color_count),
              {}},
      tracer_(molecule.balls, molecule.probe_radius) {
  for (std::size_t a = 0; a < molecule.balls.size(); ++a) colors_.push_back(static_cast<int>(a) % color_count);
}

povray::SceneReport ExportedScene::write(const Camera& camera, int width, int height,
                                         const std::filesystem::path& folder) const {
  povray::SceneOptions options;
  options.width = width;
  options.height = height;
  return write_scene({&object_, 1}, camera, options, folder);
}

BufferDifference ExportedScene::difference(const Camera& camera, int width, int height,
                                           const Mutation& mutation) const {
  const test::TemporaryFolder scratch;
  const std::filesystem::path folder = scratch.path() / "scene";
  const povray::SceneReport report = write(camera, width, height, folder);
  if (mutation) {
    const std::filesystem::path geometry = folder / "surface_geometry.inc";
    const std::string text = test::read_bytes(geometry), changed = mutation(text);
    EXPECT_TRUE(text != changed) << "the fault did not meet anything";
    write_text(geometry, changed);
  }
  PovrayRun run;
  const Buffers buffers = render_buffers(folder, "surface", width, height, &run);
  EXPECT_EQ(run.finite_objects + run.infinite_objects, report.object_count);
  if (!mutation) {
    EXPECT_EQ(run.infinite_objects, 0u);
    EXPECT_TRUE(run.warnings.empty()) << run.warnings.front();
  }
  const BufferDifference d =
      compare_buffers(buffers, tracer_, molecule_.balls, molecule_.probe_radius, colors_, camera, report.origin);
  std::cout << molecule_.name << ": " << d.text() << '\n';
  return d;
}

Camera oblique_camera(const Surface& surface, Projection projection, double aspect, int turn) {
  static constexpr std::array<glm::dvec3, 3> kDirections{{{0.48, -0.36, 0.8}, {-0.7, 0.5, 0.3}, {0.2, 0.9, -0.6}}};
  Camera camera = frame_camera(surface.atoms, aspect, projection);
  // The camera is so far away that its orthographic plane passes by every atom from any side.
  double distance = glm::distance(camera.position, camera.target);
  if (projection == Projection::orthographic) distance += 100.0;
  camera.position = camera.target + distance * glm::normalize(kDirections[turn % kDirections.size()]);
  camera.up = {0.1, 1.0, 0.2};
  return camera;
}

}  // namespace meniscus::testing
