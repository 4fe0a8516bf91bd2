// SPDX-License-Identifier: BSD-3-Clause
// Draws pictures on the GPU block by block, and returns them as pixels in memory.
#include "core/render/gl_renderer.h"

#include <cassert>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/color/coloring.h"
#include "core/gpu/context_description.h"
#include "core/gpu/egl_context.h"

namespace meniscus {

void SurfaceDrawable::show(const Surface& surface, const Coloring& coloring) {
  assert(coloring.atom.size() == surface.atoms.size());
  surface_ = &surface;
  coloring_ = &coloring;
}

const GpuPack& SurfaceDrawable::prepare(const PictureFrame& frame, StageClock& clock) {
  const GpuStage stage(clock, "pack");
  upload_scene(pack_scene(*surface_, *coloring_, frame), *surface_, frame, scene_);
  upload_coloring(*coloring_, scene_);
  return scene_;
}

void upload_scene(const RayCastPack& packed, const Surface& surface, const PictureFrame& frame, GpuPack& scene) {
  scene.primitives.upload(packed.primitives);
  scene.rows.upload(packed.rows);
  scene.counters.upload(std::vector<std::uint32_t>{scene.primitives.count()});
  static_cast<PackPlacement&>(scene) = place_atoms(surface.atoms, surface.probe_radius, frame);
}

namespace {

/// Returns the edge of the largest block, in whole tiles, whose buffers the driver can allocate.
int usable_block_edge(int wanted) {
  const std::size_t pixels = query_gpu_limits().storage_block_bytes / sizeof(ray_cast::Hit);
  const int largest = static_cast<int>(std::min(std::sqrt(static_cast<double>(pixels)), 65536.0));
  return std::max(std::min(wanted, largest) / kTileEdge * kTileEdge, kTileEdge);
}

/// Splits a block of more than one tile into two blocks of whole tiles.
std::array<PictureBlock, 2> halves(const PictureBlock& block) {
  const int axis = block.size.x > block.size.y ? 0 : 1;
  std::array<PictureBlock, 2> result{block, block};
  const int first = (block.size[axis] / kTileEdge + 1) / 2 * kTileEdge;
  result[0].size[axis] = first;
  result[1].origin[axis] += first;
  result[1].size[axis] -= first;
  return result;
}

}  // namespace

void GlRenderer::begin(Drawable& drawable, const Camera& camera, const RenderSettings& settings) {
  assert(settings.size.x > 0 && settings.size.y > 0 && settings.samples > 0);
  validate_camera(camera, "camera");
  clock_ = StageClock(settings.timing);
  {
    const auto stage = clock_.stage("frame");
    frame_ = make_picture_frame(drawable.atoms(), camera, settings.size);
  }
}

// Repeats until the buffers were large enough.
void GlRenderer::prepare(Drawable& drawable) {
  do {
    scene_ = &drawable.prepare(frame_, clock_);
    Readback readback;
    drawable.request_counts(readback);
    readback.read();
  } while (!drawable.take_counts());
}

Framebuffer GlRenderer::render(const Surface& surface, const Coloring& coloring, const Camera& camera,
                               const RenderSettings& settings) {
  surface_.show(surface, coloring);
  return render(surface_, camera, settings);
}

Framebuffer GlRenderer::render(Drawable& drawable, const Camera& camera, const RenderSettings& settings) {
  begin(drawable, camera, settings);
  prepare(drawable);
  std::vector<ray_cast::Primitive> primitives;
  if (settings.aovs) {
    assert(drawable.surface());
    primitives = scene_->primitives.buffer.download<ray_cast::Primitive>(scene_->primitives.count());
  }
  const HitSource source{drawable.surface(), primitives};
  PictureCollector collector(frame_, settings, [&](const ray_cast::Hit& hit, const glm::dvec3& point) {
    return names_of(source, hit, point);
  });
  const std::vector<PictureBlock> blocks = collector.blocks(usable_block_edge(settings.block_edge));
  caster_.make_light_maps(drawable.atoms(), *scene_, settings.look, frame_.basis);
  for (const PictureBlock& block : blocks) {
    render_block(block, settings, collector);
    collector.end_block(block);
  }
  return collector.take();
}

void GlRenderer::render_block(const PictureBlock& inner, const RenderSettings& settings, PictureCollector& collector) {
  const PictureBlock block = with_neighbors(inner, look_reach(settings.look), frame_.size);
  try {
    caster_.cast(*scene_, frame_, block, {.samples = settings.samples, .look = settings.look, .clock = &clock_});
  } catch (const CapacityError&) {
    if (inner.size.x <= kTileEdge && inner.size.y <= kTileEdge) throw;
    for (const PictureBlock& half : halves(inner)) render_block(half, settings, collector);
    return;
  }
  const std::size_t count = static_cast<std::size_t>(block.size.x) * block.size.y;
  collector.add_colors(inner, block, samples().download<glm::vec4>(count));
  if (settings.aovs) collector.add_hits(inner, block, hits().download<ray_cast::Hit>(count));
}

bool GlRenderer::draw(Drawable& drawable, const Camera& camera, const RenderSettings& settings,
                      const std::function<bool()>& stop) {
  begin(drawable, camera, settings);
  for (bool had_room = false; !had_room;)
    if (!draw_once(drawable, settings, stop, had_room)) return false;
  return true;
}

bool GlRenderer::draw_once(Drawable& drawable, const RenderSettings& settings, const std::function<bool()>& stop,
                           bool& had_room) {
  const PictureBlock block{{0, 0}, frame_.size};
  // A caller that may stop the picture between samples is notified after each sample.
  const bool trusts = counting_ == Counting::later && caster_.can_trust(block) && !(stop && settings.samples > 1);
  if (trusts)
    scene_ = &drawable.prepare(frame_, clock_);
  else
    prepare(drawable);
  caster_.make_light_maps(drawable.atoms(), *scene_, settings.look, frame_.basis);
  if (!caster_.cast(*scene_, frame_, block,
                    {settings.samples, settings.look, trusts ? Counting::later : Counting::now, stop, &clock_}))
    return false;
  const GpuStage stage(clock_, "finish");
  presenter_.present(samples(), frame_.size, settings.samples, settings.look.background);
  Readback readback;
  if (trusts) {
    drawable.request_counts(readback);
    caster_.request_counts(readback);
  }
  readback.read();
  if (!trusts) return had_room = true;
  const bool drawable_had_room = drawable.take_counts(), caster_had_room = caster_.take_counts();
  had_room = drawable_had_room && caster_had_room;
  return true;
}

std::optional<PickedPoint> GlRenderer::pick(glm::ivec2 pixel) const {
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= frame_.size.x || pixel.y >= frame_.size.y) return {};
  const std::size_t at = static_cast<std::size_t>(pixel.y) * frame_.size.x + pixel.x;
  const ray_cast::Hit hit = hits().download<ray_cast::Hit>(1, at * sizeof(ray_cast::Hit)).front();
  if (hit.primitive == ray_cast::kNoPrimitive) return {};
  const auto primitive =
      scene_->primitives.buffer.download<ray_cast::Primitive>(1, hit.primitive * sizeof(ray_cast::Primitive)).front();
  return PickedPoint{hit.atom, static_cast<PatchKind>(primitive.kind), hit_point(frame_, pixel, hit.t).position};
}

std::string gl_words(const EglContext& context) {
  return fmt::format("{}, GL {}{}", context.renderer(), context.version(), context.is_software() ? " (software)" : "");
}

}  // namespace meniscus
