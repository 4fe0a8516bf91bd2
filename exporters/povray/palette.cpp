// SPDX-License-Identifier: BSD-3-Clause
// Gathers equal colours and splits patches between atoms of different colours.
#include "exporters/povray/palette.h"

#include <algorithm>
#include <map>
#include <span>
#include <tuple>

#include "core/base/error.h"

namespace meniscus::povray {
namespace {

// Numbers colours in order of first use.
class ColorNumbers {
 public:
  explicit ColorNumbers(std::vector<glm::vec3>& colors) : colors_(colors) {}
  std::uint32_t operator()(const glm::vec3& c) {
    const auto [known, is_new] = number_.try_emplace({c.x, c.y, c.z}, static_cast<std::uint32_t>(colors_.size()));
    if (is_new) colors_.push_back(c);
    return known->second;
  }

 private:
  std::map<std::tuple<float, float, float>, std::uint32_t> number_;
  std::vector<glm::vec3>& colors_;
};

// Calls visit(kind, patch index, touched atoms) for every patch that has a face.
void for_each_patch(const Surface& surface, const auto& visit) {
  for (std::uint32_t n = 0; n < surface.convex.size(); ++n)
    if (surface.convex[n].face_count > 0) visit(PatchKind::convex, n, std::span(&surface.convex[n].atom, 1));
  if (surface.probe_radius == 0.0) return;
  for (std::uint32_t n = 0; n < surface.toroidal.size(); ++n)
    if (surface.toroidal[n].face_count > 0) visit(PatchKind::toroidal, n, std::span(surface.toroidal[n].atom));
  for (std::uint32_t n = 0; n < surface.concave.size(); ++n) {
    const ConcavePatch& c = surface.concave[n];
    const std::span contacts(surface.contacts.data() + c.first_contact, c.contact_count);
    if (c.face_count > 0) visit(PatchKind::concave, n, contacts);
  }
}

}  // namespace

Palette make_palette(const Surface& surface, const Coloring& coloring) {
  if (!coloring.kind && coloring.atom.size() != surface.atoms.size())
    throw Error("POV-Ray export: the coloring does not have one colour for each atom");
  Palette palette;
  ColorNumbers number(palette.colors);
  if (!coloring.kind)
    for (const glm::vec3& c : coloring.atom) palette.atom_color.push_back(number(c));
  for_each_patch(surface, [&](PatchKind kind, std::uint32_t patch, std::span<const std::uint32_t> atoms) {
    std::vector<std::uint32_t> colors;
    if (coloring.kind)
      colors.push_back(number((*coloring.kind)[static_cast<std::size_t>(kind)]));
    else
      for (const std::uint32_t a : atoms) colors.push_back(palette.atom_color[a]);
    std::sort(colors.begin(), colors.end());
    colors.erase(std::unique(colors.begin(), colors.end()), colors.end());
    for (const std::uint32_t c : colors) palette.pieces.push_back({kind, c, patch});
  });
  std::stable_sort(palette.pieces.begin(), palette.pieces.end(), [](const ColoredPiece& a, const ColoredPiece& b) {
    return std::tie(a.kind, a.color) < std::tie(b.kind, b.color);
  });
  return palette;
}

}  // namespace meniscus::povray
