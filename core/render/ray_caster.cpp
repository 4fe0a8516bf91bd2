// SPDX-License-Identifier: BSD-3-Clause
// The host's side of ray casting: pack, bin, dispatch block by block, collect.
#include "core/render/ray_caster.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/gpu/gpu_stage.h"
#include "core/gpu/limits.h"
#include "core/gpu/texel_buffer.h"
#include "core/render/color_space.h"
#include "core/render/component_lookup.h"
#include "core/render/ray_cast_scene.h"

namespace meniscus {
namespace {

/// Where sample `index` lies in its pixel, in pixels from the centre: the R2 sequence (Roberts 2018), centre first.
glm::vec2 sample_offset(int index) {
  const double x = 0.5 + index * 0.7548776662466927, y = 0.5 + index * 0.5698402909980532;
  return {static_cast<float>(x - std::floor(x) - 0.5), static_cast<float>(y - std::floor(y) - 0.5)};
}

std::vector<glm::vec4> linear_colors(const Surface& surface, const Coloring& coloring) {
  assert(coloring.atom.size() == surface.atoms.size());
  std::vector<glm::vec4> colors;
  colors.reserve(surface.atoms.size() + 3);
  for (std::uint32_t a = 0; a < surface.atoms.size(); ++a)
    colors.emplace_back(linear_from_srgb(coloring.atom[a]), coloring.shows(a) ? 1.0f : 0.0f);
  if (coloring.kind)
    for (const glm::vec3& color : *coloring.kind) colors.emplace_back(linear_from_srgb(color), 1.0f);
  return colors;
}

/// The largest block whose buffers the driver can hold, in whole tiles.
int usable_block_edge(int wanted) {
  const std::size_t pixels = query_gpu_limits().storage_block_bytes / sizeof(ray_cast::Hit);
  const int largest = static_cast<int>(std::min(std::sqrt(static_cast<double>(pixels)), 65536.0));
  return std::max(std::min(wanted, largest) / kTileEdge * kTileEdge, kTileEdge);
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

using Block = RayCaster::Block;

void copy_colors(const Block& block, const std::vector<glm::vec4>& sums, float scale, Framebuffer& picture) {
  for (int y = 0; y < block.size.y; ++y)
    for (int x = 0; x < block.size.x; ++x)
      picture.color[static_cast<std::size_t>(block.origin.y + y) * picture.size.x + block.origin.x + x] =
          sums[static_cast<std::size_t>(y) * block.size.x + x] * scale;
}

void copy_hits(const Block& block, const std::vector<ray_cast::Hit>& hits, const RayCastScene& scene,
               const PictureFrame& frame, const ComponentLookup& components, Framebuffer& picture) {
  tbb::parallel_for(0, block.size.y, [&](int y) {
    for (int x = 0; x < block.size.x; ++x) {
      const ray_cast::Hit& hit = hits[static_cast<std::size_t>(y) * block.size.x + x];
      if (hit.primitive == ray_cast::kNoPrimitive) continue;
      const glm::ivec2 pixel = block.origin + glm::ivec2(x, y);
      const std::size_t at = static_cast<std::size_t>(pixel.y) * picture.size.x + pixel.x;
      const Ray ray = pixel_ray(frame.camera, frame.size, glm::dvec2(pixel) + 0.5);
      // The kernel counts from the plane through the pivot.
      const double z = hit.t + frame.eye_distance / glm::dot(ray.direction, frame.basis.forward);
      const glm::dvec3 point = ray.origin + ray.direction * z;
      const ray_cast::Primitive& primitive = scene.primitives[hit.primitive];
      const auto kind = static_cast<PatchKind>(primitive.kind);
      picture.z[at] = static_cast<float>(z);
      picture.normal[at] = hit.normal;
      picture.position[at] = glm::vec3(point);
      picture.atom[at] = hit.atom;
      picture.kind[at] = primitive.kind;
      picture.component[at] = components.at(kind, primitive.patch_index, point);
    }
  });
}

}  // namespace

struct RayCaster::Buffers {
  TexelBuffer primitives{TexelFormat::uint4}, rows{TexelFormat::uint4};
  TexelBuffer first_entry{TexelFormat::uint1}, entries{TexelFormat::uint1};
  Buffer colors, picture, hits;

