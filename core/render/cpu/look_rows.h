// SPDX-License-Identifier: BSD-3-Clause
// Computes ambient occlusion, depth cueing and silhouettes for rows of pixels in packets. Only lanes_*.cpp include it.
#pragma once

#include "core/render/cpu/layer_caster.h"

namespace meniscus::MENISCUS_LANE_NAMESPACE {

using glm::ivec2;
using glm::vec3;
using glm::vec4;
using kernel::kLightLift;
using kernel::kLightPhases;
using kernel::kLightSteps;
using kernel::kNothing;
using std::floor;

inline constexpr int kShadeReach = 2;  // pixels, the range of mean_visibility

/// Presents a cast block to the shared sources. kInside: all pixels that they read lie in the block, except texels of
/// the map.
template <bool kInside>
struct LookedAtBlock {
  explicit LookedAtBlock(const LaneLook& look) : look_(look), view(look.view), maps(*look.maps), params(look.finish) {}

  /// Returns the elements of an array for these pixels; outside of the block the element after the last one.
  real fetch(const float* values, integer2 pixel) {
    const integer behind = view.size.x * view.size.y;
    return gather(values, select(in_block(pixel), pixel.y * integer(view.size.x) + pixel.x, behind));
  }
  [[gnu::always_inline]] real fetch(const float* values, pixel_row pixel) {
    const bool inside = pixel.x >= 0 && pixel.y >= 0 && pixel.x + kLanes <= view.size.x && pixel.y < view.size.y;
    if (kInside || inside) return load(values + place_in_block(pixel));
    return fetch(values, integer2(pixel));
  }
  std::ptrdiff_t place_in_block(pixel_row pixel) const {
    return static_cast<std::ptrdiff_t>(pixel.y) * view.size.x + pixel.x;
  }
  real depth_or_nothing(integer2 pixel) { return fetch(look_.samples.depth, pixel); }
  real depth_or_nothing(pixel_row pixel) { return fetch(look_.samples.depth, pixel); }
  integer2 two_light_texels(integer at) const {
    const real2 two = gather_two(look_.light_maps, at);
    return {bits_of(two.x), bits_of(two.y)};
  }
  real shade_depth_or_nothing(pixel_row pixel) { return fetch(look_.shade_depth, pixel); }
  real3 shade_seen_at(pixel_row pixel, real depth) {
    if constexpr (!kInside) return seen_at(place_of(pixel), depth, pixel_size_at(depth));
    const real2 place(across_[pixel.x - first_across_], place_of(pixel).y);
    return seen_at(place, depth, load(look_.shade_size + place_in_block(pixel)));
  }
  real2 visibility_at(pixel_row pixel) { return {fetch(look_.sky_seen, pixel), fetch(look_.lamp_seen, pixel)}; }
  integer mark_at(pixel_row pixel) { return to_whole(fetch(look_.samples.mark, pixel)); }
  real3 hit_normal_at(pixel_row pixel) {
    return {fetch(look_.samples.normal[0], pixel), fetch(look_.samples.normal[1], pixel),
            fetch(look_.samples.normal[2], pixel)};
  }

  const LaneLook& look_;
  const kernel::BlockView& view;
  const kernel::LightMapParameters& maps;
  const kernel::FinishParameters& params;

#include "gpu_shaders/look/view_space.glsl"
#include "gpu_shaders/look/light_maps.glsl"
#include "gpu_shaders/ray_cast/studio_light.glsl"
#include "gpu_shaders/look/finish.glsl"

  /// The share of a pixel that black lines cover, with the depth of the object that they outline, and the share that
  /// lines around patches cover.
  struct Ink {
    real covered, depth, patched;
  };

  /// True if no line touches the pixels: the surroundings of each are a single part without a step, or empty.
  bool has_no_ink(pixel_row pixel) requires kInside {
    const Extremes depth = extremes_around(look_.samples.depth, pixel);
    const truth nothing = depth.least == real(kNothing);
    if (!some(!nothing)) return true;
    truth changes = depth.greatest == real(kNothing) || depth.greatest - depth.least > least_step(depth.least);
    if (params.has_marks != 0u) {
      const Extremes mark = extremes_around(look_.samples.mark, pixel);
      changes = changes || mark.least != mark.greatest;
    }
    return !some(!nothing && changes);
  }

