// SPDX-License-Identifier: BSD-3-Clause
// Draws pictures on the CPU: packs scenes, casts the tiles of their blocks on all threads, and finishes samples.
#include "core/render/cpu/cpu_renderer.h"

#include <cassert>
#include <numbers>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "core/image/color_space.h"
#include "core/queries/copies.h"
#include "core/render/cpu/interruption.h"
#include "core/render/cpu/layer_stack.h"

namespace meniscus {
namespace {

/// The formulas of the shared sources for transparent surfaces.
struct SeenThrough {
  using vec3 = glm::vec3;
  using vec4 = glm::vec4;
#include "gpu_shaders/look/seen_through.glsl"
};

constexpr ray_cast::Hit kNoHit{glm::vec3(0.0f), 0.0f, ray_cast::kNoPrimitive, ray_cast::kNoPrimitive, 0, 0};

/// Returns the width of the thinnest thing that objects have, in Å, such as the diameter of a stick.
double least_width(const Surface* surface, const Shapes* shapes) {
  constexpr double kLeastThickness = 0.4;  // thickness of ribbons and plates
  double least = std::numeric_limits<double>::infinity();
  if (surface)
    for (const Ball& atom : surface->atoms) least = std::min(least, 2.0 * atom.radius);
  if (!shapes) return least;
  for (const SphereShape& sphere : shapes->spheres) least = std::min(least, 2.0 * sphere.radius);
  for (const CylinderShape& cylinder : shapes->cylinders) least = std::min(least, 2.0 * cylinder.radius);
  return shapes->mesh.triangles.empty() ? least : std::min(least, kLeastThickness);
}

/// True if no pixel has a diagonal longer than `width`, Å, so that nothing of this width lies between their centres.
bool all_pixels_are_narrower(double width, const PictureFrame& frame, const PackPlacement& placement) {
  const bool is_perspective = frame.camera.projection == Projection::perspective;
  const double farthest = is_perspective ? std::max(placement.last_depth / frame.eye_distance, 1.0) : 1.0;
  return width >= std::numbers::sqrt2 * frame.pixel_size * farthest;
}

/// True if samples may be left out where the first ones are even. Rays that light is traced by differ among samples.
bool is_adaptive(const RenderSettings& settings) {
  return settings.adaptive && settings.samples > 1 && !settings.look.traces_light();
}

/// Returns how far around a block pixels determine its colours, in whole tiles. Uneven bundles depend on the finished
/// pixels around them, and a pixel on the unevenness of the bundles that its look reads.
int block_reach(const RenderSettings& settings) {
  const Look& look = settings.look;
  const int line_reach = static_cast<int>(std::ceil(0.5f * look.widest_line()));
  const int compared = is_adaptive(settings) ? 2 * (line_reach + kBundleEdge + 1) : 0;
  return std::max(look_reach(look), (compared + kTileEdge - 1) / kTileEdge * kTileEdge);
}

/// Returns the edge of a block, in whole tiles.
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
  sky_seen.assign(pixel_count + 1, 1.0f);
  lamp_seen.assign(pixel_count + 1, 1.0f);
}

LaneSamples CpuRenderer::BlockSamples::lanes(bool has_visibility) {
  return {color.data(),
          depth.data(),
          {normal[0].data(), normal[1].data(), normal[2].data()},
          has_visibility ? sky_seen.data() : nullptr,
          mark.empty() ? nullptr : mark.data(),
          over.empty() ? nullptr : over.data()};
}

void CpuRenderer::begin(const Camera& camera, const RenderSettings& settings) {
  assert(settings.size.x > 0 && settings.size.y > 0 && settings.samples > 0);
  validate_camera(camera, "camera");
  drawn_.reset();
  occluders_.reset();
  clock_ = StageClock(settings.timing);
}

void CpuRenderer::place(std::span<const PictureObject> objects, const Camera& camera, glm::ivec2 size) {
  const auto stage = clock_.stage("frame");
  const std::vector<Ball> balls = enclosing_balls(objects);
  double probe_radius = 0.0;
  for (const PictureObject& object : objects)
    if (object.surface) probe_radius = std::max(probe_radius, object.surface->probe_radius);
  frame_ = make_picture_frame(balls, camera, size);
  placement_ = place_atoms(balls, probe_radius, frame_);
  double width = std::numeric_limits<double>::infinity();
  for (const PictureObject& object : objects) width = std::min(width, least_width(object.surface, object.shapes));
  nothing_is_thin_ = all_pixels_are_narrower(width, frame_, placement_);
  const std::vector<Ball> kept = kept_balls(objects);
  if (kept.empty() || kept.size() == balls.size()) return;
  // The depth cue of a picture with cuts begins at the part that is kept.
  const PackPlacement seen = place_atoms(kept, probe_radius, frame_);
  placement_.first_depth = seen.first_depth;
  placement_.last_depth = seen.last_depth;
}

template <typename Object>
void CpuRenderer::trace_light(std::span<const Object> objects, const RenderSettings& settings) {
  const auto stage = clock_.stage("light");
  if (settings.look.maps_sky() || settings.look.maps_lamp()) {
    light_maps_.begin();
    for (const Object& object : objects) light_maps_.add(object);
    light_maps_.make(settings.look, frame_.basis);
  }
  if (!settings.look.traces_light()) return;
  occluders_.emplace(frame_.pivot, placement_.slack);
  for (const Object& object : objects) occluders_->add(object);
  occluders_->aim(settings.look, frame_.basis, settings.samples);
}

std::shared_ptr<PictureContent> CpuRenderer::pack(std::span<const PictureObject> objects, const Camera& camera,
                                                  const RenderSettings& settings) {
  assert(!objects.empty());
  begin(camera, settings);
  place(objects, camera, settings.size);
  trace_light(objects, settings);
  const auto stage = clock_.stage("pack");
  const PictureObject& first = objects.front();
  if (objects.size() > 1 || needs_layers(first))
    return std::make_shared<LayerStack>(objects, frame_, placement_, settings.look);
  surface_->pack(first, frame_, placement_, settings.look);
  return surface_;
}

std::shared_ptr<PictureContent> CpuRenderer::pack_copies(std::span<const SurfaceObject> objects, const Camera& camera,
                                                         const RenderSettings& settings) {
  assert(!objects.empty());
  begin(camera, settings);
  {
    const auto stage = clock_.stage("frame");
    const std::vector<BallGroup> groups = ball_groups(objects);
    frame_ = make_picture_frame(groups, camera, settings.size);
    placement_ = place_atoms(groups, objects.front().surface.probe_radius, frame_);
    double width = std::numeric_limits<double>::infinity();
    for (const SurfaceObject& object : objects) width = std::min(width, least_width(&object.surface, nullptr));
    nothing_is_thin_ = all_pixels_are_narrower(width, frame_, placement_);
  }
  trace_light(objects, settings);
  return std::make_shared<VisibleCopies>(objects, frame_, placement_, settings.look, kernels_, patches_together_);
}

Framebuffer CpuRenderer::render(PictureContent& scene, const RenderSettings& settings) {
  PictureCollector collector(
      frame_, settings, [&](const ray_cast::Hit& hit, const glm::dvec3& point) { return scene.names_of(hit, point); },
      scene.content().several_objects, [&](const ray_cast::Hit& hit) { return scene.atom_of(hit); });
  const std::vector<PictureBlock> blocks = collector.blocks(block_edge(settings));
  BlockProgress progress(settings, blocks.size());
  for (const PictureBlock& inner : blocks) {
    const PictureBlock block = with_neighbors(inner, block_reach(settings), settings.size);
    BlockTask task{scene, {frame_, block, settings.samples, light()}, settings, settings.aovs || settings.mattes};
    if (settings.mattes)
      task.after_sample = [&](int sample) {
        if (settings.aovs && sample == 0) collector.add_hits(inner, block, hits_);
        collector.add_seen(inner, block, hits_, sample);
      };
    cast(task, progress.interruption());
    collector.add_colors(inner, block, sums_);
    if (settings.aovs && !settings.mattes) collector.add_hits(inner, block, hits_);
    collector.end_block(inner);
    progress.end_block();
  }
  return collector.take();
}

bool CpuRenderer::draw(std::shared_ptr<PictureContent> scene, const RenderSettings& settings,
                       const std::function<bool()>& stop) {
  Interruption interruption(stop);
  const PictureBlock whole{{0, 0}, settings.size};
  cast({*scene, {frame_, whole, settings.samples, light()}, settings, true}, interruption);
  if (interruption.came()) return false;
  present(settings);
  drawn_ = std::move(scene);
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
  PickedPoint point = drawn_->picked(hit);
  point.position = hit_point(frame_, pixel, hit.t).position;
  return point;
}

std::string CpuRenderer::device() {
  const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  const auto threads = std::min(static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()), allowed);
  return fmt::format("cpu ({} {})", threads, threads == 1 ? "thread" : "threads");
}

