// SPDX-License-Identifier: BSD-3-Clause
// Changes the colour of a sample by shade, depth cueing and silhouettes.
//
// This file is written in GLSL and, as the body of a struct, in C++ (view_space.glsl). The includer provides `params`
// of FinishParameters and three functions for the sample whose shade this one uses: shade_depth_or_nothing() of a
// pixel, which may be outside of the block; visibility_at() of a pixel that has a hit; and shade_seen_at(), which is
// seen_at() of a pixel at that depth.

// Returns the mean visibility of the sky and of the lamp over 4 x 4 pixels, as a square of 5 x 5 whose rim has half the
// weight. Pixels of other surfaces do not count, unless there are no others.
GEOMETRY real2 mean_visibility(pixel_row pixel, real depth) {
  real3 p = position_at(pixel, depth);
  real3 normal = turned_over(facing(hit_normal_at(pixel), to_viewer_at(p)));
  p = turned_over(p);
  real tolerance = 0.3 + 2.0 * pixel_size_at(depth);
  real sky = real(1e-9);
  real lamp = real(1e-9);
  real weights = real(1e-9);
  for (int y = -2; y <= 2; ++y)
    for (int x = -2; x <= 2; ++x) {
      pixel_row other = pixel + ivec2(x, y);
      real other_depth = shade_depth_or_nothing(other);
      truth counts = other_depth != real(kNothing);
      real off_plane = abs(dot(normal, shade_seen_at(other, other_depth) - p));
      float in_square = (x * x == 4 ? 0.5 : 1.0) * (y * y == 4 ? 0.5 : 1.0);
      real weight = in_square * max(1.0 - off_plane / tolerance, 1e-5);
      real2 seen = visibility_at(other);
      sky += select(counts, weight * seen.x, real(0.0));
      lamp += select(counts, weight * seen.y, real(0.0));
      weights += select(counts, weight, real(0.0));
    }
  return real2(sky / weights, lamp / weights);
}

// Returns the colour of a sample in the shade. The highlight needs a greater visibility than the other light.
GEOMETRY real3 shaded(real3 color, real alpha, pixel_row pixel, real depth) {
  real2 seen = mean_visibility(pixel, depth);
  real visible = mix(real(1.0), seen.x, real(params.ambient_occlusion));
  real3 lit = color * visible;
  if (params.specular == 0.0 && params.shadow == 0.0) return lit;
  real3 to_viewer = to_viewer_at(position_at(pixel, depth));
  real3 normal = facing(hit_normal_at(pixel), to_viewer);
  if (params.shadow > 0.0) {
    KeyLight key = open_key_light(normal);
    real3 unshaded = matt_light(normal, to_viewer, key);
    key.open = mix(real(1.0), seen.y, real(params.shadow));
    key.diffuse = key.diffuse * key.open;
    lit = lit * (matt_light(normal, to_viewer, key) / unshaded);
    visible = visible * key.open;
  }
  if (params.specular == 0.0) return lit;
  real open = clamp((visible - 0.5) / 0.45, 0.0, 1.0);
  real highlight = sheen(normal, to_viewer, params.key_direction, params.key_strength, params.specular, params.shininess);
  return lit + real3(alpha * (open * open) * highlight);
}

// Returns the least difference of depths that is a step, in Å.
GEOMETRY real least_step(real depth) { return 0.5 + params.step_pixels * pixel_size_at(depth); }

// Returns the further difference of depths at which the line becomes black, in Å.
GEOMETRY real step_range(real depth) { return 3.0 + params.fade_pixels * pixel_size_at(depth); }

// True if a line may be drawn between two pixels because of their depths.
GEOMETRY truth may_step(real depth_a, real depth_b) {
  truth open = depth_a == real(kNothing) || depth_b == real(kNothing);
  truth steps = abs(depth_a - depth_b) > least_step(min(depth_a, depth_b));
  return (open && depth_a != depth_b) || (!open && steps);
}

// Returns the difference of the depths of two pixels that have hits, without the part that the slope of the flatter one
// explains, in Å.
GEOMETRY real jump_between(pixel_row a, real depth_a, pixel_row b, real depth_b) {
  real3 viewer_a = to_viewer_at(position_at(a, depth_a));
  real3 viewer_b = to_viewer_at(position_at(b, depth_b));
  real facing_a = dot(facing(hit_normal_at(a), viewer_a), viewer_a);
  real facing_b = dot(facing(hit_normal_at(b), viewer_b), viewer_b);
  real flatter = max(facing_a, facing_b);
  real slope = sqrt(max(1.0 - flatter * flatter, 0.0)) / max(flatter, 0.01);
  return abs(depth_a - depth_b) - length(real2(a - b)) * pixel_size_at(min(depth_a, depth_b)) * slope;
}

// Returns the strength of the line between two pixels, from 0 for a small step to 1 for a large one.
GEOMETRY real step_ink(pixel_row a, real depth_a, pixel_row b, real depth_b) {
  real nearer = min(depth_a, depth_b);
  real least = least_step(nearer);
  real jump = jump_between(a, depth_a, b, depth_b);
  real missing = 1.0 - smoothstep(least, least + step_range(nearer), jump);
  real ink = 1.0 - missing * missing;  // approximately as strong as the eye perceives it
  ink = select(depth_a == real(kNothing) || depth_b == real(kNothing), real(1.0), ink);
  return select(depth_a == real(kNothing) && depth_b == real(kNothing), real(0.0), ink);
}