  Ink ink_on(pixel_row pixel, real depth) {
    const int reach = farthest_neighbor();
    const truth met = depth != real(kNothing);
    Ink ink{0.0f, depth, 0.0f};
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const integer2 offset(x, y);
        const pixel_row other = pixel + ivec2(x, y);
        const truth inside = kInside ? truth(true) : in_block(other);
        const truth counts = covered_share(offset, params.widest_line) > ink.covered && inside;
        const real patch_share = covered_share(offset, params.patch_lines);
        const truth borders = params.has_marks != 0u && patch_share > ink.patched && inside;
        if (!some(counts || borders)) continue;
        const real other_depth = depth_or_nothing(other);
        const truth step = counts && may_step(depth, other_depth);
        truth seam = false;
        if (params.has_marks != 0u) {
          const truth both = met && other_depth != real(kNothing);
          const integer mark = mark_at(pixel), other_mark = mark_at(other);
          seam = counts && both && parts_differ(mark, other_mark);
          if (some(borders && both && mark != other_mark)) {
            const truth border = both && parted_by_patch(pixel, depth, mark, other, other_depth, other_mark);
            ink.patched = select(borders && border, patch_share, ink.patched);
          }
        }
        if (!some(step || seam)) continue;
        const real strength = select(step, step_ink(pixel, depth, other, other_depth), real(0.0f));
        const truth open = !met || other_depth == real(kNothing);
        const real covered = select(counts, covered_by_border(offset, strength, seam, open), real(0.0f));
        const truth wins = covered > ink.covered;
        ink.covered = select(wins, covered, ink.covered);
        ink.depth = select(wins, min(depth, other_depth), ink.depth);
      }
    return ink;
  }

  void finish(pixel_row pixel) {
    if (look_.counts && !some(counts_at(pixel))) return;
    const real depth = depth_or_nothing(pixel);
    const truth met = depth != real(kNothing);
    const bool has_ink = params.widest_line > 0.0f && !nothing_to_ink(pixel);
    if (!some(met) && !has_ink && !look_.samples.over) return;
    const std::ptrdiff_t first = place_in_block(pixel);
    real3 color(0.0f);
    real alpha = select(met, real(1.0f), real(0.0f));
    if (some(met)) {
      const real4 cast = colors(look_.samples.color + first, pixel);
      color = {cast.x, cast.y, cast.z};
      if (params.ambient_occlusion > 0.0f || params.shadow > 0.0f) {
        first_across_ = pixel.x - kShadeReach;
        for (int n = 0; n <= 2 * kShadeReach; ++n) across_[n] = place_of(pixel_row{first_across_ + n, pixel.y}).x;
        color = select(met, shaded(color, alpha, pixel, depth), color);
      }
      const real left = select(met, clarity(depth), real(1.0f));
      if (params.keeps_alpha != 0u) {
        color = mix(real3(params.air) * alpha, color, left);
      } else {
        color = color * left;
        alpha = alpha * left;
      }
    }
    if (has_ink) {
      const Ink ink = ink_on(pixel, depth);
      const real patched = ink.patched * clarity(depth);
      color = mix(color, real3(params.patch_line_color), patched);
      alpha = mix(alpha, 1.0f, patched);
      const real covered = ink.covered * clarity(ink.depth);
      color = color * (1.0f - covered);
      alpha = mix(alpha, 1.0f, covered);
      if (look_.ink)
        for (int n = 0; n < count_of(pixel); ++n) look_.ink[first + n] = lane(covered, n);
    }
    add(pixel, {color.x, color.y, color.z, alpha});
  }

  void measure(pixel_row pixel) {
    const real size = pixel_size_at(shade_depth_or_nothing(pixel));
    put(size, pixel, look_.shade_size);
  }

  /// Computes the visibilities of each second row of a square, from its first row on. Each map is read for all of them
  /// before the next one, because all maps together are larger than caches.
  void occlude(pixel_row first) {
    struct Point {
      pixel_row pixel;
      real3 normal, to_sky, to_lamp;
      real2 sky;
      real lamp;
    };
    Point points[kShadeEdge / kLanes * kShadeEdge / kLightPhases];
    Point* past = points;
    const int right = first.x + kShadeEdge, below = (first.y / kShadeEdge + 1) * kShadeEdge;
    for (pixel_row pixel = first; pixel.y < below && pixel.y < view.size.y; pixel.y += kLightPhases)
      for (pixel.x = first.x; pixel.x < right && pixel.x < view.size.x; pixel.x += kLanes) {
        const real depth = depth_or_nothing(pixel);
        const truth met = depth != real(kNothing);
        if (!some(met)) continue;
        // The other lanes read texels, too: their points must be numbers.
        const real3 p = position_at(pixel, select(met, depth, real(1.0f)));
        const real3 normal = select(met, facing(hit_normal_at(pixel), to_viewer_at(p)), real3(0.0f));
        *past++ = {pixel,         normal, lifted(p, normal, maps.sky_texel), lifted(p, normal, maps.lamp_texel),
                   {0.0f, 1e-6f}, 0.0f};
      }
    const int phase = light_phase(first.y);
    for (int axis = phase; axis < maps.sky_axes; axis += kLightPhases)
      for (Point* at = points; at < past; ++at) add_sky(axis, at->to_sky, at->normal, at->sky);
    for (int n = phase; n < maps.lamp_places; n += kLightPhases)
      for (Point* at = points; at < past; ++at) at->lamp += lamp_light(n, at->to_lamp, at->normal);
    for (Point* at = points; at < past; ++at) {
      if (maps.sky_axes > 0) put(at->sky.x / at->sky.y, at->pixel, look_.sky_seen);
      if (maps.lamp_places > 0) put(share_of_lamp(at->lamp), at->pixel, look_.lamp_seen);
    }
  }

