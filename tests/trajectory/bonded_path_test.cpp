// SPDX-License-Identifier: BSD-3-Clause
// Between frames atoms follow curves, groups turn, and bonds keep their lengths.
#include "core/trajectory/morph.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/scene/frame_run.h"
#include "core/trajectory/prepared_frames.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

/// A trajectory whose atoms follow a formula, in a box.
class Formula : public Trajectory {
 public:
  using Where = std::function<glm::dvec3(double frame, std::size_t atom)>;

  Formula(std::uint64_t frames, std::size_t atoms, Where where, double box = 20.0)
      : Trajectory("made-up", "formula"), where_(std::move(where)), box_(box) {
    atom_count_ = atoms;
    frame_count_ = frames;
  }
  glm::dvec3 at(double frame, std::size_t atom) const { return where_(frame, atom); }
  std::size_t reads = 0;

 private:
  void read_unchecked(std::uint64_t number, Frame& frame) override {
    ++reads;
    frame.positions.clear();
    for (std::size_t n = 0; n < atom_count_; ++n) frame.positions.push_back(where_(double(number), n));
    frame.cell = glm::dmat3(box_);
    frame.time = 5.0 * double(number) * double(number);
  }

  Where where_;
  double box_;
};

glm::dvec3 on_parabola(double frame, std::size_t atom) {
  return {frame * frame * 0.1 + double(atom), 3.0 - frame, 0.05 * frame * (frame - double(atom))};
}

glm::dvec3 on_cubic(double frame, std::size_t atom) {
  return on_parabola(frame, atom) + glm::dvec3(1e-3 * frame * frame * frame, 0.0, 0.0);
}

glm::dvec3 on_line(double frame, std::size_t atom) { return {double(atom), 1.0 - 0.7 * frame, 0.2 * frame}; }

constexpr double kCircleFrames = 24.0;
glm::dvec3 on_circle(double frame, std::size_t) {
  const double angle = 2.0 * std::numbers::pi * frame / kCircleFrames;
  return {5.0 * std::cos(angle), 5.0 * std::sin(angle), 0.0};
}

/// Returns a place between two neighbouring frames of a trajectory.
BetweenFrames between(std::uint64_t from, double share, std::uint64_t frames) {
  BetweenFrames place{{}, from, from + 1, {}, share};
  for (std::uint64_t k = 1; k <= kPathNeighbors; ++k) {
    if (k <= from) place.before.push_back(from - k);
    if (from + 1 + k < frames) place.after.push_back(from + 1 + k);
  }
  return place;
}

TEST(FramesBetween, FollowCubicsExactly) {
  Formula trajectory(16, 3, on_cubic, 1000.0);
  PreparedFrames frames(trajectory, {});
  Frame frame;
  const auto check = [&](const BetweenFrames& place) {
    frames.read_between(place, frame);
    const double step = double(place.to) - double(place.from), there = double(place.from) + step * place.share;
    for (std::size_t a = 0; a < 3; ++a)
      EXPECT_LT(glm::distance(frame.positions[a], trajectory.at(there, a)), 1e-11) << there;
  };
  for (const double share : {0.1, 0.5, 0.75}) {
    check(between(3, share, 16));
    check({{5, 3, 1}, 7, 9, {11, 13, 15}, share});  // Every second frame is used.
    check({{5, 6, 7}, 4, 3, {2, 1, 0}, share});     // The frames run backwards.
  }
  EXPECT_DOUBLE_EQ(*frame.time, 0.25 * 80.0 + 0.75 * 45.0);
}

TEST(FramesBetween, UniformMotionIsUniformToBothEndsOfAnyRun) {
  for (const std::uint64_t count : {2, 3, 4, 7, 12}) {
    Formula trajectory(count, 2, on_line);
    PreparedFrames frames(trajectory, {});
    Frame frame;
    for (std::uint64_t from = 0; from + 1 < count; ++from)
      for (const double share : {0.01, 0.3, 0.5, 0.9}) {
        frames.read_between(between(from, share, count), frame);
        for (std::size_t a = 0; a < 2; ++a)
          EXPECT_LT(glm::distance(frame.positions[a], on_line(double(from) + share, a)), 1e-12) << count << ' ' << from;
      }
  }
}

/// Returns root mean squares of the steps of all atoms from picture to picture, `pictures` of them a frame.
std::vector<double> speeds_of(PreparedFrames& frames, std::uint64_t count, int pictures) {
  std::vector<double> speeds;
  Frame before, frame;
  frames.read(0, before);
  for (std::uint64_t from = 0; from + 1 < count; ++from)
    for (int n = 1; n <= pictures; ++n) {
      if (n < pictures)
        frames.read_between(between(from, double(n) / pictures, count), frame);
      else
        frames.read(from + 1, frame);
      double squares = 0.0;
      for (std::size_t a = 0; a < frame.positions.size(); ++a) {
        const glm::dvec3 step = frame.positions[a] - before.positions[a];
        squares += glm::dot(step, step);
      }
      speeds.push_back(std::sqrt(squares / double(frame.positions.size())));
      before = frame;
    }
  return speeds;
}

TEST(FramesBetween, ACircleIsRoundAndItsSpeedEven) {
  Formula trajectory(40, 1, on_circle);
  PreparedFrames frames(trajectory, {});
  Frame frame;
  for (std::uint64_t from = 3; from < 36; ++from)
    for (const double share : {0.2, 0.5, 0.7}) {
      frames.read_between(between(from, share, 40), frame);
      EXPECT_NEAR(glm::length(frame.positions[0]), 5.0, 1e-3);
    }
  const std::vector<double> speeds = speeds_of(frames, 40, 8);
  for (std::size_t n = 3 * 8; n + 3 * 8 < speeds.size(); ++n)
    EXPECT_NEAR(speeds[n] / (2.0 * 5.0 * std::sin(std::numbers::pi / kCircleFrames / 8.0)), 1.0, 0.01);
}

