// SPDX-License-Identifier: BSD-3-Clause
// Casts tiles of scenes in which nothing is seen through.
#include "core/render/cpu/picture_scene.h"

#include "core/base/stage_clock.h"
#include "core/render/picture_object.h"

namespace meniscus {

void OpaqueScene::list_tiles(const PictureFrame& frame, const PictureBlock& block) {
  lists_.build(scene_.packed.primitives, frame, block);
  scene_.lanes.view = block_view(frame, block, glm::vec2(0.0f));
}

void OpaqueScene::cast_tile(std::size_t tile, LaneTile task, const LaneKernels& kernels) {
  if (lists_.entries(tile).empty()) return;
  task.list = list_of(tile);
  kernels.cast_tile(scene_.lanes, task);
}

void SurfaceScene::pack(const PictureObject& object, const PictureFrame& frame, const ScenePlacement& placement,
                        const Look& look) {
  surface_ = object.surface;
  scene_.placement = placement;
  scene_.pack(object, frame, look);
}

void SurfaceScene::begin_block(const SceneBlock& block, Interruption&, StageClock& clock) {
  const auto stage = clock.stage("tile lists");
  list_tiles(block.frame, block.block);
  scene_.lanes.light = block.light;
}

HitNames SurfaceScene::names_of(const ray_cast::Hit& hit, const glm::dvec3& point) const {
  return meniscus::names_of({surface_, scene_.packed.primitives}, hit, point);
}

}  // namespace meniscus
