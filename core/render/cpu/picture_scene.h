// SPDX-License-Identifier: BSD-3-Clause
// What a picture on the CPU shows: packed objects, their primitives by tile, and the scene as its renderer sees it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <tbb/enumerable_thread_specific.h>

#include "core/color/coloring.h"
#include "core/render/cpu/lane_kernels.h"
#include "core/render/picture_block.h"
#include "core/render/ray_cast_scene.h"

namespace meniscus {

struct ClipPlane;
struct PictureObject;

/// A picture's scene on the host.
struct HostScene {
  RayCastScene packed;
  ScenePlacement placement;
  std::vector<glm::vec4> colors;          ///< linear_colors()
  std::vector<float> marks;               ///< Coloring::line_marks(): whole numbers that a float holds exactly
  std::vector<std::uint8_t> keeps_color;  ///< of atoms, if there is a volume map
  LaneScene lanes;                        ///< all of this as the kernels read it, but for its view

  /// Packs a surface or shapes, with `placement` but for its probe, and connects them. What a plane cuts is packed as a
  /// whole, hidden atoms too.
  void pack(const PictureObject& object, const PictureFrame& frame, const Look& look);

  /// What a volume map colours of atoms that follow those of before. For connect().
  void add_paint(const Coloring& coloring, const glm::dvec3& pivot) {
    if (!coloring.volume) return;
    lanes.paint.map = coloring.volume.get();
    lanes.paint.pivot = pivot;
    for (std::uint32_t a = 0; a < coloring.atom.size(); ++a) keeps_color.push_back(coloring.by_volume(a) ? 0 : 1);
  }

  /// Sets `lanes`, once everything else is there. color_by_kind: the last three colours are those of kinds.
  void connect(const Look& look, bool color_by_kind, bool some_hidden) {
    lanes.primitives = packed.primitives.data();
    lanes.rows = packed.rows.data();
    lanes.colors = colors.data();
    lanes.marks = marks.data();
    lanes.some_hidden = some_hidden;
    lanes.paint.keeps_color = keeps_color.data();
    const auto atom_count = static_cast<std::uint32_t>(colors.size() - (color_by_kind ? 3 : 0));
    lanes.params = cast_parameters(placement, look, atom_count, color_by_kind);
  }
};

/// Returns planes relative to a pivot: kept is where dot(xyz, x) < w.
std::vector<glm::vec4> planes_around(const glm::dvec3& pivot, std::span<const ClipPlane> planes);

/// Tiles that a bound may touch: columns from x to before y, rows from z to before w.
class TileFootprints {
 public:
  TileFootprints(const PictureFrame& frame, const PictureBlock& block)
      : TileFootprints(tile_list_parameters(frame, block, 0)) {}
  explicit TileFootprints(const kernel::TileListParameters& params) : params_(params) {}

  /// bound: Primitive::bound.
  glm::ivec4 of(const glm::vec4& bound) const;

 private:
  kernel::TileListParameters params_;
};

/// For each tile the primitives whose bounds it may touch: the same lists as the GPU's (ray_caster.h), each in order.
class CpuTileLists {
 public:
  /// cuts: planes, kept is where dot(xyz, x) < w, through which all rays of the block come in; what is wholly cut away
  /// by one of them is not listed.
  void build(std::span<const ray_cast::Primitive> primitives, const PictureFrame& frame, const PictureBlock& block,
             std::span<const glm::vec4> cuts = {});

  glm::ivec2 tiles() const { return tiles_; }  ///< columns, rows
  /// Places among the primitives, in any order; `tile` counts row by row.
  std::span<std::uint32_t> entries(std::size_t tile) {
    return std::span(entries_).subspan(starts_[tile], starts_[tile + 1] - starts_[tile]);
  }

