// SPDX-License-Identifier: BSD-3-Clause
// Pictures of several objects, of copies and of parts equal pictures of the whole.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/gpu/egl_context.h"
#include "core/queries/copies.h"
#include "core/queries/surface_object.h"
#include "core/queries/surface_parts.h"
#include "core/render/gl_renderer.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"

namespace meniscus {
namespace {

using testing::Balls;
using testing::kWater;

constexpr glm::ivec2 kSize{200, 150};
constexpr double kDepth = 1e-3;  // Å

SurfaceObject object_of(const Balls& balls, double probe_radius, std::uint32_t first_atom) {
  SurfaceObject object;
  object.surface = compute_surface_cpu(balls, probe_radius);
  object.coloring.atom.assign(balls.size(), glm::vec3(0.7f));
  object.atom.resize(balls.size());
  std::iota(object.atom.begin(), object.atom.end(), first_atom);
  return object;
}

class Pictures : public ::testing::Test {
 protected:
  Framebuffer cast(const Surface& surface, const Camera& camera) {
    Coloring coloring;
    coloring.atom.assign(surface.atoms.size(), glm::vec3(0.7f));
    RenderSettings settings;
    settings.size = kSize;
    settings.aovs = true;
    return renderer_.render(surface, coloring, camera, settings);
  }

  EglContext context_;
  GlRenderer renderer_;
};

// Counts pixels whose depth differs: silhouettes may, by the rounding of one ray.
std::size_t different_pixels(const std::vector<float>& a, const std::vector<float>& b) {
  std::size_t count = 0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    const bool hit = std::isfinite(a[n]);
    count += hit != std::isfinite(b[n]) || (hit && std::abs(a[n] - b[n]) > kDepth);
  }
  return count;
}

TEST_F(Pictures, MergedObjectsAndCopiesLookLikeOneComputation) {
  std::mt19937 random(7);
  const RigidMotion motion{testing::random_rotation(random), {45.0, 8.0, -4.0}};
  const Balls first = testing::ubiquitin(), second = testing::translated(testing::c60(), {0.0, 40.0, 0.0});
  Balls all = first;
  for (const Ball& ball : first) all.push_back({motion(ball.center), ball.radius});
  all.insert(all.end(), second.begin(), second.end());

  std::vector<SurfaceObject> objects{object_of(first, kWater, 0),
                                     object_of(second, kWater, static_cast<std::uint32_t>(first.size()))};
  objects[0].copies.push_back(motion);
  const SurfaceObject whole = merged(std::move(objects));
  const Camera camera = frame_camera(std::span<const Ball>(all), double(kSize.x) / kSize.y);
  const Framebuffer expected = cast(compute_surface_cpu(all, kWater), camera), picture = cast(whole.surface, camera);
  EXPECT_LE(different_pixels(picture.z, expected.z), 5u);
  std::size_t hits = 0, other_atom = 0;
  for (std::size_t n = 0; n < picture.atom.size(); ++n) {
    if (picture.atom[n] == kNone) continue;
    ++hits;
    other_atom += picture.atom[n] != expected.atom[n];
  }
  EXPECT_GT(hits, 1000u);
  EXPECT_LE(other_atom, 5u);
}

// The nearest points in pictures of single components give the whole picture: no patch of a part shows other parts'
// points, none lacks anything.
TEST_F(Pictures, PartsTogetherLookLikeTheWhole) {
  std::vector<testing::NamedBalls> molecules{{"ubiquitin", testing::ubiquitin()},
                                             {"c60", testing::c60()},
                                             {"spindle", testing::two_atoms(5.8)},
                                             {"row", testing::collinear(4, 5.6)}};
  for (std::uint32_t n = 0; n < 40; ++n) {
    const testing::GasCase gas = testing::gas_case(n);
    if (gas.probe_radius > 0) molecules.push_back({"gas " + std::to_string(n), gas.balls, gas.probe_radius});
  }
  std::size_t parts = 0;
  for (const testing::NamedBalls& molecule : molecules) {
    SCOPED_TRACE(molecule.name);
    const Surface whole = compute_surface_cpu(molecule.balls, molecule.probe_radius);
    if (whole.components.size() < 2 || whole.components.size() > 8) continue;
    const Camera camera = frame_camera(whole.atoms, double(kSize.x) / kSize.y);
    const Framebuffer expected = cast(whole, camera);
    std::vector<float> nearest(expected.z.size(), std::numeric_limits<float>::infinity());
    for (std::size_t c = 0; c < whole.components.size(); ++c) {
      std::vector<bool> keep(whole.components.size(), false);
      keep[c] = true;
      const Framebuffer picture = cast(part_of(whole, keep).surface, camera);
      std::size_t strange = 0;
      for (std::size_t n = 0; n < nearest.size(); ++n) {
        nearest[n] = std::min(nearest[n], picture.z[n]);
        // The part's picture shows this component wherever the whole picture does.
        strange += expected.component[n] == c && std::abs(picture.z[n] - expected.z[n]) > kDepth;
      }
      EXPECT_LE(strange, 3u) << "component " << c;
      ++parts;
    }
    EXPECT_LE(different_pixels(nearest, expected.z), 3u);
  }
  EXPECT_GT(parts, 30u);
}

}  // namespace
}  // namespace meniscus
