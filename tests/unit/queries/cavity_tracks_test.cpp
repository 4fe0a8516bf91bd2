// SPDX-License-Identifier: BSD-3-Clause
// Cavities of cages, followed from one frame to the next.
#include "core/queries/cavity_tracks.h"

#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

/// Makes a cavity with probes at these places of the x axis.
Cavity cavity(std::vector<double> places, std::vector<std::uint32_t> atoms = {}) {
  Cavity result{1.0, 1.0, std::move(atoms), {}};
  for (const double x : places) result.probes.emplace_back(x, 0.0, 0.0);
  return result;
}

/// Returns the fates of cavities in the form "1 born, 2 split 1 -> #0".
std::string told(const std::vector<CavityStep>& steps) {
  std::string text;
  for (const CavityStep& step : steps) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", step.id, event_word(step.event));
    if (step.other) text += fmt::format(" {}", *step.other);
    if (step.cavity != kNone) text += fmt::format(" #{}", step.cavity);
  }
  return text;
}

TEST(CavityTracks, ACageHasOne) {
  Balls balls = c60();
  const Surface surface = compute_surface_cpu(balls, kWater);
  const std::vector<Cavity> cavities = cavities_of(surface);
  ASSERT_EQ(cavities.size(), 1u);
  EXPECT_EQ(cavities[0].atoms.size(), 60u);
  EXPECT_GE(cavities[0].probes.size(), 12u);
  EXPECT_LT(glm::length(cavities[0].middle()), 1e-6);
  for (const glm::dvec3& probe : cavities[0].probes) EXPECT_LT(glm::length(probe), 1.0);
  ASSERT_EQ(surface.components.size(), 2u);
  EXPECT_EQ(cavities[0].area, surface.components[1].area);
  EXPECT_EQ(cavities[0].volume, -surface.components[1].volume);
  EXPECT_GT(cavities[0].volume, 4.18879 * kWater * kWater * kWater);  // A probe fits.
  EXPECT_TRUE(cavities_of(compute_surface_cpu(ring(6, 1.4), kWater)).empty());
}

TEST(CavityTracks, TwoCagesSwapPlacesInTheTableButNotTheirNumbers) {
  const Balls small = c60(1.45), large = translated(c60(1.60), {20, 0, 0});
  const auto surface_of = [&](double growth) {
    Balls both = scaled(small, growth);
    for (Ball& ball : both) ball.radius = kCarbon;
    both.insert(both.end(), large.begin(), large.end());
    return compute_surface_cpu(both, kWater);
  };
  CavityTracks tracks(kWater);
  EXPECT_EQ(told(tracks.follow(cavities_of(surface_of(1.0)))), "1 born #0, 2 born #1");  // The larger one comes first.
  EXPECT_EQ(told(tracks.follow(cavities_of(surface_of(1.25)))), "1 kept #1, 2 kept #0");
  EXPECT_EQ(told(tracks.follow(cavities_of(surface_of(0.85)))), "1 kept #0, 2 closed");  // No probe fits any more.
  EXPECT_EQ(told(tracks.follow(cavities_of(surface_of(1.0)))), "1 kept #0, 3 born #1");
}

TEST(CavityTracks, BirthEndSplitAndMerger) {
  CavityTracks tracks(1.0);
  EXPECT_EQ(told(tracks.follow({})), "");
  EXPECT_EQ(told(tracks.follow({cavity({0}), cavity({10})})), "1 born #0, 2 born #1");
  EXPECT_EQ(told(tracks.follow({cavity({11.9}), cavity({1.9})})), "1 kept #1, 2 kept #0");
  EXPECT_EQ(told(tracks.follow({cavity({11.9}), cavity({3.9})})), "1 closed, 2 kept #0, 3 born #1");  // a diameter away
  EXPECT_EQ(told(tracks.follow({cavity({3.9, 6, 8, 10, 11.9})})),
            "2 kept #0, 3 merged 2");  // equals: the nearest, then the first
  EXPECT_EQ(told(tracks.follow({cavity({4.0}), cavity({11.9})})), "2 kept #1, 4 split 2 #0");
  EXPECT_EQ(told(tracks.follow({})), "2 closed, 4 closed");
}

TEST(CavityTracks, MostAtomsInCommonGoFirst) {
  CavityTracks tracks(1.0);
  tracks.follow({cavity({0}, {1, 2, 3, 4})});
  // The second is nearer, the first has more of its atoms.
  EXPECT_EQ(told(tracks.follow({cavity({1.5}, {2, 3, 4, 9}), cavity({0.1}, {1, 7, 8})})), "1 kept #0, 2 split 1 #1");
}

}  // namespace
}  // namespace meniscus::testing
