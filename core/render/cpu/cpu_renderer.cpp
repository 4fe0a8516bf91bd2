// SPDX-License-Identifier: BSD-3-Clause
// Draws pictures on the CPU: packs surfaces, lists them by tile, casts the tiles on all threads.
#include "core/render/cpu/cpu_renderer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/image/color_space.h"
#include "core/queries/copies.h"
#include "core/render/cpu/interruption.h"
#include "core/render/linear_colors.h"
#include "core/render/picture_block.h"
#include "core/render/shape_packing.h"

namespace meniscus {
namespace {

/// Formulas of the shared sources.
struct SeenThrough {
  using vec3 = glm::vec3;
  using vec4 = glm::vec4;
#include "gpu_shaders/look/seen_through.glsl"
};

constexpr ray_cast::Hit kNoHit{glm::vec3(0.0f), 0.0f, ray_cast::kNoPrimitive, ray_cast::kNoPrimitive, 0, 0};

/// In whole tiles.
int block_edge(const RenderSettings& settings) {
  return std::max(settings.block_edge / kTileEdge * kTileEdge, kTileEdge);
}

}  // namespace

void CpuRenderer::BlockSamples::resize(std::size_t pixel_count, bool has_marks, bool has_layers) {
  color.assign(pixel_count + 1, glm::vec4(0.0f));
  depth.assign(pixel_count + 1, kernel::kNothing);
  for (std::vector<float>& axis : normal) axis.assign(pixel_count + 1, 0.0f);
  mark.assign(has_marks ? pixel_count + 1 : 0, 0.0f);
  over.assign(has_layers ? pixel_count + 1 : 0, glm::vec4(0.0f));
  visibility.assign(pixel_count + 1, 1.0f);
}

LaneSamples CpuRenderer::BlockSamples::lanes(bool has_visibility) {
  return {color.data(),
          depth.data(),
          {normal[0].data(), normal[1].data(), normal[2].data()},
          has_visibility ? visibility.data() : nullptr,
          mark.empty() ? nullptr : mark.data(),
          over.empty() ? nullptr : over.data()};
}

void CpuRenderer::begin(const Camera& camera, const RenderSettings& settings) {
  assert(settings.size.x > 0 && settings.size.y > 0 && settings.samples > 0);
  validate_camera(camera, "camera");
  drawn_ = false;
  places_.clear();
  layers_.reset();
  occluders_.reset();
  scene_.lanes.light = nullptr;
  clock_ = StageClock(settings.timing);
}

template <typename Object>
void CpuRenderer::trace_light(std::span<const Object> objects, float slack, const RenderSettings& settings) {
  if (!settings.look.traces_light()) return;
  const auto stage = clock_.stage("occluders");
  occluders_.emplace(frame_.pivot, slack);
  for (const Object& object : objects) occluders_->add(object);
  occluders_->aim(settings.look, frame_.basis, settings.samples);
}

void CpuRenderer::pack(const Surface& surface, const Coloring& coloring, const Camera& camera,
                       const RenderSettings& settings) {
  begin(camera, settings);
  {
    const auto stage = clock_.stage("pack");
    frame_ = make_picture_frame(surface.atoms, camera, settings.size);
    pack_scene(surface, coloring, frame_, scene_.packed);
    scene_.placement = place_atoms(surface.atoms, surface.probe_radius, frame_);
    scene_.colors = linear_colors(coloring);
    const std::vector<std::uint32_t> marks = coloring.line_marks();
    scene_.marks.assign(marks.begin(), marks.end());
    scene_.lanes.paint = {};
    scene_.keeps_color.clear();
    scene_.add_paint(coloring, frame_.pivot);
    scene_.connect(settings.look, coloring.kind.has_value(), coloring.hides_some());
  }
  PictureObject whole;
  whole.surface = &surface;
  whole.coloring = &coloring;
  trace_light(std::span<const PictureObject>(&whole, 1), scene_.placement.slack, settings);
  scene_.lanes.light = light();
}

Framebuffer CpuRenderer::render(const Surface& surface, const Coloring& coloring, const Camera& camera,
                                const RenderSettings& settings) {
  pack(surface, coloring, camera, settings);
  const HitSource source{&surface, scene_.packed.primitives};
  PictureCollector collector(frame_, settings, names_of({&source, 1}));
  const std::vector<PictureBlock> blocks = collector.blocks(block_edge(settings));
  BlockProgress progress(settings, blocks.size());
  if (needs_shade_map(blocks.front(), settings))
    cast_shade_map(shade_map_frame(frame_), settings, progress.interruption());
  for (const PictureBlock& inner : blocks) {
    const PictureBlock block = with_neighbors(inner, look_reach(settings.look, settings.size), settings.size);
    cast_into(collector, inner, {frame_, block, settings, settings.aovs}, progress.interruption());
    progress.end_block();
  }
  return collector.take();
}

ScenePlacement CpuRenderer::place_copies(std::span<const SurfaceObject> objects, const Camera& camera,
                                         const RenderSettings& settings) {
  begin(camera, settings);
  const auto stage = clock_.stage("frame");
  const std::vector<BallGroup> groups = ball_groups(objects);
  frame_ = make_picture_frame(groups, camera, settings.size);
  const ScenePlacement placement = place_atoms(groups, objects.front().surface.probe_radius, frame_);
  trace_light(objects, placement.slack, settings);
  return placement;
}

void CpuRenderer::cast_shade_map_of_copies(std::span<const SurfaceObject> objects, const ScenePlacement& placement,
                                           const RenderSettings& settings, Interruption& interruption) {
  const PictureFrame map = shade_map_frame(frame_);
  {
    const auto stage = clock_.stage("visible copies");
    VisibleCopies(objects, map, placement, kernels_, patches_together_)
        .find({{0, 0}, map.size}, 1, settings.look, scene_, [&] { return interruption.came(); });
  }
  cast_shade_map(map, settings, interruption);
}

Framebuffer CpuRenderer::render_copies(std::span<const SurfaceObject> objects, const Camera& camera,
                                       const RenderSettings& settings) {
  assert(!objects.empty());
  const ScenePlacement placement = place_copies(objects, camera, settings);
  VisibleCopies copies(objects, frame_, placement, kernels_, patches_together_);
  PictureCollector collector(
      frame_, settings,
      [&](const ray_cast::Hit& hit, const glm::dvec3& point) {
        return copies.names_of(hit, scene_.packed.primitives[hit.primitive], point);
      },
      false, [&](const ray_cast::Hit& hit) { return copies.atom_of(hit); });
  const std::vector<PictureBlock> blocks = collector.blocks(block_edge(settings));
  BlockProgress progress(settings, blocks.size());
  if (needs_shade_map(blocks.front(), settings))
    cast_shade_map_of_copies(objects, placement, settings, progress.interruption());
  for (const PictureBlock& inner : blocks) {
    const PictureBlock block = with_neighbors(inner, look_reach(settings.look, settings.size), settings.size);
    {
      const auto stage = clock_.stage("visible copies");
      scene_.lanes.light = nullptr;  // what shows does not depend on it
      copies.find(block, settings.samples, settings.look, scene_);
      scene_.lanes.light = light();
    }
    cast_into(collector, inner, {frame_, block, settings, settings.aovs}, progress.interruption());
    progress.end_block();
  }
  return collector.take();
}

ScenePlacement CpuRenderer::place(std::span<const PictureObject> objects, const Camera& camera,
                                  const RenderSettings& settings) {
  begin(camera, settings);
  const std::vector<Ball> balls = enclosing_balls(objects);
  double probe_radius = 0.0;
  for (const PictureObject& object : objects)
    if (object.surface) probe_radius = std::max(probe_radius, object.surface->probe_radius);
  frame_ = make_picture_frame(balls, camera, settings.size);
  ScenePlacement placement = place_atoms(balls, probe_radius, frame_);
  const std::vector<Ball> kept = kept_balls(objects);
  if (kept.empty() || kept.size() == balls.size()) return placement;
  // Air begins where a cut picture does.
  const ScenePlacement seen = place_atoms(kept, probe_radius, frame_);
  placement.first_depth = seen.first_depth;
  placement.last_depth = seen.last_depth;
  return placement;
}

Framebuffer CpuRenderer::render(std::span<const PictureObject> objects, const Camera& camera,
                                const RenderSettings& settings) {
  assert(!objects.empty());
  if (objects.size() == 1 && !needs_layers(objects.front()))
    return render(*objects.front().surface, *objects.front().coloring, camera, settings);
  scene_.placement = place(objects, camera, settings);
  std::optional<LayeredScene> layers;
  {
    const auto stage = clock_.stage("pack");
    layers.emplace(objects, frame_, scene_.placement, settings.look);
  }
  trace_light(objects, scene_.placement.slack, settings);
  layers->set_light(light());
  RenderSettings finish = settings;
  if (layers->casts_highlights()) finish.look.material.specular = 0.0f;
  std::vector<HitSource> sources;
  for (std::size_t n = 0; n < objects.size(); ++n) sources.push_back(layers->source(n));
  PictureCollector collector(frame_, settings, names_of(sources), sources.size() > 1);
  const std::vector<PictureBlock> blocks = collector.blocks(block_edge(settings));
  BlockProgress progress(settings, blocks.size());
  if (needs_shade_map(blocks.front(), finish))
    cast_shade_map(shade_map_frame(frame_), finish, progress.interruption(), &*layers);
  for (const PictureBlock& inner : blocks) {
    const PictureBlock block = with_neighbors(inner, look_reach(settings.look, settings.size), settings.size);
    cast_into(collector, inner, {frame_, block, finish, settings.aovs, &*layers}, progress.interruption());
    progress.end_block();
  }
  return collector.take();
}

bool CpuRenderer::draw(const Surface& surface, const Coloring& coloring, const Camera& camera,
                       const RenderSettings& settings, const std::function<bool()>& stop) {
  pack(surface, coloring, camera, settings);
  Interruption interruption(stop);
  const PictureBlock whole{{0, 0}, settings.size};
  if (needs_shade_map(whole, settings)) cast_shade_map(shade_map_frame(frame_), settings, interruption);
  cast({frame_, whole, settings, true}, interruption);
  if (interruption.came()) return false;
  present(settings);
  drawn_ = true;
  return true;
}

bool CpuRenderer::draw_copies(std::span<const SurfaceObject> objects, const Camera& camera,
                              const RenderSettings& settings, const std::function<bool()>& stop) {
  assert(!objects.empty());
  Interruption interruption(stop);
  const ScenePlacement placement = place_copies(objects, camera, settings);
  const PictureBlock whole{{0, 0}, settings.size};
  if (needs_shade_map(whole, settings)) cast_shade_map_of_copies(objects, placement, settings, interruption);
  if (interruption.came()) return false;
  VisibleCopies copies(objects, frame_, placement, kernels_, patches_together_);
  {
    const auto stage = clock_.stage("visible copies");
    copies.find(whole, settings.samples, settings.look, scene_, [&] { return interruption.came(); });
  }
  if (interruption.came()) return false;
  scene_.lanes.light = light();
  cast({frame_, whole, settings, true}, interruption);
  if (interruption.came()) return false;
  present(settings);
  places_ = copies.places();
  drawn_ = true;
  return true;
}

bool CpuRenderer::draw(std::span<const PictureObject> objects, const Camera& camera, const RenderSettings& settings,
                       const std::function<bool()>& stop) {
  assert(!objects.empty());
  if (objects.size() == 1 && !needs_layers(objects.front()))
    return draw(*objects.front().surface, *objects.front().coloring, camera, settings, stop);
  scene_.placement = place(objects, camera, settings);
  {
    const auto stage = clock_.stage("pack");
    layers_.emplace(objects, frame_, scene_.placement, settings.look);
  }
  trace_light(objects, scene_.placement.slack, settings);
  layers_->set_light(light());
  Interruption interruption(stop);
  const PictureBlock whole{{0, 0}, settings.size};
  if (needs_shade_map(whole, settings)) cast_shade_map(shade_map_frame(frame_), settings, interruption, &*layers_);
  cast({frame_, whole, settings, true, &*layers_}, interruption);
  if (interruption.came()) return false;
  present(settings);
  drawn_ = true;
  return true;
}

void CpuRenderer::present(const RenderSettings& settings) {
  const auto stage = clock_.stage("finish");
  const float per_sample = 1.0f / static_cast<float>(settings.samples);
  const auto width = static_cast<std::size_t>(settings.size.x);
  size_ = settings.size;
  rgba_.resize(4 * sums_.size());
  tbb::parallel_for(0, settings.size.y, [&](int y) {
    const std::span<glm::vec4> row = std::span(sums_).subspan(static_cast<std::size_t>(y) * width, width);
    for (glm::vec4& sum : row) sum *= per_sample;
    display_bytes(row, settings.look.background, 4, &rgba_[4 * static_cast<std::size_t>(y) * width]);
  });
}

std::optional<PickedPoint> CpuRenderer::pick(glm::ivec2 pixel) const {
  if (!drawn_ || pixel.x < 0 || pixel.y < 0 || pixel.x >= size_.x || pixel.y >= size_.y) return {};
  const ray_cast::Hit& hit = hits_[static_cast<std::size_t>(pixel.y) * size_.x + pixel.x];
  if (hit.primitive == ray_cast::kNoPrimitive) return {};
  PickedPoint point{hit.atom, {}, hit_point(frame_, pixel, hit.t).position};
  if (layers_) point.object = hit.object;
  if (hit.primitive == ray_cast::kOnPlane) return point;
  const HitSource source = layers_ ? layers_->source(hit.object) : HitSource{};
  if (layers_ && !source.surface) return point;
  const auto primitives = layers_ ? source.primitives : std::span<const ray_cast::Primitive>(scene_.packed.primitives);
  point.kind = static_cast<PatchKind>(primitives[hit.primitive].kind);
  if (places_.empty()) return point;
  const CopyPlace& place = places_[place_of(places_, hit.atom)];
  point.atom -= place.first_atom;
  point.object = place.object;
  point.copy = place.copy;
  return point;
}

std::string CpuRenderer::device() const {
  const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  const auto threads = std::min(static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()), allowed);
  return fmt::format("cpu ({} {})", threads, threads == 1 ? "thread" : "threads");
}

