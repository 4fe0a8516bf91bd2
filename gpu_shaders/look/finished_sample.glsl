// SPDX-License-Identifier: BSD-3-Clause
// Computes the final colour of a sample with shade, depth cueing and lines.
//
// Written in GLSL only; the CPU's rows have loops of their own (core/render/cpu/look_rows.h). The includer provides
// finish.glsl, and depth_at() and mark_at() of a pixel of the block. SHADE and SILHOUETTES are defined if they are
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
