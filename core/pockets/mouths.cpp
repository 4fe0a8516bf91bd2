// SPDX-License-Identifier: BSD-3-Clause
// Unites faces over their borders, and those of one large probe.
#include "core/pockets/mouths.h"

#include <algorithm>
#include <functional>

#include "core/math/union_find.h"
#include "core/surface/atom_areas.h"
#include "core/surface/primitives.h"

namespace meniscus {
namespace {

/// Whether each face touches large probes only.
std::vector<bool> faces_of_mouths(const Surface& s, const std::vector<bool>& is_probe) {
  const auto probe = [&](std::uint32_t atom) -> bool { return is_probe[atom]; };
  std::vector<bool> of_mouth(s.faces.size());
  for (std::size_t f = 0; f < s.faces.size(); ++f) {
    const std::uint32_t patch = s.faces[f].patch;
    switch (s.faces[f].kind) {
      case PatchKind::convex:
        of_mouth[f] = probe(s.convex[patch].atom);
        break;
      case PatchKind::toroidal:
        of_mouth[f] = std::ranges::all_of(s.toroidal[patch].atom, probe);
        break;
      case PatchKind::concave: {
        const auto first = s.contacts.begin() + s.concave[patch].first_contact;
        of_mouth[f] = std::all_of(first, first + s.concave[patch].contact_count, probe);
        break;
      }
    }
  }
  return of_mouth;
}

}  // namespace

std::vector<double> mouth_areas(const Surface& s, const std::vector<bool>& is_probe, double least) {
  const std::vector<bool> of_mouth = faces_of_mouths(s, is_probe);
  if (std::ranges::find(of_mouth, true) == of_mouth.end()) return {};
  UnionFind mouths(s.faces.size());
  for (const Border& border : s.borders)
    if (of_mouth[border.face[0]] && of_mouth[border.face[1]]) mouths.unite(border.face[0], border.face[1]);
  for (const ConvexPatch& patch : s.convex)
    for (std::uint32_t n = 1; n < patch.face_count && is_probe[patch.atom]; ++n)
      mouths.unite(patch.first_face, patch.first_face + n);

  std::vector<double> of_probes_alone(s.faces.size(), 0.0), area(s.faces.size(), 0.0);
  for (std::uint32_t f = 0; f < s.faces.size(); ++f)
    if (of_mouth[f]) of_probes_alone[mouths.find(f)] += s.faces[f].area;
  const std::vector<double> by_atom = atom_areas(s).surface;
  for (const ConvexPatch& patch : s.convex)
    if (is_probe[patch.atom]) area[mouths.find(patch.first_face)] += by_atom[patch.atom];
  std::vector<double> areas;
  for (std::size_t f = 0; f < s.faces.size(); ++f)
    if (of_probes_alone[f] > least) areas.push_back(area[f]);
  std::ranges::sort(areas, std::greater());
  return areas;
}

}  // namespace meniscus
