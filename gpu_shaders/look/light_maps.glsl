// SPDX-License-Identifier: BSD-3-Clause
// Computes the share of the sky and of the lamp that a point sees, from maps of what is drawn (Tarini, Cignoni &
// Montani 2006).
//
// A texel of a map has, above a plane, the height of the outermost thing that covers all of the texel, in 13 bits from
// bit 18; the height of the highest edge above that, in 13 bits from bit 5; and the share of the texel that this edge
// covers, in 31sts, in 5 bits. For each axis of the sky there are two maps, one for each of its ends; for each place on
// the lamp there is one. The sky's axes are fixed in the molecule, so its shade has no noise and does not flicker. A row
// of pixels reads the maps of one phase of kLightPhases; the mean over neighbouring rows (finish.glsl) has all phases.
// This file is written in GLSL and, as the body of a struct, in C++ (view_space.glsl). The includer provides `maps` of
// LightMapParameters, and light_texel() of an index in GLSL, two_light_texels() in C++.

#ifndef __cplusplus
// Returns the texel at an index and the one behind it.
ivec2 two_light_texels(int at) { return ivec2(light_texel(at), light_texel(at + 1)); }
#endif

// Returns the share of the light that a texel blocks above a height.
GEOMETRY real blocked_at(integer texel, integer height) {
  real edge = select(height < ((texel >> 5) & 8191), real(texel & 31) * (1.0 / 31.0), real(0.0));
  return select(height < (texel >> 18), real(1.0), edge);
}

// Returns the share of the light in the direction of a map that does not reach a point, filtered over the four
// surrounding texels (percentage-closer filtering, Reeves, Salesin & Cook 1987). Each texel is compared with the height
// of the point's tangential plane there. row: index of the map's first row; first: index of its first texel; down: true
// if the map's heights count against the axis; edge: of the map, texels.
GEOMETRY real blocked(real3 p, real3 normal, int row, integer first, truth down, int edge, float texel) {
  vec4 to_column = maps.rows[row];
  vec4 to_line = maps.rows[row + 1];
  vec4 to_height = maps.rows[row + 2];
  float last = float(edge) - 1.001;
  real column = clamp(dot(p, vec3(to_column)) + to_column.w, 0.0, last);
  real line = clamp(dot(p, vec3(to_line)) + to_line.w, 0.0, last);
  integer2 place = integer2(real2(column, line));
  integer at = first + place.y * edge + place.x;
  real right = column - real(place.x);
  real below = line - real(place.y);
  float steps = float(kLightSteps) / float(edge);  // steps of height per side of a texel
  real slope = -steps / max(abs(dot(normal, vec3(to_height))), 0.17 / texel);
  real to_right = dot(normal, vec3(to_column)) * slope;
  real to_below = dot(normal, vec3(to_line)) * slope;
  real height = dot(p, vec3(to_height)) + to_height.w;
  height = select(down, -height, height) * steps + 0.5 * float(kLightSteps) - to_right * right - to_below * below;
  integer2 upper = integer2(real2(max(height, 0.0), max(height + to_right, 0.0)));
  height = height + to_below;
  integer2 lower = integer2(real2(max(height, 0.0), max(height + to_right, 0.0)));
  integer2 over = two_light_texels(at);
  integer2 under = two_light_texels(at + edge);
  return mix(mix(blocked_at(over.x, upper.x), blocked_at(over.y, upper.y), right),
             mix(blocked_at(under.x, lower.x), blocked_at(under.y, lower.y), right), below);
}

// Returns the first map that a row of pixels reads.
GEOMETRY int light_phase(int row) { return (int(floor(view.first_offset.y)) + row) & (kLightPhases - 1); }

// Returns the point from which light is looked for. p: a point; texel: side of a texel of the maps, Å.
GEOMETRY real3 lifted(real3 p, real3 normal, float texel) { return p + normal * (kLightLift * texel); }

// Adds the light around an axis of the sky that reaches a point, weighted by the cosine, to sky.x, and all to sky.y.
GEOMETRY void add_sky(int axis, real3 from, real3 normal, GEOMETRY_INOUT(real2) sky) {
  int texels = maps.sky_edge * maps.sky_edge;
  real cosine = dot(normal, vec3(maps.rows[3 * axis + 2]));
  truth down = cosine < 0.0;
  integer first = select(down, integer((2 * axis + 1) * texels), integer(2 * axis * texels));
  real weight = abs(cosine);
  sky.x += weight * (1.0 - blocked(from, normal, 3 * axis, first, down, maps.sky_edge, maps.sky_texel));
  sky.y += weight;
}

// Returns the light of a place on the lamp that reaches a point. Places below its horizon are out of sight, and fade
// close to it.
GEOMETRY real lamp_light(int n, real3 from, real3 normal) {
  int first_row = 3 * (maps.sky_axes + n);
  real above = clamp(dot(normal, vec3(maps.rows[first_row + 2])) * (12.0 * maps.lamp_texel), 0.0, 1.0);
  integer first = integer(maps.first_lamp_texel + n * (maps.lamp_edge * maps.lamp_edge));
  return above * (1.0 - blocked(from, normal, first_row, first, truth(false), maps.lamp_edge, maps.lamp_texel));
}

// Returns the share of the lamp whose light reaches a point.
GEOMETRY real share_of_lamp(real light) { return light * (float(kLightPhases) / float(maps.lamp_places)); }

#ifndef __cplusplus
// The visibilities of one point, for shaders; the CPU reads a map for many points at once (look_rows.h). p, normal: in
// the camera's axes, on the viewer's side of the surface; row: of the pixel.

// Returns the share of the sky, from 0 to 1 and weighted by the cosine, that a point sees.
float sky_visibility(vec3 p, vec3 normal, int row) {
  vec3 from = lifted(p, normal, maps.sky_texel);
  vec2 sky = vec2(0.0, 1e-6);
  for (int axis = light_phase(row); axis < maps.sky_axes; axis += kLightPhases) add_sky(axis, from, normal, sky);
  return sky.x / sky.y;
}

// Returns the share of the lamp that a point sees.
float lamp_visibility(vec3 p, vec3 normal, int row) {
  vec3 from = lifted(p, normal, maps.lamp_texel);
  float light = 0.0;
  for (int n = light_phase(row); n < maps.lamp_places; n += kLightPhases) light += lamp_light(n, from, normal);
  return share_of_lamp(light);
}
#endif
