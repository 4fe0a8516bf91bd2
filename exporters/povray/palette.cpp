// SPDX-License-Identifier: BSD-3-Clause
// Collects equal colours, and splits patches between atoms of different colours.
#include "exporters/povray/scene_colors.h"

#include <algorithm>
#include <span>
#include <tuple>

#include "core/base/error.h"

namespace meniscus::povray {
namespace {

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

std::uint32_t ColorTable::number(SceneColor color) {
  color.film = color.film && color.opacity < 1.0f;
  const auto [known, is_new] = number_.try_emplace(
      {color.color.x, color.color.y, color.color.z, color.opacity, color.by_map, color.film, color.finish},
      static_cast<std::uint32_t>(colors_.size()));
  if (is_new) colors_.push_back(color);
  return known->second;
}

bool ColorTable::is_translucent() const {
  return std::ranges::any_of(colors_, [](const SceneColor& color) { return color.opacity < 1.0f; });
}

SceneColor scene_color(const Coloring& coloring, std::uint32_t atom, const ObjectStyle& style,
                       const std::optional<glm::vec3>& color) {
  const float opacity = coloring.shows(atom) ? coloring.opacity_of(atom) : 1.0f;
  return {color.value_or(coloring.atom[atom]), opacity, !color && coloring.by_volume(atom), style.film, style.finish};
}

Palette make_palette(const Surface& surface, const Coloring& coloring, ColorTable& table, const ObjectStyle& style) {
  if (coloring.atom.size() != surface.atoms.size())
    throw Error("POV-Ray export: the coloring does not have one colour for each atom");
  Palette palette;
  // If patches are coloured by kind, they are split only where opacities differ.
  std::vector<float> opacities;
  const auto opacity_number = [&](float opacity) {
    const auto known = std::ranges::find(opacities, opacity);
    const auto place = static_cast<std::uint32_t>(known - opacities.begin());
    if (known == opacities.end()) opacities.push_back(opacity);
    return place;
  };
  for (std::uint32_t a = 0; a < surface.atoms.size(); ++a) {
    const SceneColor color = scene_color(coloring, a, style);
    const std::uint32_t shown = coloring.kind ? opacity_number(color.opacity) : table.number(color);
    palette.atom_part.push_back(coloring.shows(a) ? shown : kNone);
  }
  for_each_patch(surface, [&](PatchKind kind, std::uint32_t patch, std::span<const std::uint32_t> atoms) {
    std::vector<std::uint32_t> parts;
    for (const std::uint32_t a : atoms)
      if (coloring.shows(a)) parts.push_back(palette.atom_part[a]);
    std::sort(parts.begin(), parts.end());
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    for (const std::uint32_t part : parts) {
      const std::uint32_t color = coloring.kind ? table.number({(*coloring.kind)[static_cast<std::size_t>(kind)],
                                                                opacities[part], false, style.film, style.finish})
                                                : part;
      palette.pieces.push_back({kind, color, part, patch, table.colors()[color].by_map});
    }
  });
  std::stable_sort(palette.pieces.begin(), palette.pieces.end(), [](const ColoredPiece& a, const ColoredPiece& b) {
    return std::tie(a.kind, a.color) < std::tie(b.kind, b.color);
  });
  return palette;
}

}  // namespace meniscus::povray
