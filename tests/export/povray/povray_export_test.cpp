// SPDX-License-Identifier: BSD-3-Clause
// Exported scenes rendered by POV-Ray, pixel by pixel against the sphere-tracing oracle.
#include <algorithm>
#include <iostream>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/surface/surface.h"
#include "exporters/povray/scene.h"
#include "tests/export/povray/buffer_comparison.h"
#include "tests/export/povray/molecules.h"

namespace meniscus::testing {
namespace {

constexpr double kAspect = 4.0 / 3.0;
constexpr int kWidth = 240, kHeight = 180;

// One molecule exported once; the camera is the only thing that changes between its pictures.
struct Exported {
  explicit Exported(const Molecule& m)
      : molecule(m), surface(compute_surface_cpu(m.balls, kWaterProbe)), tracer(m.balls, kWaterProbe) {
    for (std::size_t a = 0; a < m.balls.size(); ++a) colors.push_back(static_cast<int>(a % 3));
  }
  povray::SceneReport write(const Camera& camera, const ScratchFolder& folder, int width = kWidth,
                            int height = kHeight) const {
    povray::SceneOptions options;
    options.width = width;
    options.height = height;
    return write_scene(surface, three_colors(molecule.balls.size()), camera, options, folder.path() / "scene");
  }
  BufferDifference difference(const Camera& camera, int width = kWidth, int height = kHeight) const {
    const ScratchFolder folder;
    const povray::SceneReport report = write(camera, folder, width, height);
    PovrayRun run;
    const Buffers buffers = render_buffers(folder.path() / "scene", "surface", width, height, &run);
    EXPECT_EQ(run.finite_objects, report.object_count);
    EXPECT_EQ(run.infinite_objects, 0u);
    EXPECT_TRUE(run.warnings.empty()) << run.warnings.front();
    const BufferDifference d =
        compare_buffers(buffers, tracer, molecule.balls, kWaterProbe, colors, camera, report.origin);
    std::cout << molecule.name << ": " << d.text() << '\n';
    return d;
  }
  Molecule molecule;
  Surface surface;
  SphereTracer tracer;
  std::vector<int> colors;
};

// The view from a direction that is no symmetry of anything.
Camera oblique(const Surface& surface, Projection projection) {
  Camera camera = frame_camera(surface, kAspect, projection);
  // Far enough for an orthographic camera's plane to pass by every atom from any side.
  double distance = glm::distance(camera.position, camera.target);
  if (projection == Projection::orthographic) distance += 30.0;
  camera.position = camera.target + distance * glm::normalize(glm::dvec3(0.48, -0.36, 0.8));
  camera.up = {0.1, 1.0, 0.2};
  return camera;
}

class SmallMolecule : public ::testing::TestWithParam<Molecule> {};

TEST_P(SmallMolecule, EveryPixelAgreesInPerspectiveAndOrthographic) {
  const Exported exported(GetParam());
  ASSERT_TRUE(exported.surface.certificate.closed);
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    const BufferDifference d = exported.difference(oblique(exported.surface, projection));
    EXPECT_GT(d.surface, d.pixels / 20);
    EXPECT_EQ(d.position, 0u);
    EXPECT_EQ(d.normal, 0u);
    EXPECT_EQ(d.kind, 0u);
    EXPECT_EQ(d.color, 0u);
    EXPECT_EQ(d.odd_layers, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(PovrayExport, SmallMolecule, ::testing::ValuesIn(small_molecules()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace meniscus::testing
