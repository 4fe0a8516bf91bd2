// SPDX-License-Identifier: BSD-3-Clause
// Packs, lists, casts tiles on all threads.
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/render/cpu/cpu_tile_lists.h"
#include "core/render/cpu/lane_kernels.h"
#include "core/render/picture_collector.h"
#include "core/render/surface_renderer.h"

namespace meniscus {
namespace {

/// A picture's scene on the host.
struct CpuScene {
  RayCastScene packed;
  ScenePlacement placement;
  std::vector<glm::vec4> colors;
  LaneScene lanes;

  CpuScene(const Surface& surface, const Coloring& coloring, const PictureFrame& frame, const Look& look)
      : packed(pack_scene(surface, coloring, frame)),
        placement(place_atoms(surface.atoms, surface.probe_radius, frame)),
        colors(linear_colors(coloring)) {
    lanes.primitives = packed.primitives.data();
    lanes.rows = packed.rows.data();
    lanes.colors = colors.data();
    lanes.some_hidden = std::ranges::find(coloring.hidden, true) != coloring.hidden.end();
    lanes.params = cast_parameters(placement, look, static_cast<std::uint32_t>(coloring.atom.size()),
                                   coloring.kind.has_value());
  }
};

class CpuRenderer final : public SurfaceRenderer {
 public:
  Framebuffer render(const Surface& surface, const Coloring& coloring, const Camera& camera,
                     const RenderSettings& settings) override {
    validate_camera(camera, "camera");
    clock_ = StageClock(settings.timing);
    const PictureFrame frame = make_picture_frame(surface.atoms, camera, settings.size);
    CpuScene scene = [&] {
      const auto stage = clock_.stage("pack");
      return CpuScene(surface, coloring, frame, settings.look);
    }();
    PictureCollector collector(frame, settings, &surface, scene.packed.primitives);
    const int edge = std::max(settings.block_edge / kTileEdge * kTileEdge, kTileEdge);
    for (const PictureBlock& inner : picture_blocks(settings.size, edge)) {
      const PictureBlock block = with_neighbors(inner, look_reach(settings.look), settings.size);
      cast(scene, frame, block, settings);
      collector.add_colors(inner, block, sums_);
      if (settings.aovs) collector.add_hits(inner, block, hits_);
    }
    return collector.take();
  }

  const std::vector<StageTime>& times() const override { return clock_.times(); }
  std::string device() const override {
    return fmt::format("cpu ({} threads)", tbb::this_task_arena::max_concurrency());
  }

 private:
  void cast(CpuScene& scene, const PictureFrame& frame, const PictureBlock& block, const RenderSettings& settings) {
    {
      const auto stage = clock_.stage("tile lists");
      lists_.build(scene.packed.primitives, frame, block);
    }
    const auto stage = clock_.stage("ray cast");
    const auto pixel_count = static_cast<std::size_t>(block.size.x) * block.size.y;
    sums_.assign(pixel_count, glm::vec4(0.0f));
    if (settings.aovs) hits_.assign(pixel_count, {glm::vec3(0.0f), 0.0f, ray_cast::kNoPrimitive, ray_cast::kNoPrimitive, 0, 0});
    scene.lanes.view = block_view(frame, block, glm::vec2(0.0f));
    tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(lists_.tiles().x) * lists_.tiles().y,
                      [&](std::size_t tile) { cast_tile(scene, tile, settings); });
  }

  void cast_tile(const CpuScene& scene, std::size_t tile, const RenderSettings& settings) {
    const std::span<const std::uint32_t> entries = lists_.entries(tile);
    if (entries.empty()) return;
    LaneTile task;
    const int number = static_cast<int>(tile);
    task.origin = kTileEdge * glm::ivec2(number % lists_.tiles().x, number / lists_.tiles().x);
    task.list = sorted_.local().sort(entries, scene.packed.primitives);
    task.sums = sums_.data();
    for (int first = 0; first < settings.samples; first += LaneTile::kMostSamples) {
      task.sample_count = std::min(LaneTile::kMostSamples, settings.samples - first);
      for (int n = 0; n < task.sample_count; ++n) task.offset[n] = sample_offset(first + n);
      task.hits = settings.aovs && first == 0 ? hits_.data() : nullptr;
      kernels_.cast_tile(scene.lanes, task);
    }
  }

  const LaneKernels& kernels_ = widest_kernels();
  StageClock clock_;
  CpuTileLists lists_;
  tbb::enumerable_thread_specific<SortedList> sorted_;
  std::vector<glm::vec4> sums_;
  std::vector<ray_cast::Hit> hits_;
};

}  // namespace

std::unique_ptr<SurfaceRenderer> make_cpu_renderer() { return std::make_unique<CpuRenderer>(); }

const LaneKernels& widest_kernels() {
  for (const LaneKernels* kernels : {kernels_of_16_lanes(), kernels_of_8_lanes()})
    if (kernels) return *kernels;
  return *kernels_of_4_lanes();
}

}  // namespace meniscus