void CpuRenderer::start_block(const PictureFrame& frame, const PictureBlock& block, LayeredScene* layers) {
  const auto stage = clock_.stage("tile lists");
  if (layers)
    layers->begin_block(frame, block);
  else
    lists_.build(scene_.packed.primitives, frame, block);
  scene_.lanes.view = block_view(frame, block, glm::vec2(0.0f));
}

void CpuRenderer::cast_shade_map(const PictureFrame& map, const RenderSettings& settings, Interruption& interruption,
                                 LayeredScene* layers) {
  const PictureBlock whole{{0, 0}, map.size};
  start_block(map, whole, layers);
  const bool has_marks = layers ? layers->has_marks() : !scene_.marks.empty();
  const auto texel_count = static_cast<std::size_t>(map.size.x) * map.size.y;
  samples_.resize(texel_count, has_marks, layers != nullptr);
  const bool has_front = layers && layers->shows_through();
  if (has_front) front_.resize(texel_count, has_marks, false);
  RenderSettings depths = settings;
  depths.look.ambient_occlusion_rays = 0.0f;
  const auto light_through = [&](const LaneLight* light) {
    if (layers)
      layers->set_light(light);
    else
      scene_.lanes.light = light;
  };
  light_through(nullptr);
  cast_samples(0, 1, {map, whole, depths, false, layers}, interruption);
  light_through(light());
  shade_map_.swap(samples_.depth);
  if (has_front) front_shade_map_.swap(front_.depth);
}