  void bind() const {
    std::uint32_t unit = 0, binding = 0;
    for (const TexelBuffer* buffer : {&primitives, &rows, &first_entry, &entries}) buffer->bind(unit++);
    for (const Buffer* buffer : {&colors, &picture, &hits}) buffer->bind(binding++);
  }
};

RayCaster::RayCaster() : program_("gpu_shaders/ray_cast/ray_cast.comp"), buffers_(std::make_unique<Buffers>()) {}

RayCaster::~RayCaster() = default;

Framebuffer RayCaster::render(const Surface& surface, const Coloring& coloring, const Camera& camera,
                              const RenderSettings& settings) {
  assert(settings.size.x > 0 && settings.size.y > 0 && settings.samples > 0);
  validate_camera(camera, "camera");
  clock_.restart();
  const PictureFrame frame = make_picture_frame(surface, camera, settings.size);
  const RayCastScene scene = upload_scene(surface, coloring, frame);
  set_uniforms(surface, coloring, frame, scene);

  Framebuffer picture;
  resize(picture, settings);
  std::optional<ComponentLookup> components;
  if (settings.aovs) components.emplace(surface);
  const int edge = usable_block_edge(settings.block_edge);
  for (int top = 0; top < settings.size.y; top += edge) {
    for (int left = 0; left < settings.size.x; left += edge) {
      const Block block{{left, top}, glm::min(glm::ivec2(edge), settings.size - glm::ivec2(left, top))};
      cast_block(scene, frame, block, settings.samples);
      const std::size_t count = static_cast<std::size_t>(block.size.x) * block.size.y;
      copy_colors(block, buffers_->picture.download<glm::vec4>(count), 1.0f / static_cast<float>(settings.samples),
                  picture);
      if (settings.aovs)
        copy_hits(block, buffers_->hits.download<ray_cast::Hit>(count), scene, frame, *components, picture);
    }
  }
  return picture;
}

RayCastScene RayCaster::upload_scene(const Surface& surface, const Coloring& coloring, const PictureFrame& frame) {
  const GpuStage stage(clock_, "pack");
  RayCastScene scene = pack_scene(surface, coloring, frame);
  buffers_->primitives.upload(scene.primitives);
  buffers_->rows.upload(scene.rows);
  buffers_->colors.upload(linear_colors(surface, coloring));
  return scene;
}

void RayCaster::set_uniforms(const Surface& surface, const Coloring& coloring, const PictureFrame& frame,
                             const RayCastScene& scene) const {
  program_.set("probe_radius", static_cast<float>(surface.probe_radius));
  program_.set("slack", scene.slack);
  program_.set("pixel_size", static_cast<float>(frame.pixel_size));
  program_.set("eye_distance", static_cast<float>(frame.eye_distance));
  program_.set("orthographic", frame.camera.projection == Projection::orthographic ? 1u : 0u);
  program_.set("right", glm::vec3(frame.basis.right));
  program_.set("up", glm::vec3(frame.basis.up));
  program_.set("forward", glm::vec3(frame.basis.forward));
  program_.set("color_by_kind", coloring.kind ? 1u : 0u);
  program_.set("atom_count", static_cast<std::uint32_t>(surface.atoms.size()));
  program_.set("some_hidden", std::ranges::find(coloring.hidden, true) != coloring.hidden.end() ? 1u : 0u);
}

void RayCaster::cast_block(const RayCastScene& scene, const PictureFrame& frame, const Block& block, int sample_count) {
  const std::size_t count = static_cast<std::size_t>(block.size.x) * block.size.y;
  TileLists lists;
  {
    const GpuStage stage(clock_, "tile lists");
    lists = bin_primitives(scene, frame, block.origin, block.size);
    buffers_->first_entry.upload(lists.first_entry);
    buffers_->entries.upload(lists.entries);
  }
  const GpuStage stage(clock_, "ray cast");
  buffers_->picture.resize(count * sizeof(glm::vec4));
  buffers_->hits.resize(count * sizeof(ray_cast::Hit));
  buffers_->bind();
  program_.set("size", block.size);
  program_.set("first_offset", glm::vec2(glm::dvec2(block.origin) + 0.5 - 0.5 * glm::dvec2(frame.size)));
  for (int sample = 0; sample < sample_count; ++sample) {
    program_.set("sample_index", static_cast<std::uint32_t>(sample));
    program_.set("sample_offset", sample_offset(sample));
    program_.dispatch_2d(static_cast<std::uint32_t>(lists.tiles.x), static_cast<std::uint32_t>(lists.tiles.y));
  }
}

}  // namespace meniscus