void CpuRenderer::resize_samples(const BlockTask& task) {
  const SceneContent content = task.scene.content();
  samples_.resize(task.pixel_count(), content.marks, content.layers);
  if (content.shows_through) front_.resize(task.pixel_count(), content.marks, false);
}

void CpuRenderer::cast(const BlockTask& task, Interruption& interruption) {
  task.scene.begin_block(task.at, interruption, clock_);
  const Look& look = task.settings.look;
  sums_.assign(task.pixel_count(), glm::vec4(0.0f));
  if (task.hits) hits_.assign(task.pixel_count(), kNoHit);
  const int samples = task.settings.samples;
  const bool leaves_out = is_adaptive(task.settings) && !task.after_sample && nothing_is_thin_;
  uneven_.reset();
  if (look.has_effects()) resize_samples(task);
  for (int first = 0, count; first < samples && !interruption.came(); first += count) {
    count = look.has_effects() || task.after_sample || (leaves_out && first == 0) ? 1 : LaneTile::kMostSamples;
    count = std::min(count, samples - first);
    interruption.note(first, samples);
    if (task.after_sample && first > 0) hits_.assign(task.pixel_count(), kNoHit);
    cast_samples(first, count, task, interruption);
    if (task.after_sample) task.after_sample(first);
    if (look.has_effects()) apply_look(first, task, interruption);
    if (leaves_out && first == 0 && !interruption.came()) uneven_.emplace().find(sums_, task.at.block.size);
  }
  if (!uneven_) return;
  const auto width = static_cast<std::size_t>(task.at.block.size.x);
  tbb::parallel_for(0, task.at.block.size.y, [&](int y) {
    for (std::size_t n = y * width; n < (y + 1) * width; ++n)
      if (uneven_->counts()[n] == 0.0f) sums_[n] *= static_cast<float>(samples);
  });
}

