// SPDX-License-Identifier: BSD-3-Clause
// Common values of an exported run are found in one pass over its frames.
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "core/scene/run_framing.h"
#include "tests/support/run_program.h"
#include "tests/trajectory/samples.h"

namespace meniscus {
namespace {

constexpr std::uint32_t kFrames = 2000;

// Returns the bytes that this process has read, by any system call.
std::uint64_t bytes_read() {
  std::ifstream counts("/proc/self/io");
  std::string name;
  std::uint64_t count = 0;
  counts >> name >> count;
  EXPECT_EQ(name, "rchar:");
  return count;
}

class RunFramings : public ::testing::Test {
 protected:
  void SetUp() override {
    molecule_.file = folder_.file("atoms.xyzr", "0 0 0 1.5\n3 0 0 1.5\n0 3 0 1.5\n0 0 3 1.5\n");
    request_.trajectories = {folder_.file("run.dcd", test::dcd({.promised = kFrames, .frames = kFrames}))};
    request_.trust_atom_order = true;
  }

  test::TemporaryFolder folder_;
  MoleculeRequest molecule_;
  RunRequest request_;
};

TEST_F(RunFramings, ReadEachFrameOnce) {
  FrameRun frames(molecule_, request_);
  ASSERT_EQ(frames.numbers().size(), kFrames);
  const std::uint64_t before = bytes_read();
  ShownFrames shown(molecule_, frames);
  const RunFraming framing = run_framing({}, {}, {}, shown);
  const std::uint64_t read = bytes_read() - before, size = std::filesystem::file_size(request_.trajectories.front());
  EXPECT_GT(read, size * 9 / 10);
  EXPECT_LT(read, size * 3 / 2);
  EXPECT_EQ(framing.cameras.size(), 1u);
  // Atom a of frame f is at f + a / 8 - 10 times the axis.
  EXPECT_EQ(framing.extent.surface.low, glm::dvec3(-1.5, -11.5, -21.5));
  EXPECT_EQ(framing.extent.surface.high, glm::dvec3(0.375 + 1.5 + kFrames - 1) - glm::dvec3(0, 10, 20));
}

// A camera from a file needs no pass, but the box of all atoms does.
TEST_F(RunFramings, HaveTheBoxBesideACameraOfTheirOwn) {
  FrameRun frames(molecule_, request_);
  const Camera camera{.position = {0, 0, 50}};
  ShownFrames shown(molecule_, frames);
  const RunFraming framing = run_framing({}, {}, {.still = camera, .path = {}}, shown);
  EXPECT_EQ(framing.cameras.front().position, camera.position);
  EXPECT_EQ(framing.extent.surface.low.z, -21.5);
  EXPECT_EQ(framing.extent.surface.high.x, 0.375 + 1.5 + kFrames - 1);
}

// Atom a of frame f is at f + a / 8 - 10 times the axis: each coordinate takes N values, 1 Å apart.
TEST_F(RunFramings, FluctuationsAreThoseOfEvenSteps) {
  FrameRun frames(molecule_, request_);
  const double expected = std::sqrt(3.0 * (double{kFrames} * kFrames - 1.0) / 12.0);
  for (const double fluctuation : fluctuations(frames)) EXPECT_NEAR(fluctuation, expected, 1e-9 * expected);
  // A body that only moves does not fluctuate when it is fitted to the reference.
  request_.center = parse_selection("all");
  FrameRun still(molecule_, request_);
  for (const double fluctuation : fluctuations(still)) EXPECT_NEAR(fluctuation, 0.0, 1e-4);
}

// Each atom moves by 1 Å along each axis from a frame of the trajectory to the next.
TEST_F(RunFramings, VelocitiesAreThoseBetweenFramesOfTheRun) {
  const auto steps = [&](const std::string& list, std::uint64_t repeat) {
    request_.frames = list;
    request_.repeat = repeat;
    FrameRun frames(molecule_, request_, Velocities::central);
    std::vector<double> found;
    while (const std::optional<RunFrame> frame = frames.next()) {
      for (const glm::dvec3& velocity : frame->velocities) EXPECT_EQ(velocity, glm::dvec3(frame->velocities[0].x));
      found.push_back(frame->velocities[0].x);
    }
    return found;
  };
  EXPECT_EQ(steps("10-12", 1), (std::vector<double>{1, 1, 1}));
  EXPECT_EQ(steps("0-60:30", 1), (std::vector<double>{30, 30, 30}));
  EXPECT_EQ(steps("0,4,24", 1), (std::vector<double>{4, 12, 20}));
  EXPECT_EQ(steps("7", 1), (std::vector<double>{0}));
  EXPECT_EQ(steps("0,4", 2), (std::vector<double>{0, 2, 2, 0}));  // A frame that is shown twice stands still.
}

}  // namespace
}  // namespace meniscus
