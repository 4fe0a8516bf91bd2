// SPDX-License-Identifier: BSD-3-Clause
// Computes the share of the sky and of the lamp that a point sees, from maps of what is drawn (Tarini, Cignoni &
// Montani 2006).
//
// A map has, for each texel of a plane, the height of the outermost thing above the plane. For each axis of the sky
// there are two maps, one for each of its ends; for each place on the lamp there is one. The axes are fixed in the
// molecule, and a point reads all maps, so its shade depends on the point alone: it has no noise and does not flicker.
// Written in GLSL and, as the body of a struct, in C++ (view_space.glsl). The includer provides `maps` of
// LightMapParameters, and light_texel() of an index.

// Returns the share of the light that something at a height above a point blocks, Å. It grows over half a texel, so
// that borders of shadows are smooth.
GEOMETRY real blocked_at(real height, float texel) { return clamp(height * (2.0 / texel), 0.0, 1.0); }

// Returns the share of the light in the direction of a map that does not reach a point, filtered over the four
// surrounding texels (percentage-closer filtering, Reeves, Salesin & Cook 1987). row: index of the map's first row;
// first: index of its first texel; down: true if the map's heights count against the axis.
GEOMETRY real blocked(real3 p, int row, integer first, truth down, int edge, float texel) {
  vec4 to_column = maps.rows[row];
  vec4 to_line = maps.rows[row + 1];
  vec4 to_height = maps.rows[row + 2];
  float last = float(edge) - 1.001;
  real column = clamp(dot(p, vec3(to_column)) + to_column.w, 0.0, last);
  real line = clamp(dot(p, vec3(to_line)) + to_line.w, 0.0, last);
  real height = dot(p, vec3(to_height)) + to_height.w;
  height = select(down, -height, height);
  integer2 place = integer2(real2(column, line));
  integer at = first + place.y * edge + place.x;
  real right = column - real(place.x);
  integer below = at + edge;
  real upper = mix(blocked_at(light_texel(at) - height, texel), blocked_at(light_texel(at + 1) - height, texel), right);
  real lower =
      mix(blocked_at(light_texel(below) - height, texel), blocked_at(light_texel(below + 1) - height, texel), right);
  return mix(upper, lower, line - real(place.y));
}

// Returns the share of the sky, from 0 to 1 and weighted by the cosine, that a point sees. p, normal: in the camera's
// axes, on the viewer's side of the surface.
GEOMETRY real sky_visibility(real3 p, real3 normal) {
  real3 from = p + normal * (kLightLift * maps.sky_texel);
  int texels = maps.sky_edge * maps.sky_edge;
  real seen = real(0.0);
  real all = real(1e-6);
  for (int axis = 0; axis < maps.sky_axes; ++axis) {
    real cosine = dot(normal, vec3(maps.rows[3 * axis + 2]));
    truth down = cosine < 0.0;
    integer first = select(down, integer((2 * axis + 1) * texels), integer(2 * axis * texels));
    real weight = abs(cosine);
    seen += weight * (1.0 - blocked(from, 3 * axis, first, down, maps.sky_edge, maps.sky_texel));
    all += weight;
  }
  return seen / all;
}

// Returns the share of the lamp that a point sees. Places below its horizon are out of sight, and fade close to it.
GEOMETRY real lamp_visibility(real3 p, real3 normal) {
  real3 from = p + normal * (kLightLift * maps.lamp_texel);
  int texels = maps.lamp_edge * maps.lamp_edge;
  real seen = real(0.0);
  for (int n = 0; n < maps.lamp_places; ++n) {
    int row = 3 * (maps.sky_axes + n);
    real above = clamp(dot(normal, vec3(maps.rows[row + 2])) * 8.0, 0.0, 1.0);
    integer first = integer(maps.first_lamp_texel + n * texels);
    seen += above * (1.0 - blocked(from, row, first, truth(false), maps.lamp_edge, maps.lamp_texel));
  }
  return seen / float(maps.lamp_places);
}