void CpuRenderer::cast_samples(int first, int count, const BlockTask& task, Interruption& interruption) {
  const auto stage = clock_.stage("ray cast");
  const Look& look = task.settings.look;
  LaneTile samples;
  samples.first_sample = first;
  samples.sample_count = count;
  for (int n = 0; n < count; ++n) samples.offset[n] = sample_offset(first + n);
  samples.hits = task.hits && (first == 0 || task.after_sample) ? hits_.data() : nullptr;
  if (look.has_effects())
    samples.samples = samples_.lanes(look.traces_sky());
  else
    samples.sums = sums_.data();
  if (look.has_effects() && task.scene.content().shows_through) samples.front = front_.lanes(look.traces_sky());
  if (uneven_) samples.counts = uneven_->counts().data();
  const glm::ivec2 tiles = tile_counts(task.at.block);
  for_each_until(interruption, tiles.x * tiles.y, [&](int number) {
    const auto tile = static_cast<std::size_t>(number);
    LaneTile own = samples;
    own.origin = tile_origin(task.at.block, tile);
    if (uneven_ && uneven_->is_even(own.origin, own.origin + kTileEdge)) return;
    task.scene.cast_tile(tile, own, kernels_);
  });
}

void CpuRenderer::apply_look(int sample, const BlockTask& block, Interruption& interruption) {
  const auto stage = clock_.stage("look");
  const glm::ivec2 picture_size = block.settings.size;
  const Look& look = block.settings.look;
  LaneLook task;
  task.view = block_view(block.at.frame, block.at.block, sample_offset(sample));
  const kernel::LightMapParameters maps = light_maps_.parameters(block.at.frame);
  task.maps = &maps;
  task.finish = finish_parameters(look, placement_, picture_size, sample, block.scene.content().marks);
  if (block.scene.content().highlights) task.finish.specular = 0.0f;
  task.samples = samples_.lanes(look.traces_sky());
  task.light_maps = light_maps_.texels().data();
  task.sums = sums_.data();
  if (uneven_) task.counts = uneven_->counts().data();
  if (block.scene.content().shows_through) apply_front_look(sample, task, look, interruption);
  find_shade(samples_, sample, look, task, interruption);
  for_each_until(interruption, task.view.size.y, [&](int y) { kernels_.finish_row(task, y); });
}

