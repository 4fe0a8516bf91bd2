// SPDX-License-Identifier: BSD-3-Clause
// Packs objects for rays on the CPU, lists their primitives by tile, and casts tiles of opaque scenes.
#include "core/render/cpu/picture_content.h"

#include <tbb/parallel_for.h>

#include "core/base/progress.h"
#include "core/color/color_maps.h"
#include "core/image/color_space.h"
#include "core/render/picture.h"

namespace meniscus {
namespace {

using glm::ivec2;
using glm::ivec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

/// The shared source that computes which tiles a bound touches.
struct Footprints {
  const kernel::TileListParameters& params;
#include "gpu_shaders/ray_cast/bound_footprint.glsl"
};

template <typename Work>
void for_each_tile(const ivec4& footprint, int columns, const Work& work) {
  for (int y = footprint.z; y < footprint.w; ++y)
    for (int x = footprint.x; x < footprint.y; ++x) work(static_cast<std::size_t>(y) * columns + x);
}

/// Returns bits that have the order of floats.
std::uint32_t ordered_bits(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

}  // namespace

void HostPack::pack(const PictureObject& object, const PictureFrame& frame, const Look& look) {
  const Coloring& coloring = *object.coloring;
  const bool cut = !object.clip.empty();
  const Coloring shows_all;
  if (object.surface) {
    placement.probe_radius = object.surface->probe_radius;
    pack_scene(*object.surface, cut ? shows_all : coloring, frame, packed);
  } else {
    pack_shapes(*object.shapes, coloring, frame, placement.slack, packed);
  }
  const bool by_kind = object.surface && coloring.kind;
  colors = linear_colors(coloring);
  if (!by_kind) colors.resize(coloring.atom.size());
  const std::vector<std::uint32_t> line_marks = coloring.line_marks();
  marks.assign(line_marks.begin(), line_marks.end());
  lanes.paint = {};
  keeps_color.clear();
  if (object.surface) add_paint(coloring, frame.pivot);
  connect(look, by_kind, !cut && coloring.hides_some());
}

std::vector<vec4> planes_around(const glm::dvec3& pivot, std::span<const ClipPlane> planes) {
  std::vector<vec4> around;
  for (const ClipPlane& plane : planes)
    around.emplace_back(vec3(plane.normal), static_cast<float>(plane.offset - glm::dot(plane.normal, pivot)));
  return around;
}

glm::ivec4 TileFootprints::of(const glm::vec4& bound) const { return Footprints{params_}.bound_footprint(bound); }

void CpuTileLists::build(std::span<const ray_cast::Primitive> primitives, const PictureFrame& frame,
                         const PictureBlock& block, std::span<const glm::vec4> cuts) {
  tiles_ = tile_counts(block);
  const auto tile_count = static_cast<std::size_t>(tiles_.x) * tiles_.y;
  const TileFootprints footprints(frame, block);
  std::vector<ivec4> touched(primitives.size());
  std::vector<std::atomic<std::uint32_t>> next(tile_count);
  tbb::parallel_for(std::size_t{0}, primitives.size(), [&](std::size_t n) {
    const vec4& bound = primitives[n].bound;
    const bool is_cut_away =
        std::ranges::any_of(cuts, [&](const vec4& cut) { return glm::dot(vec3(cut), vec3(bound)) - bound.w > cut.w; });
    touched[n] = is_cut_away ? ivec4(0) : footprints.of(bound);
    for_each_tile(touched[n], tiles_.x, [&](std::size_t tile) { next[tile].fetch_add(1, std::memory_order_relaxed); });
  });
  starts_.assign(tile_count + 1, 0);
  for (std::size_t tile = 0; tile < tile_count; ++tile) {
    starts_[tile + 1] = starts_[tile] + next[tile];
    next[tile] = starts_[tile];
  }
  entries_.resize(starts_.back());
  tbb::parallel_for(std::size_t{0}, primitives.size(), [&](std::size_t n) {
    for_each_tile(touched[n], tiles_.x, [&](std::size_t tile) {
      entries_[next[tile].fetch_add(1, std::memory_order_relaxed)] = static_cast<std::uint32_t>(n);
    });
  });
}

LaneList SortedList::sort(std::span<std::uint32_t> entries, std::span<const ray_cast::Primitive> primitives) {
  const auto key_of = [&](std::uint32_t entry) {
    return static_cast<std::uint64_t>(ordered_bits(primitives[entry].nearest)) << 32 | entry;
  };
  if (!std::ranges::is_sorted(entries, {}, key_of)) {
    keys_.clear();
    for (const std::uint32_t entry : entries) keys_.push_back(key_of(entry));
    std::ranges::sort(keys_);
    std::ranges::transform(keys_, entries.begin(), [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
  }
  for (std::vector<float>& numbers : numbers_) numbers.resize(entries.size());
  for (std::size_t n = 0; n < entries.size(); ++n) {
    const ray_cast::Primitive& primitive = primitives[entries[n]];
    for (int axis = 0; axis < 4; ++axis) numbers_[axis][n] = primitive.bound[axis];
    numbers_[4][n] = primitive.nearest;
  }
  primitives_.assign(entries.begin(), entries.end());
  const std::size_t size = entries.size() + LaneList::kListPadding;
  for (int axis = 0; axis < 4; ++axis) numbers_[axis].resize(size, 0.0f);
  numbers_[4].resize(size, std::numeric_limits<float>::infinity());
  primitives_.resize(size, 0);
  return {static_cast<int>(entries.size()),
          numbers_[0].data(),
          numbers_[1].data(),
          numbers_[2].data(),
          numbers_[3].data(),
          numbers_[4].data(),
          primitives_.data()};
}

glm::vec3 painted(const PointPaint& paint, std::uint32_t atom, const glm::vec4& atom_color, const glm::vec3& x,
                  const glm::vec3& normal) {
  if (paint.keeps_color[atom]) return glm::vec3(atom_color);
  return linear_from_srgb(paint.map->color(paint.pivot + glm::dvec3(x), glm::dvec3(normal)));
}

void OpaqueScene::list_tiles(const PictureFrame& frame, const PictureBlock& block) {
  lists_.build(scene_.packed.primitives, frame, block);
  scene_.lanes.view = block_view(frame, block, glm::vec2(0.0f));
}

void OpaqueScene::cast_tile(std::size_t tile, LaneTile task, const LaneKernels& kernels) {
  if (lists_.entries(tile).empty()) return;
  task.list = list_of(tile);
  kernels.cast_tile(scene_.lanes, task);
}

void SurfaceContent::pack(const PictureObject& object, const PictureFrame& frame, const PackPlacement& placement,
                          const Look& look) {
  surface_ = object.surface;
  scene_.placement = placement;
  scene_.pack(object, frame, look);
}

void SurfaceContent::begin_block(const SceneBlock& block, Interruption&, StageClock& clock) {
  const auto stage = clock.stage("tile lists");
  list_tiles(block.frame, block.block);
  scene_.lanes.light = block.light;
}

HitNames SurfaceContent::names_of(const ray_cast::Hit& hit, const glm::dvec3& point) const {
  return meniscus::names_of({surface_, scene_.packed.primitives}, hit, point);
}

}  // namespace meniscus
