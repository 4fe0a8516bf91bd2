// SPDX-License-Identifier: BSD-3-Clause
// Every pixel of the ray caster has an exact depth: by closed forms, the double twin, or the sphere-tracing oracle.
#include "core/scene/renderers.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string_view>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "core/gpu/egl_context.h"
#include "core/surface/compute_surface.h"
#include "tests/image/ray_caster_twin.h"
#include "tests/support/molecules.h"
#include "tests/support/sphere_tracer.h"

namespace meniscus {
namespace {

using testing::Balls;

/// Returns the depth along a ray, or nothing where the ray misses.
using Depth = std::function<std::optional<double>(const Ray&)>;

constexpr double kDepthTolerance = 1e-3;  // Å
constexpr double kDisplacement = 2e-5;    // Å: at a silhouette the depth may be that of a ray this far aside

struct Agreement {
  int hit = 0;        ///< pixels that show the surface
  int displaced = 0;  ///< pixels that are right only for a ray aside: silhouettes
  int wrong = 0;
  std::string first_wrong;
};

Agreement compare(const Framebuffer& picture, const Camera& camera, const Depth& depth) {
  const ViewBasis basis = view_basis(camera);
  std::atomic<int> hit = 0, displaced = 0, wrong = 0, first_wrong = -1;
  tbb::parallel_for(0, picture.size.x * picture.size.y, [&](int at) {
    const glm::dvec2 pixel(at % picture.size.x + 0.5, at / picture.size.x + 0.5);
    const double z = picture.z[at];
    hit += std::isfinite(z);
    const auto agrees = [&](const glm::dvec3& aside) {
      Ray ray = pixel_ray(camera, picture.size, pixel);
      ray.origin += aside;
      const std::optional<double> expected = depth(ray);
      return expected ? std::abs(*expected - z) < kDepthTolerance : std::isinf(z);
    };
    if (agrees(glm::dvec3(0.0))) return;
    for (const glm::dvec3& aside : {basis.right, -basis.right, basis.up, -basis.up})
      if (agrees(aside * kDisplacement)) {
        ++displaced;
        return;
      }
    ++wrong;
    first_wrong = at;
  });
  Agreement result{hit, displaced, wrong, {}};
  if (wrong > 0)
    result.first_wrong = "pixel " + std::to_string(first_wrong % picture.size.x) + " " +
                         std::to_string(first_wrong / picture.size.x) + " z " + std::to_string(picture.z[first_wrong]);
  return result;
}

void expect_agreement(const Framebuffer& picture, const Camera& camera, const Depth& depth, const std::string& name) {
  const Agreement agreement = compare(picture, camera, depth);
  EXPECT_EQ(agreement.wrong, 0) << name << " " << agreement.first_wrong;
  EXPECT_GT(agreement.hit, 0) << name;
  EXPECT_LE(agreement.displaced, 2 + agreement.hit / 500) << name;
}

Coloring gray(const Surface& surface) {
  Coloring coloring;
  coloring.atom.assign(surface.atoms.size(), glm::vec3(0.7f));
  return coloring;
}

/// Tests run by GL and by the CPU.
class RayCasting : public ::testing::TestWithParam<const char*> {
 protected:
  Framebuffer cast(const Surface& surface, const Camera& camera, glm::ivec2 size) {
    RenderSettings settings;
    settings.size = size;
    settings.aovs = true;
    return renderer_->render(whole_surface(surface, gray(surface)), camera, settings);
  }

  /// Checks both projections against the oracle and, on request, the twin.
  void expect_exact(const Balls& balls, double probe_radius, const std::string& name, glm::ivec2 size, bool twin) {
    const Surface surface = compute_surface_cpu(balls, probe_radius);
    const testing::SphereTracer tracer(balls, probe_radius);
    const testing::RayCasterTwin cpu_twin(surface);
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
      const Camera camera = frame_camera(surface.atoms, static_cast<double>(size.x) / size.y, projection);
      const Framebuffer picture = cast(surface, camera, size);
      expect_agreement(
          picture, camera,
          [&](const Ray& ray) -> std::optional<double> {
            const auto hit = tracer.trace(ray.origin, ray.direction);
            return hit ? std::optional(hit->t) : std::nullopt;
          },
          name + " against the oracle");
      if (!twin) continue;
      expect_agreement(
          picture, camera,
          [&](const Ray& ray) -> std::optional<double> {
            const auto hit = cpu_twin.trace(ray);
            return hit ? std::optional(hit->t) : std::nullopt;
          },
          name + " against the twin");
    }
  }

