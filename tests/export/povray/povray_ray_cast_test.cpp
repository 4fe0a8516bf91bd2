// SPDX-License-Identifier: BSD-3-Clause
// The program's own picture and POV-Ray's picture of its export from one camera have equal points and normals.
#include <cmath>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/export/povray/povray_render.h"
#include "tests/support/run_program.h"

namespace meniscus::testing {
namespace {

// Reads three channels of an image by name.
std::vector<glm::dvec3> read_channels(const std::string& file, const std::string& prefix) {
  const auto input = OIIO::ImageInput::open(file);
  if (!input) throw std::runtime_error("cannot read " + file);
  const OIIO::ImageSpec& spec = input->spec();
  std::vector<float> values(static_cast<std::size_t>(spec.width) * spec.height * spec.nchannels);
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
    throw std::runtime_error(input->geterror());
  const int x = spec.channelindex(prefix + ".x"), y = spec.channelindex(prefix + ".y"),
            z = spec.channelindex(prefix + ".z");
  std::vector<glm::dvec3> result;
  for (std::size_t n = 0; n < values.size(); n += spec.nchannels)
    result.push_back({values[n + x], values[n + y], values[n + z]});
  return result;
}

class SameCamera : public ::testing::TestWithParam<std::string> {};

TEST_P(SameCamera, PositionsAndNormalsAgree) {
  const test::TemporaryFolder folder;
  const std::string picture = (folder.path() / "cast.exr").string(), camera = (folder.path() / "camera.json").string(),
                    scene = (folder.path() / "scene").string(), file = "/usr/share/pymol/data/demo/1tii.pdb";
  const auto program = [](const std::vector<std::string>& arguments) {
    const test::ProgramResult run = test::run_program(test::meniscus_program(), arguments, 120);
    ASSERT_EQ(run.exit_code, 0) << run.err;
  };
  program({"render", file, "--size", "400x300", "--samples", "1", "--aovs", "-o", picture, "--projection", GetParam(),
           "--save-camera", camera});
  program({"export", "povray", file, "--size", "400x300", "--camera", camera, "-o", scene, "--device", "cpu"});
  const Buffers buffers = render_buffers(scene, "surface", 400, 300);
  const std::vector<glm::dvec3> position = read_channels(picture, "P"), normal = read_channels(picture, "N");

  // Both see the same surface from the same place, up to a shift of the origin, which the geometry states.
  const std::string geometry = test::read_bytes(scene + "/surface_geometry.inc");
  glm::dvec3 origin(0.0);
  const std::string mark = "position here + <";
  ASSERT_EQ(
      std::sscanf(geometry.c_str() + geometry.find(mark) + mark.size(), "%lf,%lf,%lf", &origin.x, &origin.y, &origin.z),
      3);
  std::size_t surface = 0, silhouette = 0, far = 0, turned = 0;
  double largest = 0.0;
  for (std::size_t n = 0; n < position.size(); ++n) {
    const bool cast_hit = glm::length(normal[n]) > 0.5;
    silhouette += cast_hit != (buffers.hit[n] != 0);
    if (!cast_hit || !buffers.hit[n]) continue;
    ++surface;
    const double error = glm::distance(position[n] - origin, buffers.position[n]);
    far += error > 0.01;
    if (error <= 0.01) largest = std::max(largest, error);
    turned += glm::distance(normal[n], buffers.normal[n]) > 0.02;
  }
  std::cout << GetParam() << ": " << position.size() << " px, " << surface << " surface; silhouette differs "
            << silhouette << ", position by more than 0.01 A " << far << ", normal by more than 0.02 " << turned
            << ", largest position difference of the rest " << largest << " A\n";
  EXPECT_GT(surface, position.size() / 4);
  EXPECT_LE(silhouette + far, position.size() / 10000);
  EXPECT_LE(turned, position.size() / 10000);
}

INSTANTIATE_TEST_SUITE_P(PovrayRayCast, SameCamera, ::testing::Values("perspective", "orthographic"),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace meniscus::testing
