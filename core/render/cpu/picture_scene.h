// SPDX-License-Identifier: BSD-3-Clause
// What a picture on the CPU shows, as its renderer sees it: one surface, objects in layers, or copies of surfaces.
#pragma once

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>
#include <tbb/enumerable_thread_specific.h>

#include "core/render/cpu/host_scene.h"
#include "core/render/hit_point.h"
#include "core/render/picture_block.h"

namespace meniscus {

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