void CpuRenderer::cast(const BlockTask& task, Interruption& interruption) {
  start_block(task.frame, task.block, task.layers);
  const auto pixel_count = static_cast<std::size_t>(task.block.size.x) * task.block.size.y;
  const Look& look = task.settings.look;
  sums_.assign(pixel_count, glm::vec4(0.0f));
  if (task.hits) hits_.assign(pixel_count, kNoHit);
  const int step = look.has_effects() || task.after_sample ? 1 : LaneTile::kMostSamples;
  const bool has_marks = task.layers ? task.layers->has_marks() : !scene_.marks.empty();
  const bool has_front = task.layers && task.layers->shows_through();
  if (look.has_effects()) samples_.resize(pixel_count, has_marks, task.layers != nullptr);
  if (look.has_effects() && has_front) front_.resize(pixel_count, has_marks, false);
  for (int first = 0; first < task.settings.samples && !interruption.came(); first += step) {
    interruption.note(first, task.settings.samples);
    if (task.after_sample && first > 0) hits_.assign(pixel_count, kNoHit);
    cast_samples(first, std::min(step, task.settings.samples - first), task, interruption);
    if (task.after_sample) task.after_sample(first);
    if (!look.has_effects()) continue;
    if (look.ambient_occlusion > 0.0f && !look.traces_sky() && first == 0 &&
        holds_shade_map(task.block, task.settings.size)) {
      shade_map_ = samples_.depth;
      if (has_front) front_shade_map_ = front_.depth;
    }
    look_at(first, task.settings, has_marks, has_front, interruption);
  }
}