 private:
  glm::ivec2 tiles_{0};
  std::vector<std::uint32_t> starts_;  // one more than tiles
  std::vector<std::uint32_t> entries_;
};

/// A tile's list as the inner loops read it. Keeps its arrays from tile to tile.
class SortedList {
 public:
  /// Valid until the next one is sorted. Leaves the entries in its order, for tiles are cast again and again.
  LaneList sort(std::span<std::uint32_t> entries, std::span<const ray_cast::Primitive> primitives);

 private:
  std::vector<std::uint64_t> keys_;
  std::vector<float> numbers_[5];
  std::vector<std::uint32_t> primitives_;
};

class Interruption;
class StageClock;

/// A block of pixels and the rays that are cast through it.
struct SceneBlock {
  const PictureFrame& frame;  ///< that of the picture or of its shade map, which is the same view in other pixels
  PictureBlock block;
  int samples = 1;                   ///< rays of each pixel
  const LaneLight* light = nullptr;  ///< nullptr: light goes through everything
};

/// What a block of a scene has.
struct SceneContent {
  bool marks = false;            ///< points have LaneSamples::mark
  bool layers = false;           ///< samples have LaneSamples::over
  bool shows_through = false;    ///< samples have LaneTile::front
  bool highlights = false;       ///< they are cast with everything else; else the finish adds them
  bool several_objects = false;  ///< hits have several values of Hit::object
};

/// Everything that rays of one picture may meet.
class PictureScene {
 public:
  virtual ~PictureScene() = default;

  /// Prepares a block, which stays until the next one begins. It must not be cast if the interruption has come.
  virtual void begin_block(const SceneBlock& block, Interruption& interruption, StageClock& clock) = 0;
  /// Casts a tile of the block: adds to task.sums, or writes task.samples and task.front, and task.hits. Any number of
  /// threads may call it at once.
  virtual void cast_tile(std::size_t tile, LaneTile task, const LaneKernels& kernels) = 0;

  /// Returns what is in the block.
  virtual SceneContent content() const = 0;

  /// Returns the names of a hit of the block at a point, Å.
  virtual HitNames names_of(const ray_cast::Hit& hit, const glm::dvec3& point) const = 0;
  /// Returns HitNames::atom of a hit of the block.
  virtual std::uint32_t atom_of(const ray_cast::Hit& hit) const { return hit.atom; }
  /// Returns everything but the position of a hit of the block. What the scene was made of need not exist any more.
  virtual PickedPoint picked(const ray_cast::Hit& hit) const = 0;
};

/// A scene in which each ray shows the nearest primitive that it meets.
class OpaqueScene : public PictureScene {
 public:
  void cast_tile(std::size_t tile, LaneTile task, const LaneKernels& kernels) final;
  SceneContent content() const final { return {.marks = !scene_.marks.empty()}; }
  const HostScene& scene() const { return scene_; }

 protected:
  void list_tiles(const PictureFrame& frame, const PictureBlock& block);
  LaneList list_of(std::size_t tile) { return sorted_.local().sort(lists_.entries(tile), scene_.packed.primitives); }
  PatchKind kind_of(const ray_cast::Hit& hit) const {
    return static_cast<PatchKind>(scene_.packed.primitives[hit.primitive].kind);
  }

  HostScene scene_;
  CpuTileLists lists_;

 private:
  tbb::enumerable_thread_specific<SortedList> sorted_;
};

/// A whole surface. Keeps its memory from picture to picture.
class SurfaceScene final : public OpaqueScene {
 public:
  /// What the object points to must stay while the scene is cast.
  void pack(const PictureObject& object, const PictureFrame& frame, const ScenePlacement& placement, const Look& look);

  void begin_block(const SceneBlock& block, Interruption& interruption, StageClock& clock) override;
  HitNames names_of(const ray_cast::Hit& hit, const glm::dvec3& point) const override;
  PickedPoint picked(const ray_cast::Hit& hit) const override { return {hit.atom, kind_of(hit)}; }

 private:
  const Surface* surface_ = nullptr;
};

}  // namespace meniscus
