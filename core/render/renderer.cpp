// SPDX-License-Identifier: BSD-3-Clause
// Prepares, casts block by block, and collects on the host or presents on the GPU.
#include "core/render/renderer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/gpu/gpu_stage.h"
#include "core/gpu/limits.h"
#include "core/render/component_lookup.h"

namespace meniscus {
namespace {

/// The largest block whose buffers the driver can hold, in whole tiles.
int usable_block_edge(int wanted) {
  const std::size_t pixels = query_gpu_limits().storage_block_bytes / sizeof(ray_cast::Hit);
  const int largest = static_cast<int>(std::min(std::sqrt(static_cast<double>(pixels)), 65536.0));
  return std::max(std::min(wanted, largest) / kTileEdge * kTileEdge, kTileEdge);
}

/// The same pixels in two blocks of whole tiles; for blocks of more than one.
std::array<PictureBlock, 2> halves(const PictureBlock& block) {
  const int axis = block.size.x > block.size.y ? 0 : 1;
  std::array<PictureBlock, 2> result{block, block};
  const int first = (block.size[axis] / kTileEdge + 1) / 2 * kTileEdge;
  result[0].size[axis] = first;
  result[1].origin[axis] += first;
  result[1].size[axis] -= first;
  return result;
}

void resize(Framebuffer& picture, const RenderSettings& settings) {
  const std::size_t count = static_cast<std::size_t>(settings.size.x) * settings.size.y;
  picture.size = settings.size;
  picture.color.resize(count);
  if (!settings.aovs) return;
  picture.z.assign(count, std::numeric_limits<float>::infinity());
  picture.normal.assign(count, glm::vec3(0.0f));
  picture.position.assign(count, glm::vec3(0.0f));
  picture.atom.assign(count, kNone);
  picture.kind.assign(count, kNone);
  picture.component.assign(count, kNone);
}

/// `inner` and the neighbours that its colours depend on, as far as there are any.
PictureBlock with_neighbors(const PictureBlock& inner, int reach, glm::ivec2 picture_size) {
  const glm::ivec2 low = glm::max(inner.origin - reach, glm::ivec2(0));
  return {low, glm::min(inner.origin + inner.size + reach, picture_size) - low};
}

/// Calls work(place in the block, place in the picture) for each pixel of `inner`, which is part of the block.
template <typename Work>
void for_each_pixel(const PictureBlock& inner, const PictureBlock& block, glm::ivec2 picture_size, const Work& work) {
  tbb::parallel_for(inner.origin.y, inner.origin.y + inner.size.y, [&](int y) {
    for (int x = inner.origin.x; x < inner.origin.x + inner.size.x; ++x)
      work(static_cast<std::size_t>(y - block.origin.y) * block.size.x + (x - block.origin.x),
           static_cast<std::size_t>(y) * picture_size.x + x);
  });
}

void copy_hit(const ray_cast::Hit& hit, std::size_t at, std::span<const ray_cast::Primitive> primitives,
              const PictureFrame& frame, const ComponentLookup& components, Framebuffer& picture) {
  if (hit.primitive == ray_cast::kNoPrimitive) return;
  const glm::dvec2 pixel(static_cast<double>(at % frame.size.x) + 0.5, static_cast<double>(at / frame.size.x) + 0.5);
  const Ray ray = pixel_ray(frame.camera, frame.size, pixel);
  // The kernel counts from the plane through the pivot.
  const double z = hit.t + frame.eye_distance / glm::dot(ray.direction, frame.basis.forward);
  const glm::dvec3 point = ray.origin + ray.direction * z;
  const ray_cast::Primitive& primitive = primitives[hit.primitive];
  picture.z[at] = static_cast<float>(z);
  picture.normal[at] = hit.normal;
  picture.position[at] = glm::vec3(point);
  picture.atom[at] = hit.atom;
  picture.kind[at] = primitive.kind;
  picture.component[at] = components.at(static_cast<PatchKind>(primitive.kind), primitive.patch_index, point);
}

}  // namespace

/// What render() makes of each block.
struct Renderer::Collected {
  const RenderSettings& settings;
  std::vector<ray_cast::Primitive> primitives{};  // for AOVs, as are components
  std::optional<ComponentLookup> components{};
  Framebuffer picture{};
};

void Renderer::begin(Drawable& drawable, const Camera& camera, const RenderSettings& settings) {
  assert(settings.size.x > 0 && settings.size.y > 0 && settings.samples > 0);
  validate_camera(camera, "camera");
  clock_ = StageClock(settings.timing);
  {
    const auto stage = clock_.stage("frame");
    frame_ = make_picture_frame(drawable.atoms(), camera, settings.size);
  }
  scene_ = &drawable.prepare(frame_, clock_);
}

Framebuffer Renderer::render(const Surface& surface, const Coloring& coloring, const Camera& camera,
                             const RenderSettings& settings) {
  surface_.show(surface, coloring);
  return render(surface_, camera, settings);
}

Framebuffer Renderer::render(Drawable& drawable, const Camera& camera, const RenderSettings& settings) {
  begin(drawable, camera, settings);
  Collected collected{settings};
  if (settings.aovs) {
    assert(drawable.surface());
    collected.primitives = scene_->primitives.buffer.download<ray_cast::Primitive>(scene_->primitives.count());
    collected.components.emplace(*drawable.surface());
  }
  resize(collected.picture, settings);
  const int edge = usable_block_edge(settings.block_edge);
  for (int top = 0; top < settings.size.y; top += edge)
    for (int left = 0; left < settings.size.x; left += edge)
      render_block({{left, top}, glm::min(glm::ivec2(edge), settings.size - glm::ivec2(left, top))}, collected);
  return std::move(collected.picture);
}

void Renderer::render_block(const PictureBlock& inner, Collected& collected) {
  const RenderSettings& settings = collected.settings;
  const PictureBlock block = with_neighbors(inner, look_reach(settings.look), frame_.size);
  try {
    caster_.cast(*scene_, frame_, block, {settings.samples, settings.look, {}, &clock_});
  } catch (const CapacityError&) {
    if (inner.size.x <= kTileEdge && inner.size.y <= kTileEdge) throw;
    for (const PictureBlock& half : halves(inner)) render_block(half, collected);
    return;
  }
  const std::size_t count = static_cast<std::size_t>(block.size.x) * block.size.y;
  const auto sums = samples().download<glm::vec4>(count);
  const float scale = 1.0f / static_cast<float>(settings.samples);
  for_each_pixel(inner, block, frame_.size,
                 [&](std::size_t from, std::size_t to) { collected.picture.color[to] = sums[from] * scale; });
  if (!settings.aovs) return;
  const auto found = hits().download<ray_cast::Hit>(count);
  for_each_pixel(inner, block, frame_.size, [&](std::size_t from, std::size_t to) {
    copy_hit(found[from], to, collected.primitives, frame_, *collected.components, collected.picture);
  });
}

bool Renderer::draw(Drawable& drawable, const Camera& camera, const RenderSettings& settings,
                    const std::function<bool()>& stop) {
  begin(drawable, camera, settings);
  if (!caster_.cast(*scene_, frame_, {{0, 0}, frame_.size}, {settings.samples, settings.look, stop, &clock_}))
    return false;
  const GpuStage stage(clock_, "finish");
  presenter_.present(samples(), frame_.size, settings.samples, settings.look.background);
  return true;
}

std::optional<PickedPoint> Renderer::pick(glm::ivec2 pixel) const {
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= frame_.size.x || pixel.y >= frame_.size.y) return {};
  const std::size_t at = static_cast<std::size_t>(pixel.y) * frame_.size.x + pixel.x;
  const ray_cast::Hit hit = hits().download<ray_cast::Hit>(1, at * sizeof(ray_cast::Hit)).front();
  if (hit.primitive == ray_cast::kNoPrimitive) return {};
  const auto primitive =
      scene_->primitives.buffer.download<ray_cast::Primitive>(1, hit.primitive * sizeof(ray_cast::Primitive)).front();
  const Ray ray = pixel_ray(frame_.camera, frame_.size, glm::dvec2(pixel) + 0.5);
  // The kernel counts from the plane through the pivot.
  const double depth = hit.t + frame_.eye_distance / glm::dot(ray.direction, frame_.basis.forward);
  return PickedPoint{hit.atom, static_cast<PatchKind>(primitive.kind), ray.origin + ray.direction * depth};
}

}  // namespace meniscus
