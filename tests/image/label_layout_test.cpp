// SPDX-License-Identifier: BSD-3-Clause
// Labels and their lines never meet each other or earlier writing; the test finds that by other means than the layout.
#include "core/render/label_layout.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace meniscus {
namespace {

struct Line {
  glm::dvec2 from, to;
};

/// Returns whether two lines cross.
bool touch(const Line& a, const Line& b) {
  const auto side = [](const Line& line, const glm::dvec2& point) {
    const glm::dvec2 along = line.to - line.from, to = point - line.from;
    return along.x * to.y - along.y * to.x;
  };
  return (side(a, b.from) > 0.0) != (side(a, b.to) > 0.0) && (side(b, a.from) > 0.0) != (side(b, a.to) > 0.0);
}

bool touch(const Line& line, const PixelBox& box) {
  constexpr int kSteps = 400;
  for (int n = 0; n <= kSteps; ++n) {
    const glm::dvec2 at = glm::mix(line.from, line.to, static_cast<double>(n) / kSteps);
    if (at.x > box.low.x && at.y > box.low.y && at.x < box.high.x && at.y < box.high.y) return true;
  }
  return false;
}

int crossings(std::span<const UnplacedLabel> labels, std::span<const PixelBox> boxes, const LabelGround& ground) {
  int count = 0;
  std::vector<Line> lines;
  for (std::size_t n = 0; n < labels.size(); ++n)
    lines.push_back({leader_start(boxes[n], labels[n], ground), labels[n].anchor});
  for (std::size_t a = 0; a < labels.size(); ++a) {
    for (const PixelBox& taken : ground.taken) count += boxes[a].meets(taken) + touch(lines[a], taken);
    count += boxes[a].low.x < ground.room.low.x || boxes[a].high.x > ground.room.high.x;
    count += boxes[a].low.y < ground.room.low.y || boxes[a].high.y > ground.room.high.y;
    for (std::size_t b = 0; b < labels.size(); ++b) {
      if (a != b) count += boxes[a].meets(boxes[b]) + touch(lines[a], boxes[b]);
      if (a < b && labels[a].anchor != labels[b].anchor) count += touch(lines[a], lines[b]);
      const glm::dvec2 anchor = labels[b].anchor;
      count += glm::clamp(anchor, glm::dvec2(boxes[a].low), glm::dvec2(boxes[a].high)) == anchor;
    }
  }
  return count;
}

LabelGround ground_of(glm::ivec2 size) {
  LabelGround ground;
  ground.room = {glm::ivec2(10), size - 10};
  ground.taken = {{{30, size.y - 80}, {200, size.y - 30}}, {{size.x - 300, size.y - 150}, {size.x - 30, size.y - 30}}};
  ground.gap = 12.0;
  ground.dot = 4.0;
  return ground;
}

TEST(LabelLayout, NothingCrossesOrOverlapsWhereverTheAnchorsAre) {
  std::mt19937 random(7);
  const glm::ivec2 size(1280, 960);
  const LabelGround ground = ground_of(size);
  int placed = 0, all = 0;
  for (int molecule = 0; molecule < 60; ++molecule) {
    // Anchors are all over the picture, near its middle, or in a few heaps.
    const double spread = molecule % 3 == 0 ? 0.45 : molecule % 3 == 1 ? 0.25 : 0.06;
    std::vector<UnplacedLabel> labels;
    const int count = 2 + molecule % 20;
    glm::dvec2 heap(0.5);
    std::uniform_real_distribution<double> place(-spread, spread), where(0.25, 0.75);
    for (int n = 0; n < count; ++n) {
      if (molecule % 3 == 2 && n % 6 == 0) heap = {where(random), where(random)};
      const glm::dvec2 at = (heap + glm::dvec2(place(random), place(random))) * glm::dvec2(size);
      const auto within = [&](const PixelBox& box) { return touch({at, at}, box.grown(20)); };
      if (std::ranges::any_of(ground.taken, within)) continue;
      labels.push_back({at, {60 + static_cast<int>(random() % 120), 47}});
    }
    ++all;
    const auto boxes = place_labels(labels, ground);
    if (!boxes) continue;
    ++placed;
    EXPECT_EQ(crossings(labels, *boxes, ground), 0) << molecule;
    EXPECT_EQ(count_meetings(labels, *boxes, ground), 0) << molecule;
  }
  EXPECT_EQ(placed, all);
}

TEST(LabelLayout, LabelsOfOnePlaceStandApart) {
  const LabelGround ground = ground_of({800, 600});
  const std::vector<UnplacedLabel> labels(5, {{400.0, 300.0}, {90, 30}});
  const auto boxes = place_labels(labels, ground);
  ASSERT_TRUE(boxes);
  EXPECT_EQ(crossings(labels, *boxes, ground), 0);
}

TEST(LabelLayout, TheyPreferWhereTheMoleculeIsNot) {
  LabelGround ground = ground_of({800, 600});
  ground.covered = [](const PixelBox& box) { return box.low.x < 500 ? 1.0 : 0.0; };
  const std::vector<UnplacedLabel> labels{{{450.0, 300.0}, {90, 30}}};
  const auto boxes = place_labels(labels, ground);
  ASSERT_TRUE(boxes);
  EXPECT_GE(boxes->front().low.x, 500);
}

TEST(LabelLayout, WhatHasNoRoomIsNotPlaced) {
  const LabelGround ground = ground_of({400, 300});
  const std::vector<UnplacedLabel> labels(60, {{200.0, 100.0}, {90, 30}});
  EXPECT_FALSE(place_labels(labels, ground));
  EXPECT_FALSE(place_labels(std::vector<UnplacedLabel>{{{200.0, 100.0}, {900, 30}}}, ground));
}

}  // namespace
}  // namespace meniscus
