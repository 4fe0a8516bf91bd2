// SPDX-License-Identifier: BSD-3-Clause
// Packs, lists, casts tiles on all threads.
#include <algorithm>
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
  std::vector<float> parts;  // whole numbers that a float holds exactly: only their difference counts
  LaneScene lanes;

  CpuScene(const Surface& surface, const Coloring& coloring, const PictureFrame& frame, const Look& look)
      : packed(pack_scene(surface, coloring, frame)),
        placement(place_atoms(surface.atoms, surface.probe_radius, frame)),
        colors(linear_colors(coloring)),
        parts(coloring.part.begin(), coloring.part.end()) {
    lanes.primitives = packed.primitives.data();
    lanes.rows = packed.rows.data();
    lanes.colors = colors.data();
    lanes.parts = parts.data();
    lanes.some_hidden = std::ranges::find(coloring.hidden, true) != coloring.hidden.end();
    lanes.params =
        cast_parameters(placement, look, static_cast<std::uint32_t>(coloring.atom.size()), coloring.kind.has_value());
  }
};

constexpr ray_cast::Hit kNoHit{glm::vec3(0.0f), 0.0f, ray_cast::kNoPrimitive, ray_cast::kNoPrimitive, 0, 0};

/// One sample of each pixel of a block and, behind the last, of what lies outside. Tiles that list nothing are never
/// written, so that one beginning does for all samples.
struct BlockSamples {
  std::vector<glm::vec4> color;
  std::vector<float> depth, normal[3], part, visibility;

  void resize(std::size_t pixel_count, bool has_parts) {
    color.assign(pixel_count + 1, glm::vec4(0.0f));
    depth.assign(pixel_count + 1, kernel::kNothing);
    for (std::vector<float>& axis : normal) axis.assign(pixel_count + 1, 0.0f);
    part.assign(has_parts ? pixel_count + 1 : 0, 0.0f);
    visibility.assign(pixel_count + 1, 1.0f);
  }

  LaneSamples lanes() {
    return {color.data(),
            depth.data(),
            {normal[0].data(), normal[1].data(), normal[2].data()},
            part.empty() ? nullptr : part.data()};
  }
};

class CpuRenderer final : public SurfaceRenderer {
 public:
  explicit CpuRenderer(int most_lanes) : kernels_(widest_kernels(most_lanes)) {}

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
    const auto pixel_count = static_cast<std::size_t>(block.size.x) * block.size.y;
    sums_.assign(pixel_count, glm::vec4(0.0f));
    if (settings.aovs) hits_.assign(pixel_count, kNoHit);
    scene.lanes.view = block_view(frame, block, glm::vec2(0.0f));
    const int step = settings.look.has_effects() ? 1 : LaneTile::kMostSamples;
    if (settings.look.has_effects()) samples_.resize(pixel_count, !scene.parts.empty());
    for (int first = 0; first < settings.samples; first += step) {
      cast_samples(scene, first, std::min(step, settings.samples - first), settings);
      if (settings.look.has_effects()) look_at(scene, first, settings.look);
    }
  }

  void cast_samples(const CpuScene& scene, int first, int count, const RenderSettings& settings) {
    const auto stage = clock_.stage("ray cast");
    LaneTile samples;
    samples.sample_count = count;
    for (int n = 0; n < count; ++n) samples.offset[n] = sample_offset(first + n);
    samples.hits = settings.aovs && first == 0 ? hits_.data() : nullptr;
    if (settings.look.has_effects())
      samples.samples = samples_.lanes();
    else
      samples.sums = sums_.data();
    tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(lists_.tiles().x) * lists_.tiles().y,
                      [&](std::size_t tile) { cast_tile(scene, tile, samples); });
  }

  void cast_tile(const CpuScene& scene, std::size_t tile, LaneTile task) {
    const std::span<const std::uint32_t> entries = lists_.entries(tile);
    if (entries.empty()) return;
    const int number = static_cast<int>(tile);
    task.origin = kTileEdge * glm::ivec2(number % lists_.tiles().x, number / lists_.tiles().x);
    task.list = sorted_.local().sort(entries, scene.packed.primitives);
    kernels_.cast_tile(scene.lanes, task);
  }

  void look_at(const CpuScene& scene, int sample, const Look& look) {
    const auto stage = clock_.stage("look");
    LaneLook task;
    task.view = scene.lanes.view;
    task.view.sample_offset = sample_offset(sample);
    task.occlusion = occlusion_parameters(look, sample);
    task.finish = finish_parameters(look, scene.placement, sample, !scene.parts.empty());
    task.samples = samples_.lanes();
    task.visibility = samples_.visibility.data();
    task.sums = sums_.data();
    if (look.ambient_occlusion > 0.0f)
      tbb::parallel_for(0, task.view.size.y, [&](int y) { kernels_.occlude_row(task, y); });
    tbb::parallel_for(0, task.view.size.y, [&](int y) { kernels_.finish_row(task, y); });
  }

  const LaneKernels& kernels_;
  StageClock clock_;
  CpuTileLists lists_;
  tbb::enumerable_thread_specific<SortedList> sorted_;
  std::vector<glm::vec4> sums_;
  std::vector<ray_cast::Hit> hits_;
  BlockSamples samples_;
};

}  // namespace

std::unique_ptr<SurfaceRenderer> make_cpu_renderer(int most_lanes) { return std::make_unique<CpuRenderer>(most_lanes); }

const LaneKernels& widest_kernels(int most_lanes) {
  for (const LaneKernels* kernels : {kernels_of_16_lanes(), kernels_of_8_lanes()})
    if (kernels && kernels->lanes <= most_lanes) return *kernels;
  return *kernels_of_4_lanes();
}

}  // namespace meniscus
