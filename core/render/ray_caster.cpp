// SPDX-License-Identifier: BSD-3-Clause
// The host's side of ray casting: pack, dispatch block by block, collect.
#include "core/render/ray_caster.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/gpu/gpu_stage.h"
#include "core/gpu/limits.h"
#include "core/render/component_lookup.h"
#include "core/render/ray_cast_scene.h"

namespace meniscus {
namespace {

/// Where sample `index` lies in its pixel, in pixels from the centre: the R2 sequence (Roberts 2018), centre first.
glm::vec2 sample_offset(int index) {
  const double x = 0.5 + index * 0.7548776662466927, y = 0.5 + index * 0.5698402909980532;
  return {static_cast<float>(x - std::floor(x) - 0.5), static_cast<float>(y - std::floor(y) - 0.5)};
}

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

void copy_hit(const ray_cast::Hit& hit, std::size_t at, const RayCastScene& scene, const PictureFrame& frame,
              const ComponentLookup& components, Framebuffer& picture) {
  if (hit.primitive == ray_cast::kNoPrimitive) return;
  const glm::dvec2 pixel(static_cast<double>(at % frame.size.x) + 0.5, static_cast<double>(at / frame.size.x) + 0.5);
  const Ray ray = pixel_ray(frame.camera, frame.size, pixel);
  // The kernel counts from the plane through the pivot.
  const double z = hit.t + frame.eye_distance / glm::dot(ray.direction, frame.basis.forward);
  const glm::dvec3 point = ray.origin + ray.direction * z;
  const ray_cast::Primitive& primitive = scene.primitives[hit.primitive];
  picture.z[at] = static_cast<float>(z);
  picture.normal[at] = hit.normal;
  picture.position[at] = glm::vec3(point);
  picture.atom[at] = hit.atom;
  picture.kind[at] = primitive.kind;
  picture.component[at] = components.at(static_cast<PatchKind>(primitive.kind), primitive.patch_index, point);
}

/// Of the first sample.
kernel::RayCastParameters own_parameters(const GpuScene& scene, const Look& look, glm::ivec2 tiles) {
  kernel::RayCastParameters own{};
  own.key_direction = glm::normalize(look.light_direction);
  own.key_strength = look.light_strength;
  own.tiles = tiles;
  own.probe_radius = static_cast<float>(scene.probe_radius);
  own.slack = scene.slack;
  own.color_by_kind = scene.color_by_kind;
  own.atom_count = scene.atom_count;
  return own;
}

}  // namespace

/// What the kernel is told.
struct RayCaster::Parameters {
  kernel::RayCastParameters own;
  kernel::BlockView view;
  kernel::DepthSlices slices;
};

/// What render() makes of each block.
struct RayCaster::Collected {
  const GpuScene& scene;
  const PictureFrame& frame;
  const RenderSettings& settings;
  const RayCastScene* packed = nullptr;  // for AOVs
  const ComponentLookup* components = nullptr;
  Framebuffer picture{};
};

Framebuffer RayCaster::render(const Surface& surface, const Coloring& coloring, const Camera& camera,
                              const RenderSettings& settings) {
  assert(settings.size.x > 0 && settings.size.y > 0 && settings.samples > 0);
  assert(coloring.atom.size() == surface.atoms.size());
  validate_camera(camera, "camera");
  clock_.restart();
  const PictureFrame frame = make_picture_frame(surface.atoms, camera, settings.size);
  RayCastScene packed;
  {
    const GpuStage stage(clock_, "pack");
    packed = pack_scene(surface, coloring, frame);
    upload_scene(packed, surface, frame, scene_);
    upload_coloring(coloring, scene_);
  }
  std::optional<ComponentLookup> components;
  if (settings.aovs) components.emplace(surface);
  Collected collected{scene_, frame, settings, &packed, components ? &*components : nullptr};
  render_blocks(collected);
  return std::move(collected.picture);
}

Framebuffer RayCaster::render(const GpuScene& scene, const PictureFrame& frame, const RenderSettings& settings) {
  assert(settings.size == frame.size && settings.samples > 0 && !settings.aovs);
  clock_.restart();
  Collected collected{scene, frame, settings};
  render_blocks(collected);
  return std::move(collected.picture);
}

void RayCaster::render_blocks(Collected& collected) {
  const RenderSettings& settings = collected.settings;
  resize(collected.picture, settings);
  const int edge = usable_block_edge(settings.block_edge);
  for (int top = 0; top < settings.size.y; top += edge)
    for (int left = 0; left < settings.size.x; left += edge)
      render_block({{left, top}, glm::min(glm::ivec2(edge), settings.size - glm::ivec2(left, top))}, collected);
}

void RayCaster::render_block(const PictureBlock& inner, Collected& collected) {
  const RenderSettings& settings = collected.settings;
  const PictureFrame& frame = collected.frame;
  const PictureBlock block = with_neighbors(inner, look_reach(settings.look), frame.size);
  try {
    cast(collected.scene, frame, block, settings.samples, settings.look);
  } catch (const CapacityError&) {
    if (inner.size.x <= kTileEdge && inner.size.y <= kTileEdge) throw;
    for (const PictureBlock& half : halves(inner)) render_block(half, collected);
    return;
  }
  const std::size_t count = static_cast<std::size_t>(block.size.x) * block.size.y;
  const auto sums = picture_.download<glm::vec4>(count);
  const float scale = 1.0f / static_cast<float>(settings.samples);
  for_each_pixel(inner, block, frame.size,
                 [&](std::size_t from, std::size_t to) { collected.picture.color[to] = sums[from] * scale; });
  if (!settings.aovs) return;
  const auto hits = hits_.download<ray_cast::Hit>(count);
  for_each_pixel(inner, block, frame.size, [&](std::size_t from, std::size_t to) {
    copy_hit(hits[from], to, *collected.packed, frame, *collected.components, collected.picture);
  });
}

bool RayCaster::cast(const GpuScene& scene, const PictureFrame& frame, const PictureBlock& block, int sample_count,
                     const Look& look, const std::function<bool()>& stop) {
  {
    const GpuStage stage(clock_, "tile lists");
    lists_.build(scene, frame, block);
  }
  const std::size_t count = static_cast<std::size_t>(block.size.x) * block.size.y;
  picture_.resize(count * sizeof(glm::vec4));
  hits_.resize(count * sizeof(ray_cast::Hit));
  if (look.has_effects()) {
    sample_colors_.resize(count * sizeof(glm::vec4));
    if (sample_count > 1) sample_hits_.resize(count * sizeof(ray_cast::Hit));
  }
  Parameters parameters{own_parameters(scene, look, lists_.tiles()), {}, depth_slices(scene)};
  row_texels_.view(scene.rows.buffer);
  const std::size_t invocations = 64 * static_cast<std::size_t>(lists_.tiles().x) * lists_.tiles().y;
  unfinished_.resize((2 + invocations) * sizeof(std::uint32_t));
  unfinished_.fill(0);
  for (int n = 0; n < sample_count; ++n) {
    if (n > 0 && stop && stop()) return false;
    const CastSample sample{look.has_effects() ? sample_colors_ : picture_,
                            n && look.has_effects() ? sample_hits_ : hits_, static_cast<std::uint32_t>(n),
                            sample_offset(n)};
    {
      const GpuStage stage(clock_, "ray cast");
      const bool add = n > 0 && !look.has_effects();
      if (!add) lists_.clear_empty(block, sample.colors, sample.hits);
      parameters.own.add = add;
      parameters.view = block_view(frame, block, sample.offset);
      cast_sample(scene, sample, parameters);
    }
    if (!look.has_effects()) continue;
    const GpuStage stage(clock_, "look");
    look_pass_.add(sample, look, scene, frame, block, picture_);
  }
  return true;
}

const Program& RayCaster::program(const GpuScene& scene, bool resumed) {
  ShaderDefines defines;
  if (scene.some_hidden) defines.emplace_back("SOME_HIDDEN", "1");
  if (resumed) defines.emplace_back("RESUMED", "1");
  return programs_.get("gpu_shaders/ray_cast/ray_cast.comp", defines);
}

void RayCaster::cast_sample(const GpuScene& scene, const CastSample& sample, const Parameters& parameters) {
  start(program(scene, false), scene, sample, parameters);
  const auto longest = unfinished_.download<std::uint32_t>(1).front();
  if (longest > 0) finish_long_lists(longest, scene, sample, parameters);
}

void RayCaster::start(const Program& program, const GpuScene& scene, const CastSample& sample,
                      const Parameters& parameters) {
  row_texels_.bind(1);
  scene.colors.bind(0);
  sample.colors.bind(1);
  sample.hits.bind(2);
  unfinished_.bind(3);
  program.set(parameters.own);
  program.set(parameters.view, kernel::kBlockViewBinding);
  program.set(parameters.slices, kernel::kDepthSlicesBinding);
  lists_.dispatch(program);
}

// Lists of thousands, as of large molecules in small pictures, are too long for one go of software GL's kernels.
void RayCaster::finish_long_lists(std::uint32_t longest, const GpuScene& scene, const CastSample& sample,
                                  Parameters parameters) {
  constexpr std::uint32_t kFirstPart = 256, kSmallestPart = 4;
  states_.resize(unfinished_.byte_count() * 16);  // four vectors of four words for each word there
  for (std::uint32_t length = kFirstPart; length >= kSmallestPart; length /= 4) {
    const std::uint32_t none[2] = {0, 0};
    unfinished_.write(0, none, sizeof none);
    const std::uint32_t part_count = (longest + length - 1) / length;
    parameters.own.part_length = static_cast<std::int32_t>(length);
    for (std::uint32_t part = 0; part < part_count; ++part) {
      parameters.own.part = static_cast<std::int32_t>(part);
      parameters.own.is_last_part = part + 1 == part_count;
      states_.bind(4);
      start(program(scene, true), scene, sample, parameters);
    }
    if (unfinished_.download<std::uint32_t>(1, sizeof(std::uint32_t)).front() == 0) return;
  }
  throw CapacityError("some rays meet more than this driver's kernels can go through; use another device");
}

}  // namespace meniscus
