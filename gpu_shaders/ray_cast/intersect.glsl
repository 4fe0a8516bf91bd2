// SPDX-License-Identifier: BSD-3-Clause
// Nearest point of one primitive on a ray.
//
// The ray arrives as a point `o` relative to the primitive's centre and close to it. Both sides of a patch count: a
// camera may stand inside the solid.

bool inside_planes(vec3 x, uint first_row, uint count) {
  for (uint i = 0u; i < count; ++i) {
    vec4 plane = rows[first_row + i];
    if (!in_half_space(x, plane.xyz, plane.w, slack)) return false;
  }
  return true;
}

// Parameter of the nearest hit in (low, high); `high` if there is none.
float hit_clipped_sphere(Primitive primitive, vec3 o, vec3 d, float radius, float low, float high) {
  SphereHits hits = ray_sphere(o, d, radius);
  if (!hits.found) return high;
  if (hits.near_t > low && hits.near_t < high &&
      inside_planes(o + d * hits.near_t, primitive.first_row + 1u, primitive.plane_count))
    return hits.near_t;
  if (hits.far_t > low && hits.far_t < high &&
      inside_planes(o + d * hits.far_t, primitive.first_row + 1u, primitive.plane_count))
    return hits.far_t;
  return high;
}

float hit_toroidal(Primitive primitive, vec3 o, vec3 d, float major, float low, float high) {
  vec4 shape = rows[primitive.first_row + 3u];
  vec4 x_axis = rows[primitive.first_row + 1u];
  vec4 z_axis = rows[primitive.first_row + 2u];
  vec3 y_axis = cross(z_axis.xyz, x_axis.xyz);
  vec3 local_o = vec3(dot(o, x_axis.xyz), dot(o, y_axis), dot(o, z_axis.xyz));
  vec3 local_d = vec3(dot(d, x_axis.xyz), dot(d, y_axis), dot(d, z_axis.xyz));
  // The sphere through both contact circles holds the whole patch and nothing of the outer half of the torus.
  SphereHits chord = ray_sphere(local_o - vec3(0.0, 0.0, shape.z), local_d, shape.w + slack);
  if (!chord.found) return high;
  low = max(low, chord.near_t - slack);
  float end = min(high, chord.far_t + slack);
  if (!(low < end)) return high;
  TorusHits hits = ray_torus(local_o, local_d, major, probe_radius, low, end, 2e-7);
  for (int i = 0; i < hits.count; ++i)
    if (in_toroidal_patch(local_o + local_d * hits.t[i], major, probe_radius, shape.x, shape.y, x_axis.w, z_axis.w,
                          int(primitive.plane_count), slack))
      return hits.t[i];
  return high;
}

// Parameter along p + t*d of the nearest hit in (low, high); `high` if there is none.
float hit_primitive(Primitive primitive, vec3 p, vec3 d, float low, float high) {
  // Outside of the bound there is nothing to do, and this is where most candidates end.
  vec3 to_bound = p - primitive.bound.xyz;
  float bound_t = -dot(to_bound, d);
  vec3 closest = to_bound + d * bound_t;
  float room = primitive.bound.w * primitive.bound.w - dot(closest, closest);
  if (room < 0.0) return high;
  if (bound_t - sqrt(room) > high) return high;

  // Start at the closest approach: there the numbers are as small as the primitive.
  vec4 place = rows[primitive.first_row];
  vec3 o = p - place.xyz;
  float shift = -dot(o, d);
  o += d * shift;
  float local_low = low - shift;
  float local_high = high - shift;
  float t = local_high;
  if (primitive.kind == kToroidal) t = hit_toroidal(primitive, o, d, place.w, local_low, local_high);
  else t = hit_clipped_sphere(primitive, o, d, place.w, local_low, local_high);
  return t < local_high ? t + shift : high;
}