void CpuRenderer::cast_into(PictureCollector& collector, const PictureBlock& inner, BlockTask task,
                            Interruption& interruption) {
  const bool aovs = task.settings.aovs, mattes = task.settings.mattes;
  const PictureBlock block = task.block;
  task.hits = aovs || mattes;
  if (mattes)
    task.after_sample = [&](int sample) {
      if (aovs && sample == 0) collector.add_hits(inner, block, hits_);
      collector.add_seen(inner, block, hits_, sample);
    };
  cast(task, interruption);
  collector.add_colors(inner, block, sums_);
  if (aovs && !mattes) collector.add_hits(inner, block, hits_);
  collector.end_block(inner);
}

void CpuRenderer::cast_samples(int first, int count, const BlockTask& task, Interruption& interruption) {
  const auto stage = clock_.stage("ray cast");
  LaneTile samples;
  samples.first_sample = first;
  samples.sample_count = count;
  for (int n = 0; n < count; ++n) samples.offset[n] = sample_offset(first + n);
  samples.hits = task.hits && (first == 0 || task.after_sample) ? hits_.data() : nullptr;
  if (task.settings.look.has_effects())
    samples.samples = samples_.lanes(task.settings.look.traces_sky());
  else
    samples.sums = sums_.data();
  if (task.settings.look.has_effects() && task.layers && task.layers->shows_through())
    samples.front = front_.lanes(task.settings.look.traces_sky());
  const glm::ivec2 tiles = tile_counts(task.block);
  for_each_until(interruption, tiles.x * tiles.y, [&](int tile) {
    if (task.layers)
      task.layers->cast_tile(static_cast<std::size_t>(tile), samples, kernels_);
    else
      cast_tile(static_cast<std::size_t>(tile), samples);
  });
}

