// SPDX-License-Identifier: BSD-3-Clause
// Finds the atom whose colour a point has, and tests if that atom is shown, because points of hidden atoms are not
// hits.
//
// Written in GLSL and, as the body of a struct, in C++ (core/render/cpu), where points may be packets with a common
// primitive. The includer provides row(), shows() of an atom, and `some_hidden`, which is false if all atoms are shown.

// Returns the atom of a point on a concave patch, which is the atom of the nearest contact. If two contacts are equally
// near, it is the atom with the smaller number, in any order of the contacts. x: point relative to the probe's centre.
GEOMETRY natural concave_atom(Primitive primitive, real3 x, float radius) {
  uint first_contact = primitive.first_row + 1u + primitive.plane_count;
  natural atom = natural(kNoPrimitive);
  real best = real(-2.0 * radius);
  for (uint i = 0u; i < primitive.atom; ++i) {
    vec4 contact = row(first_contact + i);
    real nearness = dot(vec3(contact), x);
    uint candidate = floatBitsToUint(contact.w);
    truth wins = nearness > best || (nearness == best && natural(candidate) < atom);
    best = select(wins, nearness, best);
    atom = select(wins, natural(candidate), atom);
  }
  return atom;
}

// Returns the atom of a point on a toroidal patch. x: point in the frame of the torus.
GEOMETRY natural toroidal_atom(Primitive primitive, real3 x, float major) {
  vec4 atoms = row(primitive.first_row + 4u);
  return select(toroidal_second_atom(x, major, atoms.x, atoms.y, atoms.z, atoms.w), natural(primitive.second_atom),
                natural(primitive.atom));
}

// True if the atom of a point on a convex or concave patch is shown. x: point relative to the centre of the sphere.
GEOMETRY truth shows_sphere_point(Primitive primitive, real3 x, float radius) {
  if (!some_hidden) return truth(true);
  if (primitive.kind == kConvex) return shows(natural(primitive.atom));
  return shows(concave_atom(primitive, x, radius));
}

GEOMETRY truth shows_torus_point(Primitive primitive, real3 x, float major) {
  if (!some_hidden) return truth(true);
  return shows(toroidal_atom(primitive, x, major));
}