  EglContext context_;
  std::unique_ptr<StillRenderer> renderer_ =
      std::string_view(GetParam()) == "cpu" ? std::make_unique<StillRenderer>() : make_gl_still_renderer(context_);
};

INSTANTIATE_TEST_SUITE_P(Devices, RayCasting, ::testing::Values("gl", "cpu"),
                         [](const auto& device) { return std::string(device.param); });

TEST_P(RayCasting, OneSphereHasItsClosedForm) {
  const Surface surface = compute_surface_cpu(Balls{{{100.0, -40.0, 7.0}, 1.7}}, 1.4);
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    const Camera camera = frame_camera(surface.atoms, 1.25, projection);
    const Framebuffer picture = cast(surface, camera, {200, 160});
    expect_agreement(
        picture, camera,
        [&](const Ray& ray) -> std::optional<double> {
          const glm::dvec3 v = surface.atoms[0].center - ray.origin;
          const double along = glm::dot(v, ray.direction);
          const glm::dvec3 across = v - ray.direction * along;
          const double room = 1.7 * 1.7 - glm::dot(across, across);
          return room < 0.0 ? std::nullopt : std::optional(along - std::sqrt(room));
        },
        "sphere");
  }
}

TEST_P(RayCasting, TwoAtomsFreeAndSpindle) {
  expect_exact(testing::two_atoms(2.5), 1.4, "free torus", {160, 120}, true);
  expect_exact(testing::two_atoms(5.4), 1.4, "spindle", {160, 120}, true);
  expect_exact(testing::two_atoms(4.0, 1.7, 1.2), 3.0, "large probe", {160, 120}, true);
  expect_exact(testing::two_atoms(2.5), 0.0, "no probe", {160, 120}, true);
}

TEST_P(RayCasting, RaysThatRunAlongSeamsFindNoHole) {
  // A column of pixels lies on the plane of a contact circle, seen edge on: rounding may go either way.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(2.0, 5.4);
  for (int i = 0; i < 60; ++i) {
    const Balls balls = testing::translated(
        testing::rotated(testing::two_atoms(uniform(random), 1.7, 1.3), testing::random_rotation(random)),
        {uniform(random), uniform(random), uniform(random)});
    const Surface surface = compute_surface_cpu(balls, 1.4);
    const testing::RayCasterTwin twin(surface);
    ASSERT_EQ(surface.toroidal.size(), 1u);
    const Plane& plane = surface.planes[surface.convex[0].first_plane];
    const glm::dvec3& center = surface.atoms[surface.convex[0].atom].center;
    const glm::dvec3 seam = center + plane.normal * (plane.offset - glm::dot(plane.normal, center));
    const glm::dvec3 view = surface.toroidal[0].start, up = glm::cross(view, plane.normal);
    const double pixel = 3.0 / 129;
    const glm::dvec3 target = seam + plane.normal * (7.0 * pixel);
    const Camera camera{target - view * 20.0, target, up, Projection::orthographic, 30.0, 3.0};
    expect_agreement(
        cast(surface, camera, {33, 129}), camera,
        [&](const Ray& ray) -> std::optional<double> {
          const auto hit = twin.trace(ray);
          return hit ? std::optional(hit->t) : std::nullopt;
        },
        "seam");
  }
}

TEST_P(RayCasting, DegenerateMolecules) {
  for (const auto& molecule : testing::degenerate_molecules())
    expect_exact(molecule.balls, molecule.probe_radius, molecule.name, {48, 48}, false);
}

TEST_P(RayCasting, RandomGases) {
  for (std::uint32_t n = 0; n < 24; ++n) {
    const testing::GasCase gas = testing::gas_case(n);
    expect_exact(gas.balls, gas.probe_radius, "gas " + std::to_string(n), {40, 40}, false);
  }
}

TEST_P(RayCasting, Proteins) {
  expect_exact(testing::ubiquitin(), 1.4, "1UBQ", {160, 120}, true);
  expect_exact(testing::enterotoxin(), 1.4, "1TII", {160, 120}, false);
}

