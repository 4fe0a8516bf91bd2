// SPDX-License-Identifier: BSD-3-Clause
// Ambient occlusion, depth cueing and silhouettes on rows of pixels in packets; included by lanes_*.cpp alone.
#pragma once

#include "core/render/cpu/lane_kernels.h"
#include "core/render/cpu/packet.h"

namespace meniscus::MENISCUS_LANE_NAMESPACE {

using glm::vec3;
using kernel::kNothing;

/// A cast block as the shared sources want to see it.
struct LookedAtBlock {
  explicit LookedAtBlock(const LaneLook& look)
      : look_(look), view(look.view), occlusion(look.occlusion), params(look.finish) {}

  /// Pixels that lie in a row behind each other.
  static integer2 pixels_from(int x, int y) { return {integer(x) + lane_numbers(), integer(y)}; }

  /// A pixel's place in the arrays; outside of the block that after the last.
  integer index_of(integer2 pixel) {
    return select(in_block(pixel), pixel.y * integer(view.size.x) + pixel.x, integer(view.size.x * view.size.y));
  }
  /// What an array holds for these pixels; most packets lie in a row.
  real fetch(const float* values, integer2 pixel) {
    const integer at = index_of(pixel);
    if (!some(at != integer(at.v[0]) + lane_numbers())) return load(values + at.v[0]);
    return gather(values, at);
  }
  real depth_or_nothing(integer2 pixel) { return fetch(look_.samples.depth, pixel); }
  /// Outside of the map the entry behind its last says that there is nothing.
  real map_depth_or_nothing(integer2 texel) {
    const glm::ivec2 size = occlusion.map_size;
    const truth inside =
        texel.x >= integer(0) && texel.y >= integer(0) && texel.x < integer(size.x) && texel.y < integer(size.y);
    return gather(look_.shade_map, select(inside, texel.y * integer(size.x) + texel.x, integer(size.x * size.y)));
  }
  real shade_depth_or_nothing(integer2 pixel) { return fetch(look_.shade_depth, pixel); }
  real visibility_at(integer2 pixel) { return fetch(look_.visibility, pixel); }
  integer mark_at(integer2 pixel) { return to_whole(fetch(look_.samples.mark, pixel)); }
  real3 hit_normal_at(integer2 pixel) {
    return {fetch(look_.samples.normal[0], pixel), fetch(look_.samples.normal[1], pixel),
            fetch(look_.samples.normal[2], pixel)};
  }

  const LaneLook& look_;
  const kernel::BlockView& view;
  const kernel::OcclusionParameters& occlusion;
  const kernel::FinishParameters& params;

#include "gpu_shaders/look/view_space.glsl"
#include "gpu_shaders/look/occlusion.glsl"
#include "gpu_shaders/ray_cast/sheen.glsl"
#include "gpu_shaders/look/finish.glsl"

  /// Shares of a pixel that black lines cover, with the depth of what they outline, and that lines around patches
  /// cover.
  struct Ink {
    real covered, depth, patched;
  };

  /// No line reaches the pixels from here on: what is around each is one part without a step, or nothing. False where
  /// the block ends nearby.
  bool has_no_ink(int x, int y) {
    const int reach = farthest_neighbor();
    if (x < reach || y < reach || x + kLanes + reach > view.size.x || y + reach >= view.size.y) return false;
    const float *const depths = look_.samples.depth, *const marks = look_.samples.mark;
    const std::ptrdiff_t width = view.size.x, first = y * width + x;
    real nearest = load(depths + first), farthest = nearest;
    real least_mark(0.0f), greatest_mark(0.0f);
    if (params.has_marks != 0u) least_mark = greatest_mark = load(marks + first);
    for (int row = -reach; row <= reach; ++row)
      for (int column = -reach; column <= reach; ++column) {
        const std::ptrdiff_t at = first + row * width + column;
        const real depth = load(depths + at);
        nearest = min(nearest, depth);
        farthest = max(farthest, depth);
        if (params.has_marks == 0u) continue;
        const real mark = load(marks + at);
        least_mark = min(least_mark, mark);
        greatest_mark = max(greatest_mark, mark);
      }
    const truth nothing = nearest == real(kNothing);
    const truth steps = farthest == real(kNothing) || farthest - nearest > least_step(nearest);
    return !some(!nothing && (steps || least_mark != greatest_mark));
  }

  Ink ink_on(integer2 pixel, real depth) {
    const int reach = farthest_neighbor();
    const truth met = depth != real(kNothing);
    Ink ink{0.0f, depth, 0.0f};
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const integer2 offset(x, y), other = pixel + offset;
        const truth inside = in_block(other);
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

  void finish(int x, int y) {
    const integer2 pixel = pixels_from(x, y);
    const real depth = depth_or_nothing(pixel);
    const truth met = depth != real(kNothing);
    const int count = view.size.x - x < kLanes ? view.size.x - x : kLanes;
    const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(view.size.x) + x;
    real3 color(0.0f);
    real alpha = select(met, real(1.0f), real(0.0f));
    if (some(met)) {
      for (int n = 0; n < count; ++n) {
        color.x.v[n] = look_.samples.color[first + n].x;
        color.y.v[n] = look_.samples.color[first + n].y;
        color.z.v[n] = look_.samples.color[first + n].z;
      }
      if (params.ambient_occlusion > 0.0f) color = select(met, shaded(color, alpha, pixel, depth), color);
      const real left = select(met, clarity(depth), real(1.0f));
      if (params.keeps_alpha != 0u) {
        color = mix(real3(params.air) * alpha, color, left);
      } else {
        color = color * left;
        alpha = alpha * left;
      }
    }
    if (params.widest_line > 0.0f && !has_no_ink(x, y)) {
      const Ink ink = ink_on(pixel, depth);
      const real patched = ink.patched * clarity(depth);
      color = mix(color, real3(params.patch_line_color), patched);
      alpha = mix(alpha, 1.0f, patched);
      const real covered = ink.covered * clarity(ink.depth);
      color = color * (1.0f - covered);
      alpha = mix(alpha, 1.0f, covered);
      if (look_.ink)
        for (int n = 0; n < count; ++n) look_.ink[first + n] = lane(covered, n);
    }
    for (int n = 0; n < count; ++n) {
      const glm::vec4 finished(lane(color.x, n), lane(color.y, n), lane(color.z, n), lane(alpha, n));
      const glm::vec4* const over = look_.samples.over ? &look_.samples.over[first + n] : nullptr;
      look_.sums[first + n] += over ? *over + finished * (1.0f - over->w) : finished;
    }
  }

  void occlude(int x, int y) {
    const integer2 pixel = pixels_from(x, y);
    const real depth = depth_or_nothing(pixel);
    if (!some(depth != real(kNothing))) return;
    const real visibility = sky_visibility(pixel, depth);
    const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(view.size.x) + x;
    for (int n = 0; n < kLanes && x + n < view.size.x; ++n) look_.visibility[first + n] = lane(visibility, n);
  }
};

inline void occlude_row(const LaneLook& look, int y) {
  LookedAtBlock block(look);
  for (int x = 0; x < look.view.size.x; x += kLanes) block.occlude(x, y);
}

inline void finish_row(const LaneLook& look, int y) {
  LookedAtBlock block(look);
  for (int x = 0; x < look.view.size.x; x += kLanes) block.finish(x, y);
}

}  // namespace meniscus::MENISCUS_LANE_NAMESPACE
