// SPDX-License-Identifier: BSD-3-Clause
// Stage "cusps": finds the exposed arcs of the circle of each pair of probes that cut each other.
// Reads: circles, neighbour lists of probes, heads, sides. Writes: arcs (after their counters), doubtful. One
// invocation per circle. Overflow: appends stop at the capacity but go on counting; the host grows and runs again.
// Based on: Totrov & Abagyan 1996, applied to fixed probes; the order around the axis decides for pencils of spindle
// circles.
#version 450 core
layout(local_size_x = 64) in;
#include "gpu_shaders/shared/dispatch.glsl"
#include "gpu_shaders/shared/constants.glsl"
#include "gpu_shaders/shared/parameters.glsl"
#include "gpu_shaders/reduced_surface/precision.glsl"
#include "gpu_shaders/reduced_surface/exposed_arcs.glsl"

layout(std430, binding = 0) readonly buffer Circles { uvec2 circles[]; };  // probe s, place of probe t in its list
layout(std430, binding = 1) readonly buffer NeighborFirst { uint neighbor_first[]; };
layout(std430, binding = 2) readonly buffer NeighborLabels { uint neighbor_labels[]; };
layout(std430, binding = 3) readonly buffer NeighborBalls { vec4 neighbor_balls[]; };
layout(std430, binding = 4) readonly buffer Heads { uvec2 heads[]; };  // first side of each probe, 1 if it is low
layout(std430, binding = 5) readonly buffer Sides { SideRecord sides[]; };
layout(std430, binding = 6) buffer Arcs {
  uint arc_count;
  uint doubtful_count;
  uint spare0;
  uint spare1;
  CuspArcRecord arcs[];
};
layout(std430, binding = 7) writeonly buffer Doubtful { uvec2 doubtful[]; };
layout(std140, binding = 0) uniform Parameters { CuspParameters params; };

const uint kPencilCapacity = 6u;  // spindle circles that a pair of probes may share; pairs with more are doubtful
uint pencil_sides[kPencilCapacity];

bool reserve_pencils(uint count) { return count <= kPencilCapacity; }
uint first_side(uint probe) { return heads[probe].x; }
uint circle_of(uint side) { return sides[side].circle; }
uint partner_of(uint side) { return sides[side].partner; }

#include "gpu_shaders/geometry/pencil.glsl"

// The margin within which single precision does not decide if a pair's circle meets the axis of a spindle, and the
// error of the points where it does.
const float kAxisDoubt = 1e-4;
const float kAxisError = 1e-6;

// Removes the parts of the pair's circle past the axes of shared spindle circles.
void cover_past_axes() {
  for (uint k = 0u; k < pencil_count; ++k) {
    SideRecord side = sides[pencil_sides[k]];
    HalfPlane h = half_plane_past_axis(contour_circle, side.gap_direction.xyz, side.circle_center.xyz);
    // The end points are named, but their positions are not exact in single precision, which affects other decisions.
    h.error = kAxisError * (1.0 + abs(h.offset));
    float margin;
    int meeting = meet_axis(h, side.touching == 1u, margin);
    if (side.touching == 1u || margin < kAxisDoubt) exposed_doubtful = true;
    else if (meeting == kCuts) cover(h, kAxisLabel | pencil_sides[k]);
    else if (meeting == kCovers) cover_everything();
  }
}

void append(uint s, uint t, uint by_begin, uint by_end, vec3 begin, vec3 end) {
  uint slot = atomicAdd(arc_count, 1u);
  if (slot >= params.arc_capacity) return;
  arcs[slot].names = uvec4(s, t, by_begin, by_end);
  arcs[slot].begin = vec4(begin, 0.0);
  arcs[slot].end = vec4(end, 0.0);
}

void main() {
  uint index = linear_invocation_index();
  if (index >= params.circle_count) return;
  uint s = circles[index].x;
  uint place = circles[index].y;
  uint t = neighbor_labels[place];
  vec4 other = neighbor_balls[place];
  float w0 = other.w;  // all probes have one radius
  Circle c = circle_of_two_spheres(other.xyz, w0, w0);
  begin_contour(c, w0, kUnitRoundoff);
  if (!find_pencils(s, t)) return;
  if (pencils_left_out) exposed_doubtful = true;
  if (c.radius_squared < kSmallestCircle * kUnitRoundoff * w0 || dot(other.xyz, other.xyz) < 1e-4 * w0) exposed_doubtful = true;
  if (!exposed_doubtful) cover_past_axes();
  uint last = neighbor_first[s - params.first_probe + 1u];
  for (uint n = neighbor_first[s - params.first_probe]; n < last; ++n) {
    if (contour_ended()) break;
    uint u = neighbor_labels[n];
    if (n == place || on_pencil(u)) continue;
    vec4 ball = neighbor_balls[n];
    block(blocking_ball(ball.xyz, ball.w, w0), u);
  }
  if (loops_cut_short()) exposed_doubtful = true;
  if (exposed_doubtful) {
    uint slot = atomicAdd(doubtful_count, 1u);
    if (slot < params.doubtful_capacity) doubtful[slot] = circles[index];
    return;
  }
  if (exposed_whole) append(s, t, kNone, kNone, c.u, c.u);
  for (uint n = 0u; n < exposed_count; ++n) {
    ExposedArc arc = get_arc(n);
    vec2 begin = direction_at(arc.begin);
    vec2 end = direction_at(arc.end);
    append(s, t, arc.begin_by, arc.end_by, begin.x * c.u + begin.y * c.v, end.x * c.u + end.y * c.v);
  }
}
