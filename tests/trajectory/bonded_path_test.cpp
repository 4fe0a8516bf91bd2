// SPDX-License-Identifier: BSD-3-Clause
// Between frames atoms follow curves, groups turn, and bonds keep their lengths.
#include "core/trajectory/bonded_path.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/scene/frame_run.h"
#include "core/trajectory/prepared_frames.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

/// Atoms on parabolas, in a box of 20 Å.
class Parabolas : public Trajectory {
 public:
  Parabolas() : Trajectory("made-up", "formula") {
    atom_count_ = 3;
    frame_count_ = 8;
  }
  static glm::dvec3 at(double frame, std::size_t atom) {
    return {frame * frame * 0.1 + double(atom), 3.0 - frame, 0.05 * frame * (frame - double(atom))};
  }
  bool jumps = false;

 private:
  void read_unchecked(std::uint64_t number, Frame& frame) override {
    frame.positions.clear();
    for (std::size_t n = 0; n < atom_count_; ++n) frame.positions.push_back(at(double(number), n));
    if (jumps && number == 4) frame.positions[1].y += 20.0;
    frame.cell = glm::dmat3(20.0);
    frame.time = 5.0 * double(number) * double(number);
  }
};

TEST(FramesBetween, FollowParabolasExactlyToBothEnds) {
  Parabolas trajectory;
  PreparedFrames frames(trajectory, {});
  Frame frame;
  const auto check = [&](const BetweenFrames& place) {
    frames.read_between(place, frame);
    const double step = double(place.to) - double(place.from), there = double(place.from) + step * place.share;
    for (std::size_t a = 0; a < 3; ++a)
      EXPECT_LT(glm::distance(frame.positions[a], Parabolas::at(there, a)), 1e-12) << there;
  };
  for (const double share : {0.1, 0.5, 0.75}) {
    check({2, 3, 4, 5, share});
    check({1, 3, 5, 7, share});  // every second frame
    check({{}, 0, 1, 2, share});
    check({5, 6, 7, {}, share});
    check({5, 4, 3, 2, share});  // backwards
  }
  EXPECT_DOUBLE_EQ(*frame.time, 0.25 * 80.0 + 0.75 * 45.0);
  frames.read_between({{}, 2, 6, {}, 0.25}, frame);  // alone it is a line
  EXPECT_LT(glm::distance(frame.positions[1], 0.75 * Parabolas::at(2, 1) + 0.25 * Parabolas::at(6, 1)), 1e-12);
}

TEST(FramesBetween, JumpsAcrossTheBoxAreRefusedOfAtomsThatAreFollowed) {
  Parabolas trajectory;
  trajectory.jumps = true;
  Preparation preparation;
  preparation.followed = {0, 1};
  PreparedFrames frames(trajectory, preparation);
  Frame frame;
  frames.read_between({1, 2, 3, {}, 0.5}, frame);
  try {
    frames.read_between({2, 3, 4, 5, 0.5}, frame);
    FAIL() << "nothing moves across a box";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("atom 2 is 19."), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("whole"), std::string::npos) << error.what();
  }
  preparation.followed = {0, 2};
  PreparedFrames others(trajectory, preparation);
  others.read_between({2, 3, 4, 5, 0.5}, frame);
}

/// Ethane-like: two carbons on an axis, three hydrogens around one of them, turned by an angle, and three that stay.
std::vector<glm::dvec3> ethane(double angle) {
  std::vector<glm::dvec3> positions{{0, 0, 0}, {0, 0, 1.5}};
  for (int n = 0; n < 6; ++n) {
    const double around = 2.0 * std::numbers::pi * (n % 3) / 3.0 + (n < 3 ? angle : 0.5);
    positions.emplace_back(std::cos(around), std::sin(around), n < 3 ? -0.4 : 1.9);
  }
  return positions;
}
constexpr Bond kEthane[] = {{0, 1}, {0, 2}, {3, 0}, {0, 4}, {1, 5}, {1, 6}, {7, 1}};
constexpr std::uint32_t kAll[] = {0, 1, 2, 3, 4, 5, 6, 7};