void CpuRenderer::cast_tile(std::size_t tile, LaneTile task) {
  const std::span<std::uint32_t> entries = lists_.entries(tile);
  if (entries.empty()) return;
  const int number = static_cast<int>(tile);
  task.origin = kTileEdge * glm::ivec2(number % lists_.tiles().x, number / lists_.tiles().x);
  task.list = sorted_.local().sort(entries, scene_.packed.primitives);
  kernels_.cast_tile(scene_.lanes, task);
}

void CpuRenderer::look_at(int sample, const RenderSettings& settings, bool has_marks, bool has_front,
                          Interruption& interruption) {
  const auto stage = clock_.stage("look");
  const Look& look = settings.look;
  LaneLook task;
  task.view = scene_.lanes.view;
  task.view.sample_offset = sample_offset(sample);
  task.occlusion = occlusion_parameters(look, settings.size, sample);
  task.finish = finish_parameters(look, scene_.placement, settings.size, sample, has_marks);
  task.samples = samples_.lanes(look.traces_sky());
  task.shade_map = shade_map_.data();
  task.sums = sums_.data();
  if (has_front) look_at_front(sample, task, settings, interruption);
  find_shade(samples_, sample, look, task, interruption);
  for_each_until(interruption, task.view.size.y, [&](int y) { kernels_.finish_row(task, y); });
}