/// Returns the share by which pictures at one place between frames move more or less than the mean of all.
double pulse_of(const std::vector<double>& speeds, std::size_t pictures) {
  std::vector<double> squares(pictures);
  double all = 0.0;
  const std::size_t first = 4 * pictures, last = speeds.size() - first;
  for (std::size_t n = first; n < last; ++n) {
    squares[n % pictures] += speeds[n] * speeds[n];
    all += speeds[n] * speeds[n] / double(pictures);
  }
  double most = 0.0;
  for (const double square : squares) most = std::max(most, std::abs(std::sqrt(square / all) - 1.0));
  return most;
}

// A path that slows down wherever it turns pulses in pictures of noise, and of steps in random directions.
TEST(FramesBetween, AtomsAreAsFastAtFramesAsHalfway) {
  constexpr std::uint64_t kFrames = 40;
  constexpr std::size_t kAtoms = 1500;
  std::mt19937 random(5);
  std::normal_distribution<double> step;
  std::vector<glm::dvec3> noise(kFrames * kAtoms), walk(kFrames * kAtoms);
  for (std::size_t n = 0; n < noise.size(); ++n) {
    noise[n] = {step(random), step(random), step(random)};
    walk[n] = noise[n] + (n < kAtoms ? glm::dvec3(0.0) : walk[n - kAtoms]);
  }
  for (const std::vector<glm::dvec3>* path : {&noise, &walk}) {
    Formula trajectory(
        kFrames, kAtoms, [&](double frame, std::size_t a) { return (*path)[std::size_t(frame) * kAtoms + a]; }, 1e4);
    for (const std::uint64_t half : {0, 2}) {
      Preparation preparation;
      preparation.smooth_half = half;
      PreparedFrames frames(trajectory, preparation);
      for (const int pictures : {4, 10})
        EXPECT_LT(pulse_of(speeds_of(frames, kFrames, pictures), pictures), 0.05) << half;
    }
  }
}

TEST(FramesBetween, APathEndsWhereTheNextFrameIsDamagedOrJumps) {
  Formula trajectory(12, 3, [](double frame, std::size_t atom) {
    return on_parabola(frame, atom) + glm::dvec3(0.0, frame == 6.0 ? 20.0 : 0.0, frame == 2.0 ? NAN : 0.0);
  });
  Preparation preparation;
  preparation.followed = {0, 1};
  PreparedFrames frames(trajectory, preparation);
  Frame frame, alone;
  frames.read_between(between(4, 0.4, 12), frame);
  frames.read_between({{3}, 4, 5, {}, 0.4}, alone);
  EXPECT_EQ(frame.positions, alone.positions);
  EXPECT_THROW(frames.read_between(between(2, 0.4, 12), frame), InputError);
}

TEST(FramesBetween, ARunReadsEachFrameOnce) {
  Formula trajectory(30, 3, on_line);
  for (const std::uint64_t half : {0, 2}) {
    trajectory.reads = 0;
    Preparation preparation;
    preparation.smooth_half = half;
    preparation.bonds.emplace(3, std::span<const Bond>{}, std::span<const std::uint32_t>{});
    PreparedFrames frames(trajectory, preparation);
    speeds_of(frames, 30, 4);
    EXPECT_EQ(trajectory.reads, 30u) << half;
  }
}

TEST(FramesBetween, JumpsAcrossTheBoxAreRefusedOfAtomsThatAreFollowed) {
  Formula trajectory(8, 3, [](double frame, std::size_t atom) {
    return on_parabola(frame, atom) + glm::dvec3(0.0, frame == 4.0 && atom == 1 ? 20.0 : 0.0, 0.0);
  });
  Preparation preparation;
  preparation.followed = {0, 1};
  PreparedFrames frames(trajectory, preparation);
  Frame frame;
  frames.read_between({{1}, 2, 3, {}, 0.5}, frame);
  try {
    frames.read_between({{2}, 3, 4, {5}, 0.5}, frame);
    FAIL() << "nothing moves across a box";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("atom 2 is 19."), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("whole"), std::string::npos) << error.what();
  }
  preparation.followed = {0, 2};
  PreparedFrames others(trajectory, preparation);
  others.read_between({{2}, 3, 4, {5}, 0.5}, frame);
}

/// Returns two carbons on an axis, with three hydrogens around one of them, turned by an angle, and three fixed ones.
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
  // Atoms without held bonds stay unchanged.
  const BondNetwork none(8, kEthane, {});
  positions = middle;
  BondedPath(none, from, ethane(2.0)).correct(0.5, positions);
  EXPECT_EQ(positions, middle);
}

TEST(FramesBetween, RunsKeepWholeFramesAndMakeEachFrameByItself) {
  test::TemporaryFolder folder;
  std::string models;
  for (int n = 0; n < 10; ++n) {
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
  FrameRun run(molecule, request, Velocities::central);
  EXPECT_EQ(run.numbers().size(), 28u);
  EXPECT_EQ(run.source(7), 2u);
  for (const std::uint64_t whole : {0u, 1u, 5u, 9u}) EXPECT_EQ(run.positions(3 * whole), plain.positions(whole));
  const std::vector<glm::dvec3> fourth = run.positions(4), eighth = run.positions(8);
  // z is a parabola of the number, but for both ends.
  for (std::uint64_t number = 9; number <= 18; ++number)
    EXPECT_NEAR(run.positions(number)[0].z, 0.3 * double(number * number) / 9.0, 1e-3) << number;
  while (const std::optional<RunFrame> frame = run.next()) {
    if (frame->number < 10 || frame->number > 17) continue;
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
