// SPDX-License-Identifier: BSD-3-Clause
// Computes the part of a ray that planes keep, and the opacity of a film along a ray.
//
// This file is written in GLSL and, as the body of a struct, in C++ (core/render/cpu), where rays may be packets with
// common planes. The includer provides plane_count(), plane() of a number below that (points with dot(xyz, x) < w are
// kept), and patch_hits.glsl.

const uint kNoPlane = 0xffffffffu;  // the camera; far away

// The part of a ray that all planes keep, and the planes at its begin and its end. Nothing is kept unless `to` is
// greater than `from`.
struct KeptPart {
  real from;
  real to;
  natural from_plane;
  natural to_plane;
};

GEOMETRY KeptPart kept_part(real3 p, real3 d, real eye_t) {
  KeptPart kept;
  kept.from = eye_t;
  kept.to = real(kMiss);
  kept.from_plane = natural(kNoPlane);
  kept.to_plane = natural(kNoPlane);
  for (int i = 0; i < plane_count(); ++i) {
    vec4 cut = plane(i);
    real room = cut.w - dot(p, vec3(cut));
    real slope = dot(d, vec3(cut));
    real t = room / slope;
    truth goes_in = slope < real(0.0) && t > kept.from;
    truth goes_out = slope > real(0.0) && t < kept.to;
    kept.from = select(goes_in, t, kept.from);
    kept.from_plane = select(goes_in, natural(uint(i)), kept.from_plane);
    kept.to = select(goes_out || (slope == real(0.0) && room <= real(0.0)), select(goes_out, t, real(-kMiss)), kept.to);
    kept.to_plane = select(goes_out, natural(uint(i)), kept.to_plane);
  }
  return kept;
}

// Returns the opacity of a film along a ray, which is greater at grazing angles because the path in it is longer
// (Bouguer 1729). straight: opacity for a perpendicular ray, between 0 and 1; facing: cosine of the angle between ray
// and normal.
GEOMETRY real film_opacity(real straight, real facing) {
  return 1.0 - pow(1.0 - straight, 1.0 / max(abs(facing), 0.05));
}
