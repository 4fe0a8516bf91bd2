// SPDX-License-Identifier: BSD-3-Clause
// Pictures of scenes on the GPU are the same to the bit in any order and with any company; no tile misses a primitive.
#include "core/render/gpu_pack.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <set>
#include <tuple>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/gpu/egl_context.h"
#include "core/gpu/context_description.h"
#include "core/render/gl_renderer.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"
#include "core/color/coloring.h"

namespace meniscus {
namespace {

using ray_cast::Hit;
using ray_cast::Primitive;

constexpr glm::ivec2 kSize{160, 120};

/// A molecule, its colours and its camera.
struct View {
  std::string name;
  Surface surface;
  Coloring coloring;
  PictureFrame frame;
};

View view_of(const std::string& name, const testing::Balls& balls, double probe_radius, Projection projection) {
  View view{name, compute_surface_cpu(balls, probe_radius), {}, {}};
  for (std::size_t a = 0; a < balls.size(); ++a)
    view.coloring.atom.emplace_back(0.1f + 0.02f * (a % 40), 0.5f, 0.9f - 0.02f * (a % 30));
  view.frame = make_picture_frame(view.surface.atoms, frame_camera(view.surface.atoms, 4.0 / 3.0, projection), kSize);
  return view;
}

std::vector<View> views() {
  const testing::Balls balls = testing::ubiquitin();
  std::vector<View> all{view_of("perspective", balls, 1.4, Projection::perspective),
                        view_of("orthographic", balls, 1.4, Projection::orthographic),
                        view_of("large probe", balls, 3.0, Projection::perspective),
                        view_of("lattice", testing::lattice(4, 4, 2, 4.0), 1.4, Projection::orthographic),
                        view_of("nanotube", testing::nanotube(8, 0, 3), 1.4, Projection::perspective)};
  View hidden = view_of("hidden", balls, 1.4, Projection::perspective);
  for (std::size_t a = 0; a < balls.size(); ++a) hidden.coloring.hidden.push_back(a % 5 < 2);
  all.push_back(hidden);
  Camera inside = hidden.frame.camera;
  inside.vertical_fov = 80.0;
  inside.position += 0.9 * (inside.target - inside.position);
  hidden.name = "inside";
  hidden.frame = make_picture_frame(hidden.surface.atoms, inside, kSize);
  all.push_back(hidden);
  return all;
}

/// Hits of a picture, by patch and not by place.
struct Shown {
  std::vector<glm::vec4> picture;
  std::vector<Hit> hits;  ///< with `primitive` replaced by kind and patch index

  bool operator==(const Shown& other) const {
    return picture.size() == other.picture.size() && hits.size() == other.hits.size() &&
           std::memcmp(picture.data(), other.picture.data(), picture.size() * sizeof(glm::vec4)) == 0 &&
           std::memcmp(hits.data(), other.hits.data(), hits.size() * sizeof(Hit)) == 0;
  }
};

class GpuScenes : public ::testing::Test {
 protected:
  Shown cast(const View& view, RayCastPack packed, const std::vector<float>& tile_depths = {}) {
    GpuPack scene;
    upload_scene(packed, view.surface, view.frame, scene);
    upload_coloring(view.coloring, scene);
    scene.tile_depths.upload(tile_depths);
    caster_.cast(scene, view.frame, {{0, 0}, view.frame.size});
    const std::size_t count = static_cast<std::size_t>(kSize.x) * kSize.y;
    Shown shown{caster_.picture().download<glm::vec4>(count), caster_.hits().download<Hit>(count)};
    for (Hit& hit : shown.hits)
      if (hit.primitive != ray_cast::kNoPrimitive) {
        const Primitive& primitive = packed.primitives[hit.primitive];
        hit.primitive = 4 * primitive.patch_index + primitive.kind;
      }
    return shown;
  }