 private:
  void put(real value, pixel_row pixel, float* values) const {
    for (int n = 0; n < count_of(pixel); ++n) values[place_in_block(pixel) + n] = lane(value, n);
  }

  struct Extremes {
    real least, greatest;
  };

  /// Returns the extremes around the pixels, as far as lines extend. reach: farthest_neighbor(), passed as a constant
  /// where possible.
  [[gnu::always_inline]] Extremes extremes_around(const float* values, pixel_row pixel, int reach) const {
    const float* const middle = values + place_in_block(pixel);
    Extremes found{load(middle), load(middle)};
    for (int row = -reach; row <= reach; ++row)
      for (int column = -reach; column <= reach; ++column) {
        const real value = load(middle + row * static_cast<std::ptrdiff_t>(view.size.x) + column);
        found = {min(found.least, value), max(found.greatest, value)};
      }
    return found;
  }
  Extremes extremes_around(const float* values, pixel_row pixel) {
    const int reach = farthest_neighbor();
    return reach == 1 ? extremes_around(values, pixel, 1) : extremes_around(values, pixel, reach);
  }

  /// Returns the number of these pixels that are in the block.
  int count_of(pixel_row pixel) const {
    return kInside || view.size.x - pixel.x > kLanes ? kLanes : view.size.x - pixel.x;
  }

  bool nothing_to_ink(pixel_row pixel) {
    if constexpr (kInside) return has_no_ink(pixel);
    return false;
  }

  /// True for the pixels that count. The array has more elements than the block has pixels.
  truth counts_at(pixel_row pixel) const { return load(look_.counts + place_in_block(pixel)) != real(0.0f); }

  real4 colors(const glm::vec4* first, pixel_row pixel) const {
    if (count_of(pixel) == kLanes) return load(first);
    glm::vec4 some[kLanes] = {};
    for (int n = 0; n < count_of(pixel); ++n) some[n] = first[n];
    return load(some);
  }

  /// Adds colours to the sums of these pixels, behind the transparent parts.
  void add(pixel_row pixel, real4 finished) const {
    const std::ptrdiff_t first = place_in_block(pixel);
    glm::vec4* const sums = look_.sums + first;
    if (look_.samples.over) {
      const real4 over = colors(look_.samples.over + first, pixel);
      const real left = 1.0f - over.w;
      finished = {over.x + finished.x * left, over.y + finished.y * left, over.z + finished.z * left,
                  over.w + finished.w * left};
    }
    if (look_.counts) {
      const truth counts = counts_at(pixel);
      finished = {select(counts, finished.x, real(0.0f)), select(counts, finished.y, real(0.0f)),
                  select(counts, finished.z, real(0.0f)), select(counts, finished.w, real(0.0f))};
    }
    const real4 sum = colors(sums, pixel);
    const real4 more{sum.x + finished.x, sum.y + finished.y, sum.z + finished.z, sum.w + finished.w};
    if (count_of(pixel) == kLanes) return store(more, sums);
    glm::vec4 all[kLanes];
    store(more, all);
    for (int n = 0; n < count_of(pixel); ++n) sums[n] = all[n];
  }

  int first_across_ = 0;
  real across_[2 * kShadeReach + 1];  // x of the pixels from which a packet's shade is computed: place_of().x
};

/// Calls look(block, pixels) for each packet of a row. Pixels at least `reach` away from the block's borders get a
/// block with kInside.
template <typename Look>
void for_each_packet(const LaneLook& task, int y, int reach, const Look& look) {
  LookedAtBlock<true> inner(task);
  LookedAtBlock<false> outer(task);
  const glm::ivec2 size = task.view.size;
  const bool inner_row = y >= reach && y + reach < size.y;
  for (int x = 0; x < size.x; x += kLanes)
    if (inner_row && x >= reach && x + kLanes + reach <= size.x)
      look(inner, pixel_row{x, y});
    else
      look(outer, pixel_row{x, y});
}

inline void measure_row(const LaneLook& task, int y) {
  for_each_packet(task, y, 0, [](auto& block, pixel_row pixel) { block.measure(pixel); });
}

inline void occlude_square(const LaneLook& task, glm::ivec2 corner) {
  LookedAtBlock<false> block(task);
  for (int phase = 0; phase < kLightPhases; ++phase) block.occlude({corner.x, corner.y + phase});
}

inline void finish_row(const LaneLook& task, int y) {
  const int ink_reach = LookedAtBlock<false>(task).farthest_neighbor();
  const int reach = ink_reach > kShadeReach ? ink_reach : kShadeReach;
  for_each_packet(task, y, reach, [](auto& block, pixel_row pixel) { block.finish(pixel); });
}

/// The kernels of this width.
inline constexpr LaneKernels kKernels{kLanes,  cast_tile,   cast_layer,     light_points,
                                      see_sky, measure_row, occlude_square, finish_row};

}  // namespace meniscus::MENISCUS_LANE_NAMESPACE