TEST_P(RayCasting, ManyAtomsInAFewTiles) {
  // Lists have 77,000 patches a tile: software GL cuts loops short after 65,535 steps, which must not show.
  Balls many;
  for (int n = 0; n < 4; ++n) {
    const Balls copy = testing::translated(testing::enterotoxin(), {n % 2 * 90.0, 0.0, n / 2 * 90.0});
    many.insert(many.end(), copy.begin(), copy.end());
  }
  expect_exact(many, 1.4, "four times 1TII", {24, 18}, false);
}

TEST_P(RayCasting, FarFromTheOrigin) {
  expect_exact(testing::translated(testing::ubiquitin(), {1000.0, -1000.0, 500.0}), 1.4, "1UBQ far away", {96, 72},
               false);
}

TEST_P(RayCasting, AnyZoom) {
  const Balls balls = testing::ubiquitin();
  const Surface surface = compute_surface_cpu(balls, 1.4);
  const testing::RayCasterTwin twin(surface);
  const Depth depth = [&](const Ray& ray) -> std::optional<double> {
    const auto hit = twin.trace(ray);
    return hit ? std::optional(hit->t) : std::nullopt;
  };
  for (const double zoom : {10.0, 1e3, 1e5}) {
    Camera camera = frame_camera(surface.atoms, 1.0);
    camera.vertical_fov /= zoom;
    expect_agreement(cast(surface, camera, {64, 64}), camera, depth, "zoom");
    Camera close = camera;  // The camera zooms by walking up to the surface, and a little inside of it.
    const auto hit = twin.trace(pixel_ray(close, {1, 1}, {0.5, 0.5}));
    ASSERT_TRUE(hit);
    close.vertical_fov = 60.0;
    close.position += glm::normalize(close.target - close.position) * (hit->t - 10.0 / zoom);
    expect_agreement(cast(surface, close, {64, 64}), close, depth, "close");
    close.position += glm::normalize(close.target - close.position) * (10.0 / zoom + 0.5);
    expect_agreement(cast(surface, close, {64, 64}), close, depth, "inside");
  }
}

TEST_P(RayCasting, AovsDescribeThePointOfThePixelCentre) {
  const Surface surface = compute_surface_cpu(testing::ubiquitin(), 1.4);
  const testing::RayCasterTwin twin(surface);
  const Camera camera = frame_camera(surface.atoms, 4.0 / 3.0);
  const Framebuffer picture = cast(surface, camera, {128, 96});
  int other_patch = 0, other_atom = 0, hit_count = 0;
  for (int at = 0; at < 128 * 96; ++at) {
    const Ray ray = pixel_ray(camera, picture.size, {at % 128 + 0.5, at / 128 + 0.5});
    if (std::isinf(picture.z[at])) {
      EXPECT_EQ(picture.color[at].w, 0.0f);
      EXPECT_EQ(picture.atom[at], kNone);
      EXPECT_EQ(picture.kind[at], kNone);
      EXPECT_EQ(picture.component[at], kNone);
      EXPECT_EQ(picture.normal[at], glm::vec3(0.0f));
      continue;
    }
    EXPECT_EQ(picture.color[at].w, 1.0f);
    const auto hit = twin.trace(ray);
    if (!hit || std::abs(hit->t - picture.z[at]) > kDepthTolerance) continue;  // Earlier tests cover silhouettes.
    ++hit_count;
    EXPECT_LT(glm::length(glm::dvec3(picture.position[at]) - (ray.origin + ray.direction * hit->t)), 2e-3);
    EXPECT_EQ(picture.component[at], 0u);  // Only the outer component is visible from outside.
    // Either patch may win within slack of a border; their normals agree there.
    if (static_cast<std::uint32_t>(hit->kind) != picture.kind[at])
      ++other_patch;
    else if (hit->atom != picture.atom[at])
      ++other_atom;
    EXPECT_LT(glm::length(glm::dvec3(picture.normal[at]) - hit->normal), 5e-3) << at;
  }
  EXPECT_GT(hit_count, 4000);
  EXPECT_LE(other_patch, 4);
  EXPECT_LE(other_atom, 4);
}

