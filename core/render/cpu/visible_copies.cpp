// SPDX-License-Identifier: BSD-3-Clause
// Moves, packs, casts and sieves copies, batch after batch.
#include "core/render/cpu/visible_copies.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <tbb/parallel_for.h>

#include "core/math/box.h"
#include "core/queries/combine.h"
#include "core/render/component_lookup.h"
#include "core/render/ray_geometry.h"

namespace meniscus {
namespace {

using ray_cast::Primitive;

constexpr float kNothingMet = std::numeric_limits<float>::infinity();

/// A ball around all of a surface: no patch is farther from the atoms than a probe's diameter.
geometry::PatchBound bound_of(const Surface& surface) {
  Box box;
  for (const Ball& ball : surface.atoms) box.include(ball.center);
  geometry::PatchBound bound{0.5 * (box.low + box.high), 0.0};
  for (const Ball& ball : surface.atoms)
    bound.radius = std::max(bound.radius, glm::length(ball.center - bound.center) + ball.radius);
  bound.radius += 2.0 * surface.probe_radius;
  return bound;
}

/// Appends the primitives for which keep(place) is true, with their rows.
template <typename Keep>
void append_kept(const RayCastScene& from, const Keep& keep, RayCastScene& to) {
  for (std::size_t n = 0; n < from.primitives.size(); ++n) {
    if (!keep(n)) continue;
    Primitive primitive = from.primitives[n];
    const auto row = from.rows.begin() + primitive.first_row;
    primitive.first_row = static_cast<std::uint32_t>(to.rows.size());
    to.rows.insert(to.rows.end(), row, row + row_count(primitive));
    to.primitives.push_back(primitive);
  }
}

/// Makes indices of atoms count from another one.
void shift_atoms(RayCastScene& scene, std::uint32_t by) {
  for (Primitive& primitive : scene.primitives) {
    if (primitive.kind == ray_cast::kConcave) {
      const std::uint32_t end = primitive.first_row + row_count(primitive);
      for (std::uint32_t row = end - primitive.atom; row < end; ++row)
        scene.rows[row].w = std::bit_cast<float>(std::bit_cast<std::uint32_t>(scene.rows[row].w) + by);
      continue;
    }
    primitive.atom += by;
    if (primitive.kind == ray_cast::kToroidal) primitive.second_atom += by;
  }
}

}  // namespace

std::size_t place_of(std::span<const CopyPlace> places, std::uint32_t atom) {
  const auto after = std::ranges::upper_bound(places, atom, {}, &CopyPlace::first_atom);
  return static_cast<std::size_t>(std::distance(places.begin(), after)) - 1;
}

std::vector<BallGroup> ball_groups(std::span<const SurfaceObject> objects) {
  std::vector<BallGroup> groups;
  for (const SurfaceObject& object : objects) {
    const geometry::PatchBound bound = bound_of(object.surface);
    for (const RigidMotion& copy : object.copies)
      groups.push_back({object.surface.atoms, &copy, copy(bound.center), bound.radius});
  }
  return groups;
}

VisibleCopies::VisibleCopies(std::span<const SurfaceObject> objects, const PictureFrame& frame,
                             const ScenePlacement& placement, const LaneKernels& kernels, std::size_t patches_together)
    : objects_(objects), frame_(frame), placement_(placement), kernels_(kernels), patches_together_(patches_together) {
  Copy next;
  for (std::uint32_t n = 0; n < objects.size(); ++n) add_copies(n, next);
  std::ranges::stable_sort(copies_, {}, &Copy::nearest);
}

/// next: the copy after those that are there, but for what it is a copy of.
void VisibleCopies::add_copies(std::uint32_t object, Copy& next) {
  const Surface& surface = objects_[object].surface;
  const Coloring& coloring = objects_[object].coloring;
  colors_.push_back(linear_colors(coloring));
  some_hidden_ = some_hidden_ || coloring.hides_some();
  const geometry::PatchBound own = bound_of(surface);
  const std::uint32_t part_count = coloring.part.empty() ? 0 : *std::ranges::max_element(coloring.part) + 1;
  for (std::uint32_t n = 0; n < objects_[object].copies.size(); ++n) {
    const geometry::PatchBound bound{objects_[object].copies[n](own.center), own.radius};
    const geometry::SeenBound seen =
        geometry::see_bound(bound, placement_.slack, frame_.pivot, frame_.camera.position, frame_.basis.forward,
                            frame_.eye_distance, frame_.camera.projection == Projection::orthographic);
    next.object = object;
    next.copy = n;
    next.bound = glm::vec4(glm::vec3(seen.center), static_cast<float>(seen.radius));
    next.nearest = static_cast<float>(seen.nearest);
    if (seen.in_front) copies_.push_back(next);
    next.first_atom += static_cast<std::uint32_t>(surface.atoms.size());
    next.first_part += part_count;
    next.first_component += static_cast<std::uint32_t>(surface.components.size());
  }
}

std::size_t VisibleCopies::patch_count(const Copy& copy) const {
  const Surface& surface = objects_[copy.object].surface;
  return surface.convex.size() + surface.toroidal.size() + surface.concave.size();
}

/// True, too, where no tile is touched.
bool VisibleCopies::is_hidden(const glm::vec4& bound, float nearest) const {
  const glm::ivec4 tiles = TileFootprints(frame_, block_).of(bound);
  const int columns = tile_counts(block_).x;
  for (int y = tiles.z; y < tiles.w; ++y)
    for (int x = tiles.x; x < tiles.y; ++x)
      if (!(nearest > depths_[static_cast<std::size_t>(y) * columns + x])) return false;
  return true;
}

std::vector<const VisibleCopies::Copy*> VisibleCopies::next_batch(std::size_t& next) const {
  std::vector<const Copy*> batch;
  std::size_t patches = 0;
  for (; next < copies_.size(); ++next) {
    const Copy& copy = copies_[next];
    if (is_hidden(copy.bound, copy.nearest)) continue;
    patches += patch_count(copy);
    if (!batch.empty() && patches > patches_together_) break;
    batch.push_back(&copy);
  }
  return batch;
}

RayCastScene VisibleCopies::seen_part(const Copy& copy) const {
  const SurfaceObject& object = objects_[copy.object];
  const RayCastScene all = pack_part(moved_patches(object.surface, object.copies[copy.copy]), object.coloring, frame_,
                                     placement_.slack, copy.first_atom);
  RayCastScene seen;
  append_kept(
      all, [&](std::size_t n) { return !is_hidden(all.primitives[n].bound, all.primitives[n].nearest); }, seen);
  return seen;
}

void VisibleCopies::add(const Copy& copy, RayCastScene part, HostScene& scene) {
  if (part.primitives.empty()) return;
  const Coloring& coloring = objects_[copy.object].coloring;
  const std::vector<glm::vec4>& colors = colors_[copy.object];
  if (coloring.kind && !scene.colors.empty()) scene.colors.resize(scene.colors.size() - coloring.kind->size());
  places_.push_back({copy.object, copy.copy, static_cast<std::uint32_t>(scene.colors.size())});
  placed_.push_back(&copy);
  shift_atoms(part, places_.back().first_atom);
  scene.add_paint(coloring, frame_.pivot);
  scene.colors.insert(scene.colors.end(), colors.begin(), colors.end());
  for (const std::uint32_t n : coloring.part) scene.parts.push_back(static_cast<float>(copy.first_part + n));
  append_kept(
      part, [](std::size_t) { return true; }, scene.packed);
}

void VisibleCopies::find(const PictureBlock& block, int samples, const Look& look, HostScene& scene,
                         const std::function<bool()>& stop) {
  block_ = block;
  moved_ = 0;
  places_.clear();
  placed_.clear();
  const glm::ivec2 tiles = tile_counts(block);
  depths_.assign(static_cast<std::size_t>(tiles.x) * tiles.y, kNothingMet);
  hits_.resize(static_cast<std::size_t>(block.size.x) * block.size.y);
  scene = {};
  scene.placement = placement_;
  scene.packed.slack = placement_.slack;
  const bool by_kind = !objects_.empty() && objects_.front().coloring.kind;
  for (std::size_t next = 0; next < copies_.size();) {
    const std::vector<const Copy*> batch = next_batch(next);
    std::vector<RayCastScene> parts(batch.size());
    tbb::parallel_for(std::size_t{0}, batch.size(), [&](std::size_t n) {
      if (!stop || !stop()) parts[n] = seen_part(*batch[n]);
    });
    if (stop && stop()) return;
    const std::size_t first_new = scene.packed.primitives.size();
    for (std::size_t n = 0; n < batch.size(); ++n) add(*batch[n], std::exchange(parts[n], {}), scene);
    moved_ += batch.size();
    if (scene.packed.primitives.size() == first_new) continue;
    scene.connect(look, by_kind, some_hidden_);
    scene.lanes.view = block_view(frame_, block, glm::vec2(0.0f));
    cast_from(first_new, samples, scene);
  }
  scene.connect(look, by_kind, some_hidden_);
}

HitNames VisibleCopies::names_of(const ray_cast::Hit& hit, const ray_cast::Primitive& primitive,
                                 const glm::dvec3& point) const {
  const std::size_t n = place_of(places_, hit.atom);
  const Copy& copy = *placed_[n];
  const SurfaceObject& object = objects_[copy.object];
  const RigidMotion& motion = object.copies[copy.copy];
  const glm::dvec3 at_home = glm::transpose(motion.rotation) * (point - motion.translation);
  const std::uint32_t component =
      ComponentLookup(object.surface).at(static_cast<PatchKind>(primitive.kind), primitive.patch_index, at_home);
  return {copy.first_atom + (hit.atom - places_[n].first_atom),
          component == kNone ? kNone : copy.first_component + component, primitive.kind};
}

/// Casts tiles that list one of the new primitives, and leaves of the scene what rays may show.
void VisibleCopies::cast_from(std::size_t first_new, int samples, HostScene& scene) {
  lists_.build(scene.packed.primitives, frame_, block_);
  shown_ = std::vector<std::atomic<std::uint8_t>>(scene.packed.primitives.size());
  tbb::parallel_for(std::size_t{0}, depths_.size(), [&](std::size_t tile) {
    const std::span<const std::uint32_t> entries = lists_.entries(tile);
    if (std::ranges::any_of(entries, [&](std::uint32_t entry) { return entry >= first_new; })) {
      cast_tile(tile, samples, scene);
    } else {  // nothing has changed here, and what was shown elsewhere may be shown here, too
      for (const std::uint32_t entry : entries) shown_[entry].store(1, std::memory_order_relaxed);
    }
  });
  RayCastScene kept;
  kept.slack = scene.packed.slack;
  append_kept(
      scene.packed, [&](std::size_t n) { return shown_[n].load(std::memory_order_relaxed) != 0; }, kept);
  scene.packed = std::move(kept);
}

void VisibleCopies::cast_tile(std::size_t tile, int samples, const HostScene& scene) {
  LaneTile task;
  const int number = static_cast<int>(tile);
  task.origin = kTileEdge * glm::ivec2(number % lists_.tiles().x, number / lists_.tiles().x);
  task.list = sorted_.local().sort(lists_.entries(tile), scene.packed.primitives);
  task.hits = hits_.data();
  float farthest = 0.0f;
  for (int n = 0; n < samples; ++n) {
    task.offset[0] = sample_offset(n);
    kernels_.cast_tile(scene.lanes, task);
    farthest = std::max(farthest, farthest_of(task, scene.lanes.view));
  }
  depths_[tile] = farthest;
}

/// How far from the camera (orthographic: from its plane) the rays of one sample end, rounded up; marks what they show.
float VisibleCopies::farthest_of(const LaneTile& tile, const kernel::BlockView& view) {
  constexpr double kRounding = 1e-5;  // more than rays and bounds have in single precision
  double farthest = 0.0;
  const glm::ivec2 end = glm::min(tile.origin + kTileEdge, view.size);
  for (int y = tile.origin.y; y < end.y; ++y) {
    for (int x = tile.origin.x; x < end.x; ++x) {
      const ray_cast::Hit& hit = hits_[static_cast<std::size_t>(y) * view.size.x + x];
      if (hit.primitive == ray_cast::kNoPrimitive) {
        farthest = kNothingMet;
        continue;
      }
      shown_[hit.primitive].store(1, std::memory_order_relaxed);
      const glm::dvec2 aside = glm::dvec2(view.first_offset + tile.offset[0] + glm::vec2(x, y)) * frame_.pixel_size;
      const double to_plane = view.orthographic != 0u
                                  ? frame_.eye_distance
                                  : std::sqrt(frame_.eye_distance * frame_.eye_distance + glm::dot(aside, aside));
      farthest = std::max(farthest, to_plane + hit.t + kRounding * (to_plane + std::abs(hit.t)));
    }
  }
  return static_cast<float>(farthest);
}

}  // namespace meniscus