TEST(BondedPaths, AGroupTurnsEvenlyAndKeepsItsShape) {
  const BondNetwork network(8, kEthane, kAll);
  EXPECT_EQ(network.bonds().size(), 7u);
  EXPECT_EQ(network.angles().size(), 12u);
  for (const double angle : {0.3, 2.0, 2.9, -2.9}) {
    const std::vector<glm::dvec3> from = ethane(0.0), to = ethane(angle);
    const BondedPath path(network, from, to);
    for (const double share : {0.02, 0.25, 0.5, 0.9}) {
      std::vector<glm::dvec3> positions(8);
      for (std::size_t a = 0; a < 8; ++a) positions[a] = (1.0 - share) * from[a] + share * to[a];
      path.correct(share, positions);
      const std::vector<glm::dvec3> wanted = ethane(share * angle);
      for (const auto& [a, b] : kEthane)
        EXPECT_NEAR(glm::distance(positions[a], positions[b]), glm::distance(from[a], from[b]), 0.01);
      for (std::size_t a = 0; a < 8; ++a)
        EXPECT_LT(glm::distance(positions[a], wanted[a]), 0.12) << angle << ' ' << share;
    }
  }
}

TEST(BondedPaths, WhatHasItsPlaceStaysThere) {
  const BondNetwork network(8, kEthane, kAll);
  const std::vector<glm::dvec3> from = ethane(0.0);
  std::vector<glm::dvec3> to = from, middle = from;
  for (glm::dvec3& x : to) x += glm::dvec3(1.0, 2.0, -0.5);
  for (glm::dvec3& x : middle) x += 0.5 * glm::dvec3(1.0, 2.0, -0.5);
  std::vector<glm::dvec3> positions = middle;
  BondedPath(network, from, to).correct(0.5, positions);
  for (std::size_t a = 0; a < 8; ++a) EXPECT_LT(glm::distance(positions[a], middle[a]), 1e-9);
  // Atoms that are not held are left alone.
  const BondNetwork none(8, kEthane, {});
  positions = middle;
  BondedPath(none, from, ethane(2.0)).correct(0.5, positions);
  EXPECT_EQ(positions, middle);
}

TEST(FramesBetween, RunsKeepWholeFramesAndMakeEachFrameByItself) {
  test::TemporaryFolder folder;
  std::string models;
  for (int n = 0; n < 4; ++n) {
    models += "MODEL\n";
    const std::vector<glm::dvec3> atoms = ethane(0.9 * n);
    for (std::size_t a = 0; a < 2; ++a) {
      char line[100];
      std::snprintf(line, sizeof line, "ATOM  %5zu  C%zu  LIG A   1    %8.3f%8.3f%8.3f  1.00  0.00           C\n",
                    a + 1, a + 1, atoms[a + 2].x, atoms[a + 2].y, 3.0 * double(a) + 0.3 * n * n);
      models += line;
    }
    models += "ENDMDL\n";
  }
  MoleculeRequest molecule;
  molecule.file = folder.file("run.pdb", models);
  RunRequest request;
  request.frames = "all";
  FrameRun plain(molecule, request);
  request.interpolate = 3;
  FrameRun run(molecule, request, true);
  EXPECT_EQ(run.numbers(), (std::vector<std::uint64_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(run.source(7), 2u);
  for (const std::uint64_t whole : {0u, 1u, 2u, 3u}) EXPECT_EQ(run.positions(3 * whole), plain.positions(whole));
  const std::vector<glm::dvec3> fourth = run.positions(4), eighth = run.positions(8);
  // z is a parabola of the number.
  for (const std::uint64_t number : run.numbers())
    EXPECT_NEAR(run.positions(number)[0].z, 0.3 * double(number * number) / 9.0, 1e-3) << number;
  while (const std::optional<RunFrame> frame = run.next()) {
    if (frame->number == 0 || frame->number >= 9) continue;
    EXPECT_NEAR(frame->velocities[1].z, 0.6 * double(frame->number) / 9.0, 1e-3) << frame->number;
  }
  request.only = "8,4";
  FrameRun share(molecule, request);
  EXPECT_EQ(share.at(8).atoms[1].position, eighth[1]);
  EXPECT_EQ(share.at(4).atoms[0].position, fourth[0]);
  request.only.clear();
  request.frames = "3,0";
  FrameRun two(molecule, request);
  EXPECT_EQ(two.numbers(), (std::vector<std::uint64_t>{9, 10, 11, 0}));
  EXPECT_NEAR(two.positions(10)[0].z, 1.8, 1e-9);
  request.frames = "1,2,1";
  EXPECT_THROW(FrameRun(molecule, request), RequestError);
}

}  // namespace
}  // namespace meniscus
