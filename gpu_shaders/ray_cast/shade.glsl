// SPDX-License-Identifier: BSD-3-Clause
// What a hit looks like: its normal, its atom, and studio light on its colour.

struct SurfacePoint {
  vec3 normal;  // towards the solvent
  uint atom;
};

SurfacePoint surface_point(Primitive primitive, vec3 p) {
  SurfacePoint point;
  vec4 place = row(primitive.first_row);
  vec3 x = p - place.xyz;
  point.atom = primitive.atom;
  if (primitive.kind == kConvex) {
    point.normal = x / place.w;
  } else if (primitive.kind == kConcave) {
    point.normal = -x / place.w;
    point.atom = concave_atom(primitive, x, place.w);
  } else {
    vec3 x_axis = row(primitive.first_row + 1u).xyz;
    vec3 z_axis = row(primitive.first_row + 2u).xyz;
    vec3 y_axis = cross(z_axis, x_axis);
    vec3 local = vec3(dot(x, x_axis), dot(x, y_axis), dot(x, z_axis));
    vec3 normal = torus_normal(local, place.w, params.probe_radius);
    point.normal = x_axis * normal.x + y_axis * normal.y + z_axis * normal.z;
    point.atom = toroidal_atom(primitive, local, place.w);
  }
  point.normal = normalize(point.normal);
  return point;
}

// Key light (unless told otherwise from the upper left behind the camera), a dim fill from the right, a sky that is
// brighter above, and a little sheen. All directions are in the camera's axes (x right, y up, z towards the camera);
// colours are linear.
vec3 studio_light(vec3 albedo, vec3 n, vec3 to_camera) {
  vec3 key = params.key_direction;
  const vec3 fill = normalize(vec3(0.85, -0.05, 0.45));
  // Wrapped diffuse light: a soft terminator, as from a large lamp.
  float key_light = max((dot(n, key) + 0.25) / 1.25, 0.0);
  float fill_light = max((dot(n, fill) + 0.3) / 1.3, 0.0);
  float sky = 0.5 + 0.5 * n.y;
  float facing = max(dot(n, to_camera), 0.0);
  vec3 light = params.key_strength * (vec3(1.0, 0.97, 0.92) * (0.78 * key_light * key_light)) +
               vec3(0.75, 0.85, 1.0) * (0.20 * fill_light) +
               mix(vec3(0.10, 0.09, 0.09), vec3(0.24, 0.26, 0.29), sky) * (0.35 + 0.65 * facing);
  vec3 half_way = normalize(key + to_camera);
  float sheen = params.key_strength * (0.10 * pow(max(dot(n, half_way), 0.0), 40.0));
  return albedo * light + vec3(sheen);
}
