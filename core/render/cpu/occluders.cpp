// SPDX-License-Identifier: BSD-3-Clause
// Packs occluders into trees of boxes, and casts rays from points towards the sky.
#include "core/render/cpu/occluders.h"

#include <cassert>
#include <numbers>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include "core/queries/surface_object.h"
#include "core/render/light_maps.h"

namespace meniscus {
namespace {

constexpr double kAfar = 1e6;  // Å, from the pivot to a camera that has everything in front of it
constexpr std::uint32_t kLeaf = 4;

/// Returns a frame for rays from all directions: nothing lies behind the camera.
PictureFrame seen_from_afar(const glm::dvec3& pivot) {
  PictureFrame frame;
  frame.camera.projection = Projection::orthographic;
  frame.basis = view_basis(frame.camera);
  frame.pivot = pivot;
  frame.camera.position = pivot - frame.basis.forward * kAfar;
  frame.eye_distance = kAfar;
  frame.pixel_size = 1.0;
  return frame;
}

/// Sorts `order` into leaves of kLeaf primitives, and appends the boxes around them, parents before children.
class TreeBuilder {
 public:
  TreeBuilder(std::span<const ray_cast::Primitive> primitives, float room, std::vector<OccluderBox>& boxes,
              std::vector<std::uint32_t>& order)
      : primitives_(primitives), room_(room), boxes_(boxes), order_(order) {
    const auto count = static_cast<std::uint32_t>(primitives.size());
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), 0u);
    boxes_.resize(count ? box_count(count) : 0);
    if (count) build(0, 0, count);
  }

 private:
  static std::uint32_t leaf_count(std::uint32_t count) { return (count + kLeaf - 1) / kLeaf; }
  static std::uint32_t box_count(std::uint32_t count) { return 2 * leaf_count(count) - 1; }

  void build(std::uint32_t box, std::uint32_t first, std::uint32_t count) {
    glm::vec3 low(3e38f), high(-3e38f), least(3e38f), most(-3e38f);
    for (std::uint32_t n = first; n < first + count; ++n) {
      const glm::vec4& bound = primitives_[order_[n]].bound;
      const glm::vec3 center(bound);
      least = glm::min(least, center);
      most = glm::max(most, center);
      low = glm::min(low, center - bound.w);
      high = glm::max(high, center + bound.w);
    }
    boxes_[box] = {low - room_, first, high + room_, count <= kLeaf ? count : 0};
    if (count <= kLeaf) return;
    const glm::vec3 extent = most - least;
    const int axis = extent.x > extent.y ? (extent.x > extent.z ? 0 : 2) : (extent.y > extent.z ? 1 : 2);
    const std::uint32_t half = (leaf_count(count) + 1) / 2 * kLeaf;  // all leaves except the last are full
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first);
    std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
      const float left = primitives_[a].bound[axis], right = primitives_[b].bound[axis];
      return left < right || (left == right && a < b);
    });
    const std::uint32_t second = box + 1 + box_count(half);
    boxes_[box].first = second;
    constexpr std::uint32_t kWorthATask = 2048;
    const auto build_first = [=, this] { build(box + 1, first, half); };
    const auto build_second = [=, this] { build(second, first + half, count - half); };
    if (count < kWorthATask) {
      build_first();
      build_second();
    } else {
      tbb::parallel_invoke(build_first, build_second);
    }
  }

  const std::span<const ray_cast::Primitive> primitives_;
  const float room_;
  std::vector<OccluderBox>& boxes_;
  std::vector<std::uint32_t>& order_;
};

}  // namespace

std::vector<glm::vec3> sky_directions(std::size_t first, std::size_t count) {
  std::vector<glm::vec3> directions;
  for (std::size_t n = first; n < first + count; ++n) {
    const glm::dvec2 point = r2_point(n);
    const double z = 1.0 - 2.0 * point.x, across = std::sqrt(1.0 - z * z), angle = 2.0 * std::numbers::pi * point.y;
    directions.emplace_back(across * std::cos(angle), across * std::sin(angle), z);
  }
  return directions;
}