TEST_P(RayCasting, RaysGoOnThroughHiddenAtoms) {
  const Surface surface = compute_surface_cpu(testing::ubiquitin(), 1.4);
  Coloring coloring = gray(surface);
  for (std::uint32_t a = 0; a < surface.atoms.size(); ++a) coloring.hidden.push_back(a % 5 < 2);
  const testing::RayCasterTwin twin(surface, coloring);
  RenderSettings settings;
  settings.size = {128, 96};
  settings.aovs = true;
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    const Camera camera = frame_camera(surface.atoms, 4.0 / 3.0, projection);
    const Framebuffer picture = renderer_->render(whole_surface(surface, coloring), camera, settings);
    const Agreement agreement = compare(picture, camera, [&](const Ray& ray) -> std::optional<double> {
      const auto hit = twin.trace(ray);
      return hit ? std::optional(hit->t) : std::nullopt;
    });
    EXPECT_EQ(agreement.wrong, 0) << agreement.first_wrong;
    EXPECT_GT(agreement.hit, 3000);
    // Every cut through a patch is a silhouette, so that there are more of them than in whole molecules.
    EXPECT_LE(agreement.displaced, agreement.hit / 100);
    int inside = 0;
    for (int at = 0; at < 128 * 96; ++at) {
      if (picture.atom[at] == kNone) continue;
      EXPECT_TRUE(coloring.shows(picture.atom[at])) << at;
      const Ray ray = pixel_ray(camera, picture.size, {at % 128 + 0.5, at / 128 + 0.5});
      inside += glm::dot(glm::dvec3(picture.normal[at]), ray.direction) > 0.1;
      // The back of the surface is lit like its front: nothing is black.
      EXPECT_GT(picture.color[at].x, 0.01f);
    }
    EXPECT_GT(inside, 300);
  }
  coloring.hidden.assign(surface.atoms.size(), true);
  const Framebuffer empty =
      renderer_->render(whole_surface(surface, coloring), frame_camera(surface.atoms, 4.0 / 3.0), settings);
  EXPECT_TRUE(std::ranges::all_of(empty.color, [](const glm::vec4& c) { return c == glm::vec4(0.0f); }));
}

TEST_P(RayCasting, BlocksAndSamplesDoNotChangeThePicture) {
  const Surface surface = compute_surface_cpu(testing::ubiquitin(), 1.4);
  const Camera camera = frame_camera(surface.atoms, 1.3);
  RenderSettings settings;
  settings.size = {130, 101};
  settings.samples = 3;
  settings.aovs = true;
  const Framebuffer whole = renderer_->render(whole_surface(surface, gray(surface)), camera, settings);
  settings.block_edge = 33;
  const Framebuffer blocks = renderer_->render(whole_surface(surface, gray(surface)), camera, settings);
  EXPECT_EQ(whole.z, blocks.z);
  EXPECT_EQ(whole.atom, blocks.atom);
  EXPECT_EQ(whole.color, blocks.color);
  settings.samples = 1;
  const Framebuffer single = renderer_->render(whole_surface(surface, gray(surface)), camera, settings);
  EXPECT_EQ(whole.z, single.z);  // Depth is always taken at the pixel's centre.
  EXPECT_NE(whole.color, single.color);
}

TEST_P(RayCasting, ACavityIsAComponentOfItsOwn) {
  const Surface surface = compute_surface_cpu(testing::c60(), 0.5);
  ASSERT_EQ(surface.components.size(), 2u);
  // Only the cavity is visible from the middle of the cage, only the outer component from outside.
  glm::dvec3 middle(0.0);
  for (const Ball& ball : surface.atoms) middle += ball.center / 60.0;
  Camera camera{middle, middle + glm::dvec3(0.3, 0.2, 1.0), {0, 1, 0}, Projection::perspective, 60.0, 1.0};
  for (const std::uint32_t component : {1u, 0u}) {
    const Framebuffer picture = cast(surface, camera, {32, 32});
    for (const std::uint32_t c : picture.component) EXPECT_TRUE(c == component || (component == 0 && c == kNone));
    EXPECT_EQ(picture.component[16 * 32 + 16], component);
    camera = frame_camera(surface.atoms, 1.0);
  }
}

}  // namespace
}  // namespace meniscus
