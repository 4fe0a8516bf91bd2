// SPDX-License-Identifier: BSD-3-Clause
// Small pictures are compared with kept ones; scripts/check/update_golden.sh writes these again.
#include <cmath>
#include <cstdlib>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include "core/gpu/egl_context.h"
#include "core/render/image_output.h"
#include "core/render/legend.h"
#include "core/render/gl_renderer.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"
#include "tests/support/run_program.h"
#include "core/color/coloring.h"

namespace meniscus {
namespace {

std::vector<float> read_png(const std::string& path, int& channel_count) {
  auto input = OIIO::ImageInput::open(path);
  if (!input) return {};
  channel_count = input->spec().nchannels;
  std::vector<float> values(input->spec().image_pixels() * channel_count);
  input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, values.data());
  return values;
}

/// Renders 96 x 96 pixels with 4 samples, transparent.
Framebuffer render(const testing::Balls& balls, bool by_kind, Projection projection, const Look& look = {},
                   glm::ivec2 size = {96, 96}) {
  const Surface surface = compute_surface_cpu(balls, 1.4);
  Coloring coloring;
  for (std::size_t i = 0; i < balls.size(); ++i)
    coloring.atom.push_back(i % 2 ? glm::vec3(0.80f, 0.25f, 0.20f) : glm::vec3(0.70f, 0.72f, 0.75f));
  if (by_kind) coloring.kind = {{{0.2f, 0.6f, 0.4f}, {0.4f, 0.6f, 0.9f}, {0.8f, 0.4f, 0.2f}}};
  RenderSettings settings;
  settings.size = size;
  settings.samples = 4;
  settings.look = look;
  EglContext context;
  const double aspect = static_cast<double>(size.x) / size.y;
  return GlRenderer().render(surface, coloring, frame_camera(surface.atoms, aspect, projection), settings);
}

void expect_golden(const std::string& name, const Framebuffer& picture) {
  const std::string golden = test::test_file("data/golden/" + name + ".png");
  if (std::getenv("MENISCUS_UPDATE_GOLDEN")) {
    write_image(golden, picture, {std::nullopt, Existing::replace});
    GTEST_SKIP() << "wrote " << golden;
  }
  const std::string fresh = ::testing::TempDir() + "/meniscus_" + name + ".png";
  write_image(fresh, picture, {std::nullopt, Existing::replace});
  int golden_channels = 0, fresh_channels = 0;
  const auto expected = read_png(golden, golden_channels), values = read_png(fresh, fresh_channels);
  ASSERT_EQ(golden_channels, 4) << golden;
  ASSERT_EQ(values.size(), expected.size());
  int different = 0;
  for (std::size_t i = 0; i < values.size(); ++i) different += std::abs(values[i] - expected[i]) > 2.5f / 255.0f;
  // Another driver may decide one sample of a few silhouette pixels differently.
  EXPECT_LE(different, static_cast<int>(values.size()) / 1000) << "compare " << fresh << " with " << golden;
}

TEST(Golden, TwoAtomsSpindle) {
  expect_golden("two_atoms_spindle", render(testing::two_atoms(5.2, 1.7, 1.3), true, Projection::orthographic));
}

TEST(Golden, Lattice) {
  expect_golden("lattice", render(testing::lattice(3, 2, 2, 4.0), false, Projection::perspective));
}

TEST(Golden, Ubiquitin) { expect_golden("ubiquitin", render(testing::ubiquitin(), true, Projection::perspective)); }

TEST(Golden, ShadeLinesAndAir) {
  Look look;
  look.ambient_occlusion = 1.0f;
  look.silhouettes = 2.0f;
  look.depth_cue = 0.6f;
  expect_golden("shade_lines_air", render(testing::ubiquitin(), false, Projection::perspective, look));
}

TEST(Golden, LegendOfNumbers) {
  ColorScale scale;
  scale.title = "B-factor";
  scale.unit = "Å²";
  scale.range = {4.0, 87.5};
  scale.missing = 3;
  scale.missing_color = glm::vec3(0.5f);
  const Legend legend({"", scale, {}}, {240, 160});
  const Framebuffer molecule =
      render(testing::tetrahedron(3.5), false, Projection::perspective, {}, legend.molecule_size());
  expect_golden("legend_of_numbers", legend.add_to(molecule, std::nullopt));
}

}  // namespace
}  // namespace meniscus