  std::mt19937 random_{17};
  EglContext context_;
  RayCaster caster_;
  GlRenderer renderer_;
};

TEST_F(GpuScenes, OrderDoesNotShow) {
  for (const View& view : views()) {
    RayCastPack packed = pack_scene(view.surface, view.coloring, view.frame);
    const Shown expected = cast(view, packed);
    EXPECT_GT(std::ranges::count_if(expected.picture, [](const glm::vec4& c) { return c.w > 0.0f; }), 2000)
        << view.name;
    for (int n = 0; n < 3; ++n) {
      std::ranges::shuffle(packed.primitives, random_);
      EXPECT_TRUE(cast(view, packed) == expected) << view.name;
    }
  }
}

TEST_F(GpuScenes, NothingStaysOfThePictureBefore) {
  const View view = view_of("close", testing::ubiquitin(), 1.4, Projection::perspective);
  Camera afar = view.frame.camera;
  afar.vertical_fov *= 3.0;
  View small = view;
  small.frame = make_picture_frame(view.surface.atoms, afar, kSize);
  cast(view, pack_scene(view.surface, view.coloring, view.frame));
  const Shown shown = cast(small, pack_scene(view.surface, view.coloring, small.frame));
  int nothing = 0;
  for (std::size_t at = 0; at < shown.hits.size(); ++at) {
    const bool hit = shown.hits[at].primitive != ray_cast::kNoPrimitive;
    EXPECT_EQ(shown.picture[at].w, hit ? 1.0f : 0.0f) << at;
    EXPECT_EQ(hit, shown.hits[at].atom != ray_cast::kNoPrimitive) << at;
    nothing += !hit;
  }
  EXPECT_GT(nothing, 12000);
}

TEST_F(GpuScenes, HiddenCompanyDoesNotShow) {
  for (const View& view : views()) {
    const RayCastPack packed = pack_scene(view.surface, view.coloring, view.frame);
    const Shown expected = cast(view, packed);
    std::set<std::uint32_t> shown;
    for (const Hit& hit : expected.hits) shown.insert(hit.primitive);
    for (const double kept : {0.0, 0.3, 0.8}) {
      RayCastPack fewer = packed;
      std::erase_if(fewer.primitives, [&](const Primitive& p) {
        return !shown.contains(4 * p.patch_index + p.kind) && std::bernoulli_distribution(1.0 - kept)(random_);
      });
      EXPECT_LT(fewer.primitives.size(), packed.primitives.size());
      std::ranges::shuffle(fewer.primitives, random_);
      EXPECT_TRUE(cast(view, fewer) == expected) << view.name << ", kept " << kept;
    }
  }
}

TEST_F(GpuScenes, TwinsAreToldApartByTheirKeys) {
  for (const View& view : views()) {
    RayCastPack packed = pack_scene(view.surface, view.coloring, view.frame);
    std::ranges::for_each(packed.primitives, [](Primitive& p) { p.tie_key = p.tie_key / 2 + 1; });
    const Shown expected = cast(view, packed);
    std::vector<Primitive> twins = packed.primitives;
    for (Primitive& twin : twins) {
      twin.patch_index += 1000000;
      ++twin.tie_key;
    }
    packed.primitives.insert(packed.primitives.end(), twins.begin(), twins.end());
    for (int n = 0; n < 3; ++n) {
      std::ranges::shuffle(packed.primitives, random_);
      EXPECT_TRUE(cast(view, packed) == expected) << view.name;
    }
  }
}

TEST_F(GpuScenes, TieKeysNamePatches) {
  for (const View& view : views()) {
    std::set<std::tuple<std::uint32_t, std::uint32_t>> keys;
    const RayCastPack packed = pack_scene(view.surface, view.coloring, view.frame);
    for (const Primitive& p : packed.primitives) keys.emplace(p.kind, p.tie_key);
    EXPECT_EQ(keys.size(), packed.primitives.size()) << view.name;
  }
}

TEST_F(GpuScenes, TileDepthsLeaveOutOnlyWhatIsBehind) {
  for (const View& view : views()) {
    const RayCastPack packed = pack_scene(view.surface, view.coloring, view.frame);
    const Shown expected = cast(view, packed);
    const glm::ivec2 tiles = (kSize + kTileEdge - 1) / kTileEdge;
    std::vector<float> depths(static_cast<std::size_t>(tiles.x) * tiles.y, 0.0f);
    for (int y = 0; y < kSize.y; ++y)
      for (int x = 0; x < kSize.x; ++x) {
        const Hit& hit = expected.hits[static_cast<std::size_t>(y) * kSize.x + x];
        const Ray ray = pixel_ray(view.frame.camera, kSize, {x + 0.5, y + 0.5});
        const double depth = hit.t + view.frame.eye_distance / glm::dot(ray.direction, view.frame.basis.forward);
        float& tile = depths[static_cast<std::size_t>(y / kTileEdge) * tiles.x + x / kTileEdge];
        tile = std::max(tile, hit.primitive == ray_cast::kNoPrimitive ? 1e30f : static_cast<float>(depth + 1e-3));
      }
    EXPECT_TRUE(cast(view, packed, depths) == expected) << view.name;
    std::ranges::fill(depths, 0.0f);  // A wrong bound removes everything that begins in front of the camera.
    EXPECT_FALSE(cast(view, packed, depths) == expected) << view.name;
  }
}

/// Returns whether a ray through some place of the tile comes to a point of the ball in front of the eye.
bool tile_sees(const PictureFrame& frame, glm::ivec2 tile, const glm::dvec3& center, double radius) {
  for (int n = 0; n < 81; ++n) {
    const glm::dvec2 pixel = (glm::dvec2(tile) + glm::dvec2(n % 9, n / 9) / 8.0) * static_cast<double>(kTileEdge);
    const Ray ray = pixel_ray(frame.camera, frame.size, pixel);
    const glm::dvec3 v = center - ray.origin;
    const double along = glm::dot(v, ray.direction);
    const double room = radius * radius - glm::dot(v - ray.direction * along, v - ray.direction * along);
    if (room > 0.0 && along + std::sqrt(room) > 0.0) return true;
  }
  return false;
}

TEST_F(GpuScenes, NoTileMissesABound) {
  ProgramCache programs;
  TileLists lists(programs);
  int seen = 0, listed = 0;
  for (int n = 0; n < 40; ++n) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto vector = [&] { return glm::dvec3(uniform(random_), uniform(random_), uniform(random_)); };
    PictureFrame frame;
    const double zoom = std::pow(10.0, 2.0 + 2.0 * uniform(random_));
    frame.camera = {vector() * 60.0, vector() * 10.0, {0, 1, 0}, Projection::perspective, 100.0 / zoom, 100.0 / zoom};
    if (n % 3 == 0) frame.camera.projection = Projection::orthographic;
    frame.basis = view_basis(frame.camera);
    frame.size = {200, 150};
    frame.eye_distance = 1.0 + 30.0 * std::abs(uniform(random_));
    frame.pivot = frame.camera.position + frame.basis.forward * frame.eye_distance;
    frame.pixel_size = 2.0 * half_extent(frame.camera, 1.0).y / frame.size.y *
                       (frame.camera.projection == Projection::perspective ? frame.eye_distance : 1.0);
    std::vector<Primitive> primitives(300);
    for (Primitive& p : primitives) {  // Balls are around the eye, around the axis close to it, or anywhere.
      const int where = std::uniform_int_distribution<int>(0, 2)(random_);
      const double along = 60.0 * uniform(random_), radius = std::pow(10.0, 2.0 * uniform(random_)) / (where ? 10 : 1);
      glm::dvec3 center = vector() * 60.0;
      if (where == 1) center = frame.camera.position + vector() * radius;
      if (where == 2) center = frame.camera.position + frame.basis.forward * along + vector() * radius * 1.5;
      p.bound = glm::vec4(glm::vec3(center - frame.pivot), static_cast<float>(radius + 1e-4));
      p.kind = static_cast<std::uint32_t>(where);
      p.nearest = static_cast<float>(glm::length(center - frame.camera.position) - radius);
    }
    GpuPack scene;
    scene.primitives.upload(primitives);
    scene.counters.upload(std::vector<std::uint32_t>{scene.primitives.count()});
    scene.last_depth = 80.0f;
    const PictureBlock block{{n % 2 ? kTileEdge : 0, 0}, {100, 150}};
    lists.build(scene, frame, block);
    const std::size_t slots = static_cast<std::size_t>(lists.tiles().x) * lists.tiles().y * kSlotsPerTile;
    const auto ends = lists.slot_ends().download<std::uint32_t>(slots);
    const auto entries = lists.entries().download<std::uint32_t>(ends.back());
    for (std::size_t tile = 0; tile < slots / kSlotsPerTile; ++tile) {
      const std::uint32_t begin = tile ? ends[tile * kSlotsPerTile - 1] : 0, end = ends[(tile + 1) * kSlotsPerTile - 1];
      const std::set<std::uint32_t> list(entries.begin() + begin, entries.begin() + end);
      EXPECT_EQ(list.size(), end - begin) << "one is listed twice";
      listed += static_cast<int>(list.size());
      const glm::ivec2 place(tile % lists.tiles().x, tile / lists.tiles().x);
      for (std::uint32_t i = 0; i < primitives.size(); ++i) {
        const glm::vec4& bound = primitives[i].bound;
        if (!tile_sees(frame, place + block.origin / kTileEdge, frame.pivot + glm::dvec3(bound), bound.w - 1e-4))
          continue;
        ++seen;
        EXPECT_TRUE(list.contains(i)) << n << " tile " << tile << " primitive " << i;
      }
    }
  }
  EXPECT_GT(seen, 100000);
  EXPECT_LT(listed, 2 * seen) << "the lists are much longer than they need be";
}

TEST_F(GpuScenes, ListsTooLongForAKernelAreMadeOfSmallerBlocks) {
  // Every tile of a picture of one place lists every ball.
  const int edge = 1024, tile_count = (edge / kTileEdge) * (edge / kTileEdge);
  const std::size_t limit = query_gpu_limits().storage_block_bytes;
  // Filling blocks of gigabytes takes more memory and time than a test has; the halving is the same on any driver.
  if (limit > (1u << 28)) GTEST_SKIP() << "this driver's blocks hold any list";
  const int count = static_cast<int>(limit / (sizeof(std::uint32_t) * tile_count)) + 2;
  testing::Balls balls;
  for (int n = 0; n < count; ++n) balls.push_back({{0.0, 0.0, -5.0 * n}, 1.7});
  const Surface surface = compute_surface_cpu(balls, 0.0);
  Coloring coloring;
  coloring.atom.assign(balls.size(), glm::vec3(0.7f));
  const Camera camera{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, Projection::orthographic, 30.0, 0.5};
  RenderSettings settings;
  settings.size = {edge, edge};
  const Framebuffer whole = renderer_.render(surface, coloring, camera, settings);
  EXPECT_EQ(whole.color[0].w, 1.0f);
  settings.block_edge = 128;
  EXPECT_TRUE(whole.color == renderer_.render(surface, coloring, camera, settings).color);
  GpuPack scene;
  PictureFrame frame = make_picture_frame(surface.atoms, camera, settings.size);
  upload_scene(pack_scene(surface, coloring, frame), surface, frame, scene);
  upload_coloring(coloring, scene);
  EXPECT_THROW(caster_.cast(scene, frame, {{0, 0}, frame.size}), CapacityError)
      << "the test does not see what it is about";
}

}  // namespace
}  // namespace meniscus
