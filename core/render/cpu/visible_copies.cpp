// SPDX-License-Identifier: BSD-3-Clause
// Draws balls into the depths of samples, then tests clusters of patches, then patches, of one copy after another.
#include "core/render/cpu/visible_copies.h"

#include <iterator>

#include <glm/matrix.hpp>
#include <tbb/parallel_sort.h>

#include "core/base/progress.h"
#include "core/math/box.h"
#include "core/queries/copies.h"
#include "core/render/cpu/interruption.h"
#include "core/render/cpu/picture_content.h"
#include "core/render/picture_block.h"
#include "core/render/ray_geometry.h"

namespace meniscus {
namespace {

using ray_cast::Primitive;

constexpr double kNothingMet = std::numeric_limits<double>::infinity();
constexpr double kClusterEdge = 8.0;  // Å
constexpr double kRoom = 1e-6;        // Å, for the rounding of moved points

/// Returns a ball around a whole surface: no patch is farther from the atoms than a probe's diameter.
geometry::PatchBound bound_of(const Surface& surface) {
  Box box;
  for (const Ball& ball : surface.atoms) box.include(ball.center);
  geometry::PatchBound bound{0.5 * (box.low + box.high), 0.0};
  for (const Ball& ball : surface.atoms)
    bound.radius = std::max(bound.radius, glm::length(ball.center - bound.center) + ball.radius);
  bound.radius += 2.0 * surface.probe_radius;
  return bound;
}

/// Appends the primitives for which keep(index) is true, with their rows.
template <typename Keep>
void append_kept(const RayCastPack& from, const Keep& keep, RayCastPack& to) {
  for (std::size_t n = 0; n < from.primitives.size(); ++n) {
    if (!keep(n)) continue;
    Primitive primitive = from.primitives[n];
    const auto row = from.rows.begin() + primitive.first_row;
    primitive.first_row = static_cast<std::uint32_t>(to.rows.size());
    to.rows.insert(to.rows.end(), row, row + row_count(primitive));
    to.primitives.push_back(primitive);
  }
}

/// Increases indices of atoms by an offset.
void shift_atoms(RayCastPack& scene, std::uint32_t by) {
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
                             const PackPlacement& placement, const Look& look, const LaneKernels& kernels,
                             std::size_t patches_together)
    : objects_(objects),
      placement_(placement),
      look_(look),
      kernels_(kernels),
      patches_together_(patches_together),
      frame_(frame),
      depths_(frame_) {
  Copy next;
  for (std::uint32_t n = 0; n < objects.size(); ++n) add_copies(n, next);
  std::ranges::stable_sort(copies_, {}, &Copy::nearest);
}

/// Adds the copies of an object. next: its first numbers follow the numbers of the copies before; updated for the next
/// object.
void VisibleCopies::add_copies(std::uint32_t object, Copy& next) {
  const Surface& surface = objects_[object].surface;
  const Coloring& coloring = objects_[object].coloring;
  colors_.push_back(linear_colors(coloring));
  some_hidden_ = some_hidden_ || coloring.hides_some();
  homes_.push_back(home_of(objects_[object]));
  const std::uint32_t part_count = coloring.part.empty() ? 0 : *std::ranges::max_element(coloring.part) + 1;
  for (std::uint32_t n = 0; n < objects_[object].copies.size(); ++n) {
    next.object = object;
    next.copy = n;
    const geometry::SeenBound seen = see(next, homes_.back().bound);
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

VisibleCopies::Home VisibleCopies::home_of(const SurfaceObject& object) {
  Home home;
  home.bound = bound_of(object.surface);
  home.opaque = object.whole && !object.coloring.hides_some();
  home.patches = bounded_patches(object.surface, object.coloring);
  const auto cell = [](const BoundedPatch& patch) {
    const glm::ivec3 place(glm::floor(patch.center / kClusterEdge));
    return std::array{place.z, place.y, place.x};
  };
  std::vector<std::pair<std::array<int, 3>, std::size_t>> order(home.patches.size());
  for (std::size_t n = 0; n < order.size(); ++n) order[n] = {cell(home.patches[n]), n};
  tbb::parallel_sort(order.begin(), order.end());
  std::vector<BoundedPatch> sorted;
  sorted.reserve(order.size());
  for (std::size_t first = 0, past = 0; first < order.size(); first = past) {
    Box box;
    for (past = first; past < order.size() && order[past].first == order[first].first; ++past) {
      sorted.push_back(home.patches[order[past].second]);
      box.include(sorted.back().center);
    }
    Cluster cluster{first, past - first, {0.5 * (box.low + box.high), 0.0}};
    for (std::size_t n = first; n < past; ++n)
      cluster.bound.radius =
          std::max(cluster.bound.radius, glm::length(sorted[n].center - cluster.bound.center) + sorted[n].radius);
    home.clusters.push_back(cluster);
  }
  home.patches = std::move(sorted);
  return home;
}

geometry::SeenBound VisibleCopies::see(const Copy& copy, const geometry::PatchBound& at_home) const {
  const RigidMotion& motion = objects_[copy.object].copies[copy.copy];
  return geometry::see_bound({motion(at_home.center), at_home.radius + kRoom}, placement_.slack, frame_.pivot,
                             frame_.camera.position, frame_.basis.forward, frame_.eye_distance,
                             frame_.camera.projection == Projection::orthographic);
}

bool VisibleCopies::may_show(const geometry::SeenBound& seen) const {
  return seen.in_front && depths_.may_show(glm::vec4(glm::vec3(seen.center), static_cast<float>(seen.radius)),
                                           static_cast<float>(seen.nearest));
}

/// True if the atoms of a copy hide what is behind them. A camera inside of a solid sees its surface behind its atoms.
bool VisibleCopies::hides_others(const Copy& copy) const {
  return homes_[copy.object].opaque && copy.nearest > 0.0f && depths_.may_show(copy.bound, copy.nearest);
}

void VisibleCopies::draw_atoms(Interruption& interruption) {
  constexpr std::size_t kTogether = 64;
  for (std::size_t first = 0; first < copies_.size(); first += kTogether) {
    if (interruption.came()) return;
    std::vector<const Copy*> drawn;
    for (std::size_t n = first; n < std::min(first + kTogether, copies_.size()); ++n)
      if (hides_others(copies_[n])) drawn.push_back(&copies_[n]);
    if (drawn.empty()) continue;
    tbb::parallel_for(std::size_t{0}, drawn.size(), [&](std::size_t n) {
      const SurfaceObject& object = objects_[drawn[n]->object];
      const RigidMotion& motion = object.copies[drawn[n]->copy];
      for (const Ball& ball : object.surface.atoms) depths_.add_ball(meniscus::moved(ball, motion));
    });
    depths_.gather();
  }
}

std::vector<const VisibleCopies::Copy*> VisibleCopies::next_batch(std::size_t& next) const {
  std::vector<const Copy*> batch;
  std::size_t patches = 0;
  for (; next < copies_.size(); ++next) {
    const Copy& copy = copies_[next];
    if (!depths_.may_show(copy.bound, copy.nearest)) continue;
    patches += patch_count(copy);
    if (!batch.empty() && patches > patches_together_) break;
    batch.push_back(&copy);
  }
  return batch;
}

RayCastPack VisibleCopies::seen_part(const Copy& copy) const {
  const SurfaceObject& object = objects_[copy.object];
  const Home& home = homes_[copy.object];
  std::vector<BoundedPatch> seen;
  for (const Cluster& cluster : home.clusters) {
    if (!may_show(see(copy, cluster.bound))) continue;
    for (const BoundedPatch& patch : std::span(home.patches).subspan(cluster.first, cluster.count))
      if (may_show(see(copy, {patch.center, patch.radius}))) seen.push_back(patch);
  }
  return pack_patches({object.surface, object.coloring, object.copies[copy.copy], placement_.slack, copy.first_atom},
                      seen, frame_);
}

void VisibleCopies::add(const Copy& copy, RayCastPack part) {
  if (part.primitives.empty()) return;
  const Coloring& coloring = objects_[copy.object].coloring;
  const std::vector<glm::vec4>& colors = colors_[copy.object];
  if (coloring.kind && !scene_.colors.empty()) scene_.colors.resize(scene_.colors.size() - coloring.kind->size());
  places_.push_back({copy.object, copy.copy, static_cast<std::uint32_t>(scene_.colors.size())});
  placed_.push_back(&copy);
  shift_atoms(part, places_.back().first_atom);
  scene_.add_paint(coloring, frame_.pivot);
  scene_.colors.insert(scene_.colors.end(), colors.begin(), colors.end());
  for (const std::uint32_t mark : coloring.line_marks())
    scene_.marks.push_back(static_cast<float>(Coloring::kMarksOfPart * copy.first_part + mark));
  append_kept(
      part, [](std::size_t) { return true; }, scene_.packed);
}

void VisibleCopies::begin_block(const SceneBlock& block, Interruption& interruption, StageClock& clock) {
  {
    const auto stage = clock.stage("visible copies");
    frame_ = block.frame;
    block_ = block.block;
    samples_ = block.samples;
    find(interruption);
  }
  if (interruption.came()) return;
  const auto stage = clock.stage("tile lists");
  list_tiles(frame_, block_);
  scene_.lanes.light = block.light;
}

void VisibleCopies::connect() {
  scene_.connect(look_, !objects_.empty() && objects_.front().coloring.kind, some_hidden_);
}

/// Finds the visible patches. The scene is incomplete if the interruption occurs.
void VisibleCopies::find(Interruption& interruption) {
  moved_ = 0;
  places_.clear();
  placed_.clear();
  depths_.begin(block_, samples_);
  hits_.resize(static_cast<std::size_t>(block_.size.x) * block_.size.y);
  scene_ = {};
  scene_.placement = placement_;
  scene_.packed.slack = placement_.slack;
  draw_atoms(interruption);
  std::size_t first_new = 0;
  for (std::size_t next = 0; next < copies_.size();) {
    const std::vector<const Copy*> batch = next_batch(next);
    std::vector<RayCastPack> parts(batch.size());
    tbb::parallel_for(std::size_t{0}, batch.size(), [&](std::size_t n) {
      if (!interruption.came()) parts[n] = seen_part(*batch[n]);
    });
    if (interruption.came()) return;
    for (std::size_t n = 0; n < batch.size(); ++n) add(*batch[n], std::exchange(parts[n], {}));
    moved_ += batch.size();
    if (scene_.packed.primitives.size() - first_new <= patches_together_ / 8) continue;
    connect();
    cast_from(first_new);
    first_new = scene_.packed.primitives.size();
  }
  connect();
}

std::uint32_t VisibleCopies::atom_of(const ray_cast::Hit& hit) const {
  const std::size_t n = place_of(places_, hit.atom);
  return placed_[n]->first_atom + (hit.atom - places_[n].first_atom);
}

HitNames VisibleCopies::names_of(const ray_cast::Hit& hit, const glm::dvec3& point) const {
  const std::size_t n = place_of(places_, hit.atom);
  const Copy& copy = *placed_[n];
  const SurfaceObject& object = objects_[copy.object];
  const RigidMotion& motion = object.copies[copy.copy];
  const glm::dvec3 at_home = glm::transpose(motion.rotation) * (point - motion.translation);
  const ray_cast::Primitive& primitive = scene_.packed.primitives[hit.primitive];
  const std::uint32_t component =
      ComponentLookup(object.surface).at(static_cast<PatchKind>(primitive.kind), primitive.patch_index, at_home);
  return {atom_of(hit), component == kNone ? kNone : copy.first_component + component, primitive.kind};
}

PickedPoint VisibleCopies::picked(const ray_cast::Hit& hit) const {
  const CopyPlace& place = places_[place_of(places_, hit.atom)];
  return {.atom = hit.atom - place.first_atom, .kind = kind_of(hit), .object = place.object, .copy = place.copy};
}

/// Casts tiles that list one of the new primitives, and keeps only primitives that rays may show.
void VisibleCopies::cast_from(std::size_t first_new) {
  list_tiles(frame_, block_);
  shown_ = std::vector<std::atomic<std::uint8_t>>(scene_.packed.primitives.size());
  const glm::ivec2 tiles = tile_counts(block_);
  tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(tiles.x) * tiles.y, [&](std::size_t tile) {
    const std::span<const std::uint32_t> entries = lists_.entries(tile);
    if (std::ranges::any_of(entries, [&](std::uint32_t entry) { return entry >= first_new; })) {
      note_tile(tile);
    } else {  // there is nothing new here, and primitives shown elsewhere may be shown here, too
      for (const std::uint32_t entry : entries) shown_[entry].store(1, std::memory_order_relaxed);
    }
  });
  depths_.gather();
  RayCastPack kept;
  kept.slack = scene_.packed.slack;
  append_kept(
      scene_.packed, [&](std::size_t n) { return shown_[n].load(std::memory_order_relaxed) != 0; }, kept);
  scene_.packed = std::move(kept);
}

/// Casts a tile, marks what its rays show, and limits how far they see.
void VisibleCopies::note_tile(std::size_t tile) {
  LaneTile task;
  task.origin = tile_origin(block_, tile);
  task.list = list_of(tile);
  task.hits = hits_.data();
  std::array<double, kTileEdge * kTileEdge> farthest{};
  for (int n = 0; n < samples_; ++n) {
    task.offset[0] = sample_offset(n);
    kernels_.cast_tile(scene_.lanes, task);
    note_hits(task, scene_.lanes.view, farthest);
  }
  for (int y = 0; y < kTileEdge; ++y)
    for (int x = 0; x < kTileEdge; ++x) {
      const glm::ivec2 pixel = task.origin + glm::ivec2(x, y);
      if (pixel.x < block_.size.x && pixel.y < block_.size.y) depths_.limit(pixel, farthest[y * kTileEdge + x]);
    }
}

/// Marks what the rays of one sample show, and computes how far they see: a distance from the camera (orthographic:
/// from its plane), increased by more than rounding.
void VisibleCopies::note_hits(const LaneTile& tile, const kernel::BlockView& view, std::span<double> farthest) {
  constexpr double kRounding = 1e-5;  // more than the rounding of rays and bounds in single precision
  const glm::ivec2 end = glm::min(tile.origin + kTileEdge, view.size);
  for (int y = tile.origin.y; y < end.y; ++y) {
    for (int x = tile.origin.x; x < end.x; ++x) {
      const ray_cast::Hit& hit = hits_[static_cast<std::size_t>(y) * view.size.x + x];
      double& known = farthest[static_cast<std::size_t>(y - tile.origin.y) * kTileEdge + (x - tile.origin.x)];
      if (hit.primitive == ray_cast::kNoPrimitive) {
        known = kNothingMet;
        continue;
      }
      shown_[hit.primitive].store(1, std::memory_order_relaxed);
      const glm::dvec2 aside = glm::dvec2(view.first_offset + tile.offset[0] + glm::vec2(x, y)) * frame_.pixel_size;
      const double to_plane = view.orthographic != 0u
                                  ? frame_.eye_distance
                                  : std::sqrt(frame_.eye_distance * frame_.eye_distance + glm::dot(aside, aside));
      known = std::max(known, to_plane + hit.t + kRounding * (to_plane + std::abs(hit.t)));
    }
  }
}

}  // namespace meniscus
