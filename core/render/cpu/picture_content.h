// SPDX-License-Identifier: BSD-3-Clause
// The content of a picture on the CPU: packed objects, lists of their primitives by tile, and the scene for the
// renderer.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include "core/color/coloring.h"
#include "core/render/cpu/lane_kernels.h"
#include "core/render/picture_block.h"
#include "core/render/ray_cast_pack.h"

namespace meniscus {

/// A packed scene on the host.
struct HostPack {
  RayCastPack packed;
  PackPlacement placement;
  std::vector<glm::vec4> colors;          ///< linear_colors()
  std::vector<float> marks;               ///< Coloring::line_marks(): integers that a float represents exactly
  std::vector<std::uint8_t> keeps_color;  ///< one for each atom, if there is a volume map
  LanePack lanes;                         ///< all of this for the kernels, except its view

  /// Packs a surface or shapes, with `placement` except for its probe, and connects them. If planes cut it, all of it
  /// is packed, hidden atoms too.
  void pack(const PictureObject& object, const PictureFrame& frame, const Look& look);

  /// Adds the volume map and its atoms, which follow the previous ones. For connect().
  void add_paint(const Coloring& coloring, const glm::dvec3& pivot) {
    if (!coloring.volume) return;
    lanes.paint.map = coloring.volume.get();
    lanes.paint.pivot = pivot;
    for (std::uint32_t a = 0; a < coloring.atom.size(); ++a) keeps_color.push_back(coloring.by_volume(a) ? 0 : 1);
  }

  /// Sets `lanes`, after everything else. color_by_kind: the last three colours belong to kinds.
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

/// Returns planes relative to a pivot: points with dot(xyz, x) < w are kept.
std::vector<glm::vec4> planes_around(const glm::dvec3& pivot, std::span<const ClipPlane> planes);

/// Computes the tiles that a bound may touch: columns from x to before y, rows from z to before w.
class TileFootprints {
 public:
  TileFootprints(const PictureFrame& frame, const PictureBlock& block)
      : TileFootprints(tile_list_parameters(frame, block, 0)) {}
  explicit TileFootprints(const kernel::TileListParameters& params) : params_(params) {}

  /// Returns the tiles of a bound (Primitive::bound).
  glm::ivec4 of(const glm::vec4& bound) const;

 private:
  kernel::TileListParameters params_;
};

/// Lists for each tile the primitives with bounds that may touch it. The lists equal the GPU's (ray_caster.h), and each
/// is sorted by index.
class CpuTileLists {
 public:
  /// Builds the lists. cuts: planes (points with dot(xyz, x) < w are kept) through which all rays of the block enter;
  /// primitives that one of them cuts away completely are left out.
  void build(std::span<const ray_cast::Primitive> primitives, const PictureFrame& frame, const PictureBlock& block,
             std::span<const glm::vec4> cuts = {});

  glm::ivec2 tiles() const { return tiles_; }  ///< columns, rows
  /// Returns indices of primitives, in any order. Tiles are numbered row by row.
  std::span<std::uint32_t> entries(std::size_t tile) {
    return std::span(entries_).subspan(starts_[tile], starts_[tile + 1] - starts_[tile]);
  }

 private:
  glm::ivec2 tiles_{0};
  std::vector<std::uint32_t> starts_;  // one more than there are tiles
  std::vector<std::uint32_t> entries_;
};

/// A tile's list for the inner loops. Its arrays are reused from tile to tile.
class SortedList {
 public:
  /// Returns the sorted list, which is valid until the next call. Also sorts the entries, because tiles are cast
  /// repeatedly.
  LaneList sort(std::span<std::uint32_t> entries, std::span<const ray_cast::Primitive> primitives);

 private:
  std::vector<std::uint64_t> keys_;
  std::vector<float> numbers_[5];
  std::vector<std::uint32_t> primitives_;
};

class Interruption;

/// A block of pixels and the settings of its rays.
struct SceneBlock {
  const PictureFrame& frame;
  PictureBlock block;
  int samples = 1;                   ///< rays per pixel
  const LaneLight* light = nullptr;  ///< nullptr: light passes through everything
};

/// The properties of a scene's block.
struct SceneContent {
  bool marks = false;            ///< points have LaneSamples::mark
  bool layers = false;           ///< samples have LaneSamples::over
  bool shows_through = false;    ///< samples have LaneTile::front
  bool highlights = false;       ///< true: they are cast with everything else; false: the finish of samples adds them
  bool several_objects = false;  ///< hits have several values of Hit::object
};

/// Everything that the rays of one picture may hit.
class PictureContent {
 public:
  virtual ~PictureContent() = default;

  /// Prepares a block, which is valid until the next call. It must not be cast if the interruption has occurred.
  virtual void begin_block(const SceneBlock& block, Interruption& interruption, StageClock& clock) = 0;
  /// Casts a tile of the block: adds to task.sums, or writes task.samples and task.front, and task.hits. Any number of
  /// threads may call it at the same time.
  virtual void cast_tile(std::size_t tile, LaneTile task, const LaneKernels& kernels) = 0;

  /// Returns the properties of the block.
  virtual SceneContent content() const = 0;

  /// Returns the names of a hit of the block at a point, Å.
  virtual HitNames names_of(const ray_cast::Hit& hit, const glm::dvec3& point) const = 0;
  /// Returns HitNames::atom of a hit of the block.
  virtual std::uint32_t atom_of(const ray_cast::Hit& hit) const { return hit.atom; }
  /// Returns everything except the position of a hit of the block. The objects of the scene need not exist any more.
  virtual PickedPoint picked(const ray_cast::Hit& hit) const = 0;
};

/// A scene in which each ray shows the nearest primitive that it hits.
class OpaqueScene : public PictureContent {
 public:
  void cast_tile(std::size_t tile, LaneTile task, const LaneKernels& kernels) final;
  SceneContent content() const final { return {.marks = !scene_.marks.empty()}; }
  const HostPack& scene() const { return scene_; }

 protected:
  void list_tiles(const PictureFrame& frame, const PictureBlock& block);
  LaneList list_of(std::size_t tile) { return sorted_.local().sort(lists_.entries(tile), scene_.packed.primitives); }
  PatchKind kind_of(const ray_cast::Hit& hit) const {
    return static_cast<PatchKind>(scene_.packed.primitives[hit.primitive].kind);
  }

  HostPack scene_;
  CpuTileLists lists_;

 private:
  tbb::enumerable_thread_specific<SortedList> sorted_;
};

/// A whole surface. Its memory is reused from picture to picture.
class SurfaceContent final : public OpaqueScene {
 public:
  /// Packs an object. The data that it points to must exist while the scene is cast.
  void pack(const PictureObject& object, const PictureFrame& frame, const PackPlacement& placement, const Look& look);

  void begin_block(const SceneBlock& block, Interruption& interruption, StageClock& clock) override;
  HitNames names_of(const ray_cast::Hit& hit, const glm::dvec3& point) const override;
  PickedPoint picked(const ray_cast::Hit& hit) const override { return {hit.atom, kind_of(hit)}; }

 private:
  const Surface* surface_ = nullptr;
};

}  // namespace meniscus