/// Prepares the shade of a sample, and computes it unless the sample shares the shade of an earlier one.
void CpuRenderer::find_shade(BlockSamples& samples, int sample, const Look& look, LaneLook& task,
                             Interruption& interruption) {
  task.sky_seen = samples.sky_seen.data();
  task.lamp_seen = samples.lamp_seen.data();
  task.shade_depth = samples.depth.data();
  if (!look.has_shade()) return;
  samples.shade_size.resize(samples.depth.size());
  task.shade_size = samples.shade_size.data();
  const auto for_each_row = [&](const auto& kernel) {
    for_each_until(interruption, task.view.size.y, [&](int y) { kernel(task, y); });
  };
  if (look.traces_sky()) return for_each_row(kernels_.measure_row);
  // All samples of a pixel share the shade of the first, because it hardly differs among them.
  if (sample == 0) samples.shade_depth = samples.depth;
  task.shade_depth = samples.shade_depth.data();
  if (sample > 0) return;
  for_each_row(kernels_.measure_row);
  const glm::ivec2 squares = (task.view.size + (kShadeEdge - 1)) / kShadeEdge;
  for_each_until(interruption, squares.x * squares.y,
                 [&](int n) { kernels_.occlude_square(task, kShadeEdge * glm::ivec2(n % squares.x, n / squares.x)); });
}

/// Finishes the first transparent point along each ray: shade, depth cue and lines are written to samples_.over, each
/// premultiplied by the opacity there.
void CpuRenderer::apply_front_look(int sample, LaneLook task, const Look& look, Interruption& interruption) {
  const glm::ivec2 size = task.view.size;
  const std::size_t pixel_count = static_cast<std::size_t>(size.x) * size.y;
  front_sums_.assign(pixel_count, glm::vec4(0.0f));
  front_ink_.assign(pixel_count, 0.0f);
  task.samples = front_.lanes(look.traces_sky());
  task.finish.specular = 0.0f;  // the cast colours have highlights already
  task.sums = front_sums_.data();
  task.ink = front_ink_.data();
  find_shade(front_, sample, look, task, interruption);
  for_each_until(interruption, size.y, [&](int y) { kernels_.finish_row(task, y); });
  const int reach = static_cast<int>(std::ceil(0.5f * look.widest_line() + 0.5f));
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
      float nearby = 0.0f;  // a line next to it is as opaque as it is there
      for (int row = std::max(y - reach, 0); row <= std::min(y + reach, size.y - 1); ++row)
        for (int column = std::max(x - reach, 0); column <= std::min(x + reach, size.x - 1); ++column)
          nearby = std::max(nearby, front_.color[static_cast<std::size_t>(row) * size.x + column].w);
      over = SeenThrough().under_ink(over, front_ink_[at] * nearby);
    }
  });
}

const LaneKernels& widest_kernels(int most_lanes) {
  for (const LaneKernels* kernels : {kernels_of_16_lanes(), kernels_of_8_lanes()})
    if (kernels && kernels->lanes <= most_lanes) return *kernels;
  return *kernels_of_4_lanes();
}

}  // namespace meniscus
