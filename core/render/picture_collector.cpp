// SPDX-License-Identifier: BSD-3-Clause
// Copies blocks to their places.
#include "core/render/picture_collector.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <tbb/parallel_for.h>

#include "core/render/component_lookup.h"
#include "core/render/hit_point.h"

namespace meniscus {
namespace {

/// Of a band: what fits into 256 MiB, in bands as equal as whole tiles allow.
int band_rows(const RenderSettings& settings, int edge) {
  constexpr std::int64_t kBandBytes = std::int64_t{1} << 28, kColorBytes = 16, kAovBytes = 48;
  const std::int64_t row_bytes = (kColorBytes + (settings.aovs ? kAovBytes : 0)) * settings.size.x;
  const auto in_tiles = [](std::int64_t rows) { return (rows + kTileEdge - 1) / kTileEdge * kTileEdge; };
  const std::int64_t most =
      std::clamp<std::int64_t>(kBandBytes / row_bytes / kTileEdge * kTileEdge, std::int64_t{kTileEdge}, edge);
  const std::int64_t bands = (settings.size.y + most - 1) / most;
  return static_cast<int>(in_tiles((settings.size.y + bands - 1) / bands));
}

/// Calls work(place in the block, place in the rows from first_row on) for each pixel of `inner`, which is part of the
/// block.
template <typename Work>
void for_each_pixel(const PictureBlock& inner, const PictureBlock& block, int width, int first_row, const Work& work) {
  tbb::parallel_for(inner.origin.y, inner.origin.y + inner.size.y, [&](int y) {
    for (int x = inner.origin.x; x < inner.origin.x + inner.size.x; ++x)
      work(static_cast<std::size_t>(y - block.origin.y) * block.size.x + (x - block.origin.x),
           static_cast<std::size_t>(y - first_row) * width + x);
  });
}

}  // namespace

std::vector<PictureBlock> picture_blocks(glm::ivec2 size, glm::ivec2 edge) {
  std::vector<PictureBlock> blocks;
  for (int top = 0; top < size.y; top += edge.y)
    for (int left = 0; left < size.x; left += edge.x)
      blocks.push_back({{left, top}, glm::min(edge, size - glm::ivec2(left, top))});
  return blocks;
}

PictureBlock with_neighbors(const PictureBlock& inner, int reach, glm::ivec2 picture_size) {
  const glm::ivec2 low = glm::max(inner.origin - reach, glm::ivec2(0));
  return {low, glm::min(inner.origin + inner.size + reach, picture_size) - low};
}

NameHit names_of(std::span<const HitSource> sources) {
  return [sources = std::vector<HitSource>(sources.begin(), sources.end())](const ray_cast::Hit& hit,
                                                                            const glm::dvec3& point) {
    if (hit.primitive == ray_cast::kOnPlane) return HitNames{hit.atom, kNone, Framebuffer::kCap};
    const HitSource& source = sources[hit.object];
    if (!source.surface) return HitNames{hit.atom, kNone, Framebuffer::kShape};
    const ray_cast::Primitive& primitive = source.primitives[hit.primitive];
    const ComponentLookup components(*source.surface);
    return HitNames{hit.atom, components.at(static_cast<PatchKind>(primitive.kind), primitive.patch_index, point),
                    primitive.kind};
  };
}

PictureCollector::PictureCollector(const PictureFrame& frame, const RenderSettings& settings, NameHit names,
                                   bool several)
    : frame_(frame),
      settings_(settings),
      per_sample_(1.0f / static_cast<float>(settings.samples)),
      names_(std::move(names)),
      several_(several) {
  if (!settings.take_band) begin_rows(0, settings.size.y);
}

std::vector<PictureBlock> PictureCollector::blocks(int edge) {
  if (!settings_.take_band) return picture_blocks(settings_.size, glm::ivec2(edge));
  std::vector<PictureBlock> blocks = picture_blocks(settings_.size, {edge, band_rows(settings_, edge)});
  begin_rows(0, blocks.front().size.y);
  return blocks;
}

void PictureCollector::begin_rows(int first, int count_of_rows) {
  const std::size_t count = static_cast<std::size_t>(settings_.size.x) * count_of_rows;
  first_row_ = first;
  picture_.size = {settings_.size.x, count_of_rows};
  picture_.color.assign(count, glm::vec4(0.0f));
  if (!settings_.aovs) return;
  picture_.z.assign(count, std::numeric_limits<float>::infinity());
  picture_.normal.assign(count, glm::vec3(0.0f));
  picture_.position.assign(count, glm::vec3(0.0f));
  picture_.atom.assign(count, kNone);
  picture_.kind.assign(count, kNone);
  picture_.component.assign(count, kNone);
  if (several_) picture_.object.assign(count, kNone);
}

void PictureCollector::add_colors(const PictureBlock& inner, const PictureBlock& block,
                                  std::span<const glm::vec4> sums) {
  for_each_pixel(inner, block, picture_.size.x, first_row_,
                 [&](std::size_t from, std::size_t to) { picture_.color[to] = sums[from] * per_sample_; });
}

void PictureCollector::add_hits(const PictureBlock& inner, const PictureBlock& block,
                                std::span<const ray_cast::Hit> hits) {
  for_each_pixel(inner, block, picture_.size.x, first_row_,
                 [&](std::size_t from, std::size_t to) { copy_hit(hits[from], to); });
}

void PictureCollector::end_block(const PictureBlock& block) {
  if (!settings_.take_band || block.origin.x + block.size.x < settings_.size.x) return;
  settings_.take_band(std::exchange(picture_, {}), first_row_);
  const int next = block.origin.y + block.size.y;
  if (next < settings_.size.y)
    begin_rows(next, std::min(block.size.y, settings_.size.y - next));
  else
    picture_.size = settings_.size;
}

void PictureCollector::copy_hit(const ray_cast::Hit& hit, std::size_t at) {
  if (hit.primitive == ray_cast::kNoPrimitive) return;
  const auto width = static_cast<std::size_t>(frame_.size.x);
  const glm::ivec2 pixel(static_cast<int>(at % width), first_row_ + static_cast<int>(at / width));
  const HitPoint point = hit_point(frame_, pixel, hit.t);
  picture_.z[at] = static_cast<float>(point.z);
  picture_.normal[at] = hit.normal;
  picture_.position[at] = glm::vec3(point.position);
  if (!picture_.object.empty()) picture_.object[at] = hit.object;
  const HitNames names = names_(hit, point.position);
  picture_.atom[at] = names.atom;
  picture_.kind[at] = names.kind;
  picture_.component[at] = names.component;
}

}  // namespace meniscus