// True if a line separates two points because they belong to different parts. A mark is four times the number of the
// part, plus 2 on a surface that has patches, plus 3 in a patch, or plus 1 on a cap that has one colour for all parts.
GEOMETRY truth parts_differ(integer mark_a, integer mark_b) {
  truth separable = (mark_a & 3) != 1 && (mark_b & 3) != 1;
  return separable && (mark_a >> 2) != (mark_b >> 2);
}

// True if the border of a patch runs between two pixels that have hits: both are on the surface with patches, the
// surface is continuous between them, and exactly one of them is in a patch.
GEOMETRY truth parted_by_patch(pixel_row a, real depth_a, integer mark_a, pixel_row b, real depth_b, integer mark_b) {
  real tolerance = 0.3 + 2.0 * pixel_size_at(min(depth_a, depth_b));
  truth one_in_patch = (mark_a & mark_b & 2) != 0 && ((mark_a ^ mark_b) & 1) != 0;
  return one_in_patch && jump_between(a, depth_a, b, depth_b) <= tolerance;
}

// Returns the share of a pixel that a line covers at most. The line runs along the border towards the neighbour at this
// offset, with half of its width on each side. width: pixels.
GEOMETRY real covered_share(integer2 offset, float width) {
  return clamp(0.5 * width + 1.0 - length(real2(offset)), 0.0, 1.0);
}

// Returns the greatest offset in pixels of a neighbour whose lines can cover a part of the pixel.
GEOMETRY int farthest_neighbor() { return int(ceil(0.5 * params.widest_line)); }

// Returns the share of a pixel that the lines towards the neighbour at this offset cover. step: strength of a step of
// depth; seam: true between two parts; open: true if one of both pixels has no hit, so that the line is an outer line.
GEOMETRY real covered_by_border(integer2 offset, real step, truth seam, truth open) {
  real seam_ink = select(seam, covered_share(offset, params.part_lines), real(0.0));
  real inner_ink = max(covered_share(offset, params.inner_lines) * step, seam_ink);
  return select(open, covered_share(offset, params.outer_lines) * step, inner_ink);
}

// Returns the share of a colour that depth cueing leaves at this depth.
GEOMETRY real clarity(real depth) {
  real range = max(real(params.last_depth - params.first_depth), 1e-3);
  return 1.0 - params.depth_cue * clamp((depth - params.first_depth) / range, 0.0, 1.0);
}

#ifndef __cplusplus
// The final colour of a sample, for shaders; the CPU's rows have loops of their own (core/render/cpu/look_rows.h). The
// includer provides depth_at() and mark_at() of a pixel of the block. SHADE and SILHOUETTES are defined if they are
// requested.

// The share of a pixel that black lines cover, the depth of the object that they outline, and the share that lines
// around patches cover.
struct Ink {
  float covered;
  float depth;
  float patched;
};

// Returns the lines on a pixel. Software GL runs every branch, so each pixel first searches for its next relevant
// neighbour by cheap tests.
Ink ink_on(ivec2 pixel, float depth) {
  int reach = farthest_neighbor();
  Ink ink = Ink(0.0, depth, 0.0);
  ivec2 offset = ivec2(-reach - 1, -reach);
  do {
    ivec2 other;
    float share;
    float other_depth;
    bool step;
    bool seam;
    bool border;
    do {
      ++offset.x;
      if (offset.x > reach) offset = ivec2(-reach, offset.y + 1);
      other = pixel + offset;
      other_depth = depth_at(other);
      share = covered_share(offset, params.widest_line);
      bool inside = offset.y <= reach && in_block(other);
      bool counts = inside && share > ink.covered;
      step = counts && may_step(depth, other_depth);
      seam = border = false;
      if (params.has_marks != 0u && inside && depth != kNothing && other_depth != kNothing) {
        int mark = mark_at(pixel);
        int other_mark = mark_at(other);
        seam = counts && parts_differ(mark, other_mark);
        border = covered_share(offset, params.patch_lines) > ink.patched &&
                 parted_by_patch(pixel, depth, mark, other, other_depth, other_mark);
      }
    } while (!step && !seam && !border && offset.y <= reach);
    float strength = step ? step_ink(pixel, depth, other, other_depth) : 0.0;
    float covered = covered_by_border(offset, strength, seam, depth == kNothing || other_depth == kNothing);
    if (border) ink.patched = covered_share(offset, params.patch_lines);
    if ((step || seam) && covered > ink.covered) ink = Ink(covered, min(depth, other_depth), ink.patched);
  } while (offset.y <= reach);
  return ink;
}

// Returns the final colour of a sample. color: linear, premultiplied.
vec4 finished_sample(vec4 color, ivec2 pixel, float depth) {
#ifdef SHADE
  if (depth != kNothing) color.rgb = shaded(color.rgb, color.a, pixel, depth);
#endif
  if (depth != kNothing) {
    float clear = clarity(depth);
    color = params.keeps_alpha != 0u ? vec4(mix(params.air * color.a, color.rgb, clear), color.a) : color * clear;
  }
#ifdef SILHOUETTES
  Ink ink = ink_on(pixel, depth);
  if (ink.patched > 0.0) {
    float patched = ink.patched * clarity(depth);
    color = mix(color, vec4(params.patch_line_color, 1.0), patched);
  }
  float covered = ink.covered * clarity(ink.depth);
  color = vec4(color.rgb * (1.0 - covered), mix(color.a, 1.0, covered));
#endif
  return color;
}
#endif