void CpuRenderer::find_shade(BlockSamples& samples, int sample, const Look& look, LaneLook& task,
                             Interruption& interruption) {
  task.visibility = samples.visibility.data();
  task.shade_depth = samples.depth.data();
  if (look.ambient_occlusion == 0.0f) return;
  samples.shade_size.resize(samples.depth.size());
  task.shade_size = samples.shade_size.data();
  const auto for_each_row = [&](const auto& kernel) {
    for_each_until(interruption, task.view.size.y, [&](int y) { kernel(task, y); });
  };
  if (look.traces_sky()) return for_each_row(kernels_.measure_row);
  const bool is_new = sample == shade_sample(sample);
  if (is_new) samples.shade_depth = samples.depth;
  task.shade_depth = samples.shade_depth.data();
  if (!is_new) return;
  for_each_row(kernels_.measure_row);
  for_each_row(kernels_.occlude_row);
}

void CpuRenderer::look_at_front(int sample, LaneLook task, const RenderSettings& settings, Interruption& interruption) {
  const glm::ivec2 size = task.view.size;
  const std::size_t pixel_count = static_cast<std::size_t>(size.x) * size.y;
  front_sums_.assign(pixel_count, glm::vec4(0.0f));
  front_ink_.assign(pixel_count, 0.0f);
  task.samples = front_.lanes(settings.look.traces_sky());
  task.finish.specular = 0.0f;  // highlights are in what is cast
  task.shade_map = front_shade_map_.data();
  task.sums = front_sums_.data();
  task.ink = front_ink_.data();
  find_shade(front_, sample, settings.look, task, interruption);
  for_each_until(interruption, size.y, [&](int y) { kernels_.finish_row(task, y); });
  const int reach = static_cast<int>(std::ceil(0.5f * settings.look.widest_line() + 0.5f));
  for_each_until(interruption, size.y, [&](int y) {
    for (int x = 0; x < size.x; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * size.x + x;
      const glm::vec4& color = front_.color[at];
      glm::vec4& over = samples_.over[at];
      if (color.w > 0.0f) {
        over = SeenThrough().with_finished_front(over, color, front_sums_[at]);
        continue;
      }
      if (front_ink_[at] == 0.0f) continue;
      float nearby = 0.0f;  // a line beside it is as opaque as it is there
      for (int row = std::max(y - reach, 0); row <= std::min(y + reach, size.y - 1); ++row)
        for (int column = std::max(x - reach, 0); column <= std::min(x + reach, size.x - 1); ++column)
          nearby = std::max(nearby, front_.color[static_cast<std::size_t>(row) * size.x + column].w);
      over = SeenThrough().under_ink(over, front_ink_[at] * nearby);
    }
  });
}

std::unique_ptr<SurfaceRenderer> make_cpu_renderer(int most_lanes) { return std::make_unique<CpuRenderer>(most_lanes); }

const LaneKernels& widest_kernels(int most_lanes) {
  for (const LaneKernels* kernels : {kernels_of_16_lanes(), kernels_of_8_lanes()})
    if (kernels && kernels->lanes <= most_lanes) return *kernels;
  return *kernels_of_4_lanes();
}

}  // namespace meniscus
