// SPDX-License-Identifier: BSD-3-Clause
// Intersects rays with cylinders and triangles, which are drawn in addition to a surface, and computes normals and
// atoms.
//
// This file is written in GLSL and, as the body of a struct, in C++ (core/render/cpu), where rays and points may be
// packets with a common shape. The includer provides row(), and includes patch_hits.glsl and shade.glsl before. Rays
// are moved to their closest approach first, as in patch_hits.glsl.

struct CylinderMeeting {
  truth near_found;
  truth far_found;
  real near_t;
  real far_t;
};

GEOMETRY CylinderMeeting meet_cylinder(Primitive primitive, real3 p, real3 d) {
  vec4 place = row(primitive.first_row);
  vec4 axis = row(primitive.first_row + 1u);
  real3 o = p - vec3(place);
  real shift = -dot(o, d);
  o = o + d * shift;
  SphereHits hits = ray_cylinder(o, d, real3(vec3(axis)), place.w);
  CylinderMeeting meeting;
  meeting.near_found = hits.found && abs(dot(o + d * hits.near_t, vec3(axis))) <= real(axis.w);
  meeting.far_found = hits.found && abs(dot(o + d * hits.far_t, vec3(axis))) <= real(axis.w);
  meeting.near_t = hits.near_t + shift;
  meeting.far_t = hits.far_t + shift;
  return meeting;
}

GEOMETRY TriangleHit meet_triangle(Primitive primitive, real3 p, real3 d) {
  real3 o = p - vec3(row(primitive.first_row));
  real shift = -dot(o, d);
  TriangleHit hit = ray_triangle(o + d * shift, d, real3(vec3(row(primitive.first_row + 1u))),
                                 real3(vec3(row(primitive.first_row + 2u))), 1e-5);
  hit.t = hit.t + shift;
  return hit;
}

GEOMETRY SurfacePoint cylinder_point(Primitive primitive, real3 p) {
  vec4 axis = row(primitive.first_row + 1u);
  real3 x = p - vec3(row(primitive.first_row));
  real along = dot(x, vec3(axis));
  SurfacePoint point;
  point.normal = normalize(x - vec3(axis) * along);
  point.atom = select(along < real(0.0), natural(primitive.atom), natural(primitive.second_atom));
  return point;
}

// Returns the normal and the atom of a point of a triangle. The normal is interpolated by barycentric weights, and the
// atom is that of the corner with the greatest weight.
GEOMETRY SurfacePoint triangle_point(Primitive primitive, real3 p) {
  vec3 e1 = vec3(row(primitive.first_row + 1u));
  vec3 e2 = vec3(row(primitive.first_row + 2u));
  real3 x = p - vec3(row(primitive.first_row));
  vec3 n = cross(e1, e2);
  real scale = real(1.0 / dot(n, n));
  real u = dot(cross(x, real3(e2)), n) * scale;
  real v = dot(cross(real3(e1), x), n) * scale;
  real w = real(1.0) - u - v;
  vec4 a = row(primitive.first_row + 3u);
  vec4 b = row(primitive.first_row + 4u);
  vec4 c = row(primitive.first_row + 5u);
  SurfacePoint point;
  point.normal = normalize(vec3(a) * w + vec3(b) * u + vec3(c) * v);
  natural other = select(u < v, natural(floatBitsToUint(c.w)), natural(floatBitsToUint(b.w)));
  point.atom = select(w < max(u, v), other, natural(floatBitsToUint(a.w)));
  return point;
}
