// SPDX-License-Identifier: BSD-3-Clause
// Computes the normal and the atom of a hit, and applies studio light to its colour.
//
// This file is written in GLSL and, as the body of a struct, in C++ (core/render/cpu), where points may be packets with
// a common primitive. The includer provides patch_hits.glsl and studio_light.glsl.

struct SurfacePoint {
  real3 normal;  // towards the solvent
  natural atom;
};

GEOMETRY SurfacePoint surface_point(Primitive primitive, real3 p) {
  SurfacePoint point;
  vec4 place = row(primitive.first_row);
  real3 x = p - vec3(place);
  point.atom = natural(primitive.atom);
  if (primitive.kind == kConvex) {
    point.normal = x / place.w;
  } else if (primitive.kind == kConcave) {
    point.normal = -x / place.w;
    point.atom = concave_atom(primitive, x, place.w);
  } else {
    vec3 x_axis = vec3(row(primitive.first_row + 1u));
    vec3 z_axis = vec3(row(primitive.first_row + 2u));
    vec3 y_axis = cross(z_axis, x_axis);
    real3 local = real3(dot(x, x_axis), dot(x, y_axis), dot(x, z_axis));
    real3 normal = torus_normal(local, place.w, params.probe_radius);
    point.normal = x_axis * normal.x + y_axis * normal.y + z_axis * normal.z;
    point.atom = toroidal_atom(primitive, local, place.w);
  }
  point.normal = normalize(point.normal);
  return point;
}

GEOMETRY real3 in_camera_axes(real3 v) {
  return real3(dot(v, view.right), dot(v, view.up), -dot(v, view.forward));
}

// Returns a normal in the camera's axes, reversed if necessary so that it points to the camera's side. Surfaces are
// visible from inside the solid, and through hidden parts, too. d: direction of the ray.
GEOMETRY real3 shown_normal(real3 normal, real3 d) {
  real3 n = in_camera_axes(normal);
  return select(dot(n, -in_camera_axes(d)) < 0.0, -n, n);
}

// Returns a colour in studio light where a ray of direction d meets a surface with this normal.
GEOMETRY real3 lit(real3 albedo, real3 normal, real3 d) {
  real3 n = shown_normal(normal, d);
  return studio_light(albedo, n, -in_camera_axes(d), open_key_light(n));
}
