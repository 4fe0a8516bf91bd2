// SPDX-License-Identifier: BSD-3-Clause
// Depth and normals that Blender renders from an exported file, pixel by pixel against the sphere-tracing oracle.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/camera/camera.h"
#include "core/camera/camera_json.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"
#include "tests/support/run_program.h"
#include "tests/support/sphere_tracer.h"

namespace meniscus::testing {
namespace {

constexpr int kWidth = 200, kHeight = 150;
constexpr double kTolerance = 0.002;  // tolerance of the mesh in Å

std::string xyzr(const Balls& balls) {
  std::string text;
  for (const Ball& b : balls) {
    text += fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}\n", b.center.x, b.center.y, b.center.z, b.radius);
  }
  return text;
}

/// Reads the planes of an EXR file by the last two parts of their names, such as "Depth.Z"; rows run from the top.
std::map<std::string, std::vector<float>> read_passes(const std::string& path) {
  const auto file = OIIO::ImageInput::open(path);
  std::map<std::string, std::vector<float>> planes;
  if (!file) return planes;
  const OIIO::ImageSpec& spec = file->spec();
  EXPECT_EQ(spec.width, kWidth);
  EXPECT_EQ(spec.height, kHeight);
  std::vector<float> pixels(spec.image_pixels() * spec.nchannels);
  EXPECT_TRUE(file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data()));
  for (int c = 0; c < spec.nchannels; ++c) {
    const std::string& name = spec.channelnames[c];
    auto& plane = planes[name.substr(name.find('.') + 1)];
    for (std::size_t i = 0; i < spec.image_pixels(); ++i) plane.push_back(pixels[i * spec.nchannels + c]);
  }
  return planes;
}

/// Exports a surface, renders it in Blender and reads the passes back.
std::map<std::string, std::vector<float>> render(const Balls& balls, const Camera& camera) {
  const test::TemporaryFolder folder;
  const std::string mns = (folder.path() / "molecule.mns").string(), exr = (folder.path() / "passes.exr").string();
  const auto exported = test::run_program(
      test::meniscus_program(), {"export", "blender", folder.file("molecule.xyzr", xyzr(balls)), "-o", mns, "--device",
                                 "cpu", "--camera", folder.file("camera.json", camera_json(camera)), "--size",
                                 fmt::format("{}x{}", kWidth, kHeight), "--tolerance", fmt::format("{}", kTolerance)});
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
  const auto rendered = test::run_program(BLENDER_PROGRAM,
                                          {"-b", "--factory-startup", "--python-exit-code", "3", "--python",
                                           BLENDER_ADDON "/render_mns.py", "--", mns, "--passes", exr},
                                          200);
  EXPECT_EQ(rendered.exit_code, 0) << rendered.out << rendered.err;
  return read_passes(exr);
}

struct Difference {
  std::size_t surface = 0, depth = 0, normal = 0;
  double mean_angle = 0.0;  ///< degrees, among pixels of equal depth
};

/// Counts a pixel as equal when its depth is the oracle's at its centre or at one of four points 1/20 pixel away.
Difference compare(const Balls& balls, const Camera& camera, std::map<std::string, std::vector<float>>& planes) {
  const SphereTracer oracle(balls, kWater, 0.25);
  const ViewBasis basis = view_basis(camera);
  Difference difference;
  const auto &z = planes["Depth.Z"], &nx = planes["Normal.X"], &ny = planes["Normal.Y"], &nz = planes["Normal.Z"];
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const std::size_t i = std::size_t(row) * kWidth + column;
      const bool hit = z[i] < 1e6f;
      difference.surface += hit;
      bool same_depth = false;
      double angle = 180.0;
      for (const glm::dvec2 shift : {glm::dvec2(0.0), {0.05, 0.0}, {-0.05, 0.0}, {0.0, 0.05}, {0.0, -0.05}}) {
        const Ray ray = pixel_ray(camera, {kWidth, kHeight}, glm::dvec2(column + 0.5, row + 0.5) + shift);
        const auto truth = oracle.trace(ray.origin, ray.direction, 1e3);
        if (truth.has_value() != hit) continue;
        if (!hit) {
          same_depth = true;
          angle = 0.0;
          break;
        }
        const double cosine = std::max(std::abs(glm::dot(ray.direction, truth->normal)), 0.05);
        const double depth = truth->t * glm::dot(ray.direction, basis.forward);
        if (std::abs(depth - z[i]) > 2.0 * kTolerance / cosine + 0.002) continue;
        same_depth = true;
        const double agreement = glm::dot(truth->normal, glm::normalize(glm::dvec3(nx[i], ny[i], nz[i])));
        angle = std::min(angle, std::acos(std::clamp(agreement, -1.0, 1.0)) * 180.0 / std::numbers::pi);
      }
      difference.depth += !same_depth;
      difference.normal += same_depth && angle > 3.0;
      if (same_depth && angle <= 3.0) difference.mean_angle += angle;
    }
  }
  difference.mean_angle /= double(std::max<std::size_t>(difference.surface, 1));
  return difference;
}

void expect_agreement(const Balls& balls, Projection projection) {
  const Surface surface = compute_surface_cpu(balls, kWater);
  const Camera camera = frame_camera(surface.atoms, double(kWidth) / kHeight, projection);
  auto planes = render(balls, camera);
  ASSERT_EQ(planes["Depth.Z"].size(), std::size_t(kWidth) * kHeight);
  ASSERT_EQ(planes["Normal.X"].size(), std::size_t(kWidth) * kHeight);
  const Difference d = compare(balls, camera, planes);
  std::printf("%zu pixels hit; depth differs in %zu, normal in %zu; mean angle %.4f degrees\n", d.surface, d.depth,
              d.normal, d.mean_angle);
  EXPECT_GT(d.surface, 5000u);
  EXPECT_LT(double(d.depth), 0.001 * double(d.surface));
  EXPECT_LT(double(d.normal), 0.001 * double(d.surface));
  EXPECT_LT(d.mean_angle, 0.1);

  // The comparison must be able to fail, as it does with planes shifted by one pixel.
  for (auto& [name, plane] : planes) std::rotate(plane.begin(), plane.begin() + 1, plane.end());
  EXPECT_GT(double(compare(balls, camera, planes).depth), 0.05 * double(d.surface));
}

TEST(BlenderPicture, DepthAndNormalsInPerspective) {
  expect_agreement(gas(3, 25, 9.0, 1.2, 2.0), Projection::perspective);
}
TEST(BlenderPicture, DepthAndNormalsInParallel) { expect_agreement(c60(1.45), Projection::orthographic); }
TEST(BlenderPicture, DepthAndNormalsOfAProtein) { expect_agreement(ubiquitin(), Projection::perspective); }

}  // namespace
}  // namespace meniscus::testing