LaneOccluder Occluders::pack(const PictureObject& object) {
  const Coloring& coloring = *object.coloring;
  const bool cut = !object.clip.empty();
  Packed& packed = packed_.emplace_back();
  HostPack& scene = packed.scene;
  scene.placement.slack = slack_;
  scene.pack(object, seen_from_afar(pivot_), Look{});
  scene.lanes.view.orthographic = 1;
  scene.lanes.view.eye_distance = 1e30f;  // rays start at arbitrary points
  TreeBuilder(scene.packed.primitives, 1e-3f + 4.0f * slack_, packed.boxes, packed.order);
  packed.planes = planes_around(pivot_, object.clip);
  return {.scene = scene.lanes,
          .boxes = packed.boxes.empty() ? nullptr : packed.boxes.data(),
          .order = packed.order.data(),
          .planes = packed.planes.data(),
          .plane_count = static_cast<int>(packed.planes.size()),
          .is_solid = object.surface != nullptr,
          .is_opaque = !coloring.is_translucent() && (!cut || !coloring.hides_some())};
}

void Occluders::add(const PictureObject& object) { occluders_.push_back(pack(object)); }

void Occluders::add(const SurfaceObject& object) {
  LaneOccluder occluder = pack(whole_surface(object.surface, object.coloring)[0]);
  for (const RigidMotion& motion : object.copies) {
    // A point x of the picture, relative to the pivot, is rotation^T (x + pivot - translation) in the object's own
    // axes.
    const glm::dmat3 back = glm::transpose(motion.rotation);
    occluder.turn = glm::mat3(back);
    occluder.shift = glm::vec3(back * (pivot_ - motion.translation) - pivot_);
    occluders_.push_back(occluder);
  }
}

LaneLight Occluders::towards(std::span<const glm::vec3> sky) const {
  return {.occluders = occluders_.data(),
          .occluder_count = static_cast<int>(occluders_.size()),
          .sky = sky.data(),
          .sky_rays = static_cast<int>(sky.size()),
          .sky_reach = 3e38f,
          .lift = 1e-3f + 8.0f * slack_};
}

void Occluders::aim(const Look& look, const ViewBasis& basis, int samples) {
  constexpr int kLampRays = 32;  // rays per pixel
  const auto share = [samples](int rays) { return std::max((rays + samples - 1) / samples, 2); };
  const auto all = [samples](int of_each) { return static_cast<std::size_t>(of_each) * samples; };
  light_ = towards({});
  if (look.shadows > 0.0f) {
    light_.shadow = look.shadows;
    light_.lamp_rays = look.shadow_softness > 0.0f ? share(kLampRays) : 1;
    const std::vector<glm::dvec3> lamp = lamp_directions(look, basis, all(light_.lamp_rays));
    lamp_.assign(lamp.begin(), lamp.end());
    light_.lamp = lamp_.data();
  }
  if (look.traces_sky()) {
    light_.sky_rays = 2 * share(static_cast<int>(look.ambient_occlusion_rays));  // half of them point inwards
    light_.sky_reach = look.ambient_occlusion_radius;
    sky_ = sky_directions(0, all(light_.sky_rays));
    light_.sky = sky_.data();
  }
}

std::vector<float> sky_visibility(const Surface& surface, const SkyPoints& points,
                                  std::span<const glm::vec3> directions) {
  assert(points.positions.size() == points.normals.size());
  std::vector<float> seen(points.positions.size(), 1.0f);
  if (surface.atoms.empty()) return seen;
  PictureFrame frame;
  for (const Ball& ball : surface.atoms) frame.pivot += ball.center / static_cast<double>(surface.atoms.size());
  Coloring grey;
  grey.atom.assign(surface.atoms.size(), glm::vec3(1.0f));
  Occluders occluders(frame.pivot, patch_slack(surface.atoms, surface.probe_radius, frame));
  occluders.add(whole_surface(surface, grey)[0]);
  const std::vector<glm::vec3> usual = directions.empty() ? sky_directions(0, 2 * kSkyRays) : std::vector<glm::vec3>();
  if (directions.empty()) directions = usual;
  const LaneLight light = occluders.towards(directions);
  const LaneKernels& kernels = widest_kernels(16);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, seen.size(), 256), [&](const auto& range) {
    std::vector<glm::vec3> positions, normals;
    for (std::size_t n = range.begin(); n < range.end(); ++n) {
      positions.emplace_back(points.positions[n] - frame.pivot);
      normals.emplace_back(points.normals[n]);
    }
    kernels.see_sky(light, positions.data(), normals.data(), &seen[range.begin()],
                    static_cast<std::uint32_t>(range.size()));
  });
  return seen;
}

}  // namespace meniscus
