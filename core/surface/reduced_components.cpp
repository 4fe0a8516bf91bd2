// SPDX-License-Identifier: BSD-3-Clause
// Joins fixed probes along arcs, and arcs across contact faces: the places that the probe reaches by rolling.
#include "core/surface/reduced_components.h"

#include "core/math/union_find.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/compute_surface.h"
#include "core/surface/measure.h"

namespace meniscus {
namespace {

std::uint32_t index(std::size_t n) { return static_cast<std::uint32_t>(n); }

/// A union-find over faces (only the convex ones count), toroidal patches and probes.
class ComponentNames {
 public:
  explicit ComponentNames(const Surface& surface)
      : s_(surface),
        first_toroidal_(index(surface.faces.size())),
        first_probe_(index(first_toroidal_ + surface.toroidal.size())),
        joined_(first_probe_ + surface.concave.size()) {
    for (std::uint32_t t = 0; t < s_.toroidal.size(); ++t)
      for (const std::uint32_t probe : s_.toroidal[t].probe)
        if (probe != kNone) joined_.unite(of_toroidal(t), of_probe(probe));
    for (const Border& border : s_.borders) {
      if (border.kind != BorderKind::contact) continue;
      joined_.unite(node_of_face(border.face[0]), node_of_face(border.face[1]));
    }
  }

  std::uint32_t name_of_face(std::uint32_t face) { return index(joined_.find(node_of_face(face))); }
  std::uint32_t name_of_toroidal(std::uint32_t t) { return index(joined_.find(of_toroidal(t))); }
  std::uint32_t name_of_probe(std::uint32_t probe) { return index(joined_.find(of_probe(probe))); }
  std::size_t size() const { return first_probe_ + s_.concave.size(); }

 private:
  std::uint32_t of_toroidal(std::uint32_t t) const { return first_toroidal_ + t; }
  std::uint32_t of_probe(std::uint32_t probe) const { return first_probe_ + probe; }
  std::uint32_t node_of_face(std::uint32_t face) const {
    const Face& f = s_.faces[face];
    if (f.kind == PatchKind::convex) return face;
    return f.kind == PatchKind::toroidal ? of_toroidal(f.patch) : of_probe(f.patch);
  }

  const Surface& s_;
  std::uint32_t first_toroidal_, first_probe_;
  UnionFind joined_;
};

ReducedComponents in_order_of_faces(const Surface& surface) {
  ReducedComponents found;
  ComponentNames names(surface);
  std::vector<std::uint32_t> number(names.size(), kNone);
  const auto numbered = [&](std::uint32_t name) {
    if (number[name] == kNone) number[name] = found.count++;
    return number[name];
  };
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f) found.of_face.push_back(numbered(names.name_of_face(f)));
  for (std::uint32_t t = 0; t < surface.toroidal.size(); ++t)
    found.of_toroidal.push_back(numbered(names.name_of_toroidal(t)));
  for (std::uint32_t p = 0; p < surface.concave.size(); ++p) found.of_probe.push_back(numbered(names.name_of_probe(p)));
  return found;
}

/// Returns the components for a probe of radius 0: convex faces meet, and nothing rolls.
ReducedComponents without_probe(const Surface& surface) {
  ReducedComponents found;
  found.count = index(surface.components.size());
  for (const Face& face : surface.faces) found.of_face.push_back(face.component);
  return found;
}

void sort_by_size(const Surface& surface, ReducedComponents& components) {
  const std::vector<ReducedComponentSize> sizes = sizes_of(surface, components);
  std::vector<std::uint32_t> order(components.count);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const bool cavity_a = sizes[a].volume < 0, cavity_b = sizes[b].volume < 0;
    return cavity_a != cavity_b ? cavity_b : area_rank(sizes[a].area()) > area_rank(sizes[b].area());
  });
  std::vector<std::uint32_t> rank(order.size());
  for (std::uint32_t n = 0; n < order.size(); ++n) rank[order[n]] = n;
  for (auto* column : {&components.of_face, &components.of_toroidal, &components.of_probe})
    for (std::uint32_t& component : *column) component = rank[component];
}

}  // namespace

ReducedComponents reduced_components(const Surface& surface) {
  ReducedComponents components = surface.probe_radius > 0 ? in_order_of_faces(surface) : without_probe(surface);
  sort_by_size(surface, components);
  return components;
}

bool cut_each_other(const Surface& surface, const ReducedComponents& components) {
  if (components.of_probe.empty()) return false;
  for (std::uint32_t s = 0; s < surface.concave.size(); ++s) {
    const std::span cuts = std::span(surface.cuts).subspan(surface.concave[s].first_cut, surface.concave[s].cut_count);
    for (const std::uint32_t cut : cuts)
      if (components.of_probe[cut] != components.of_probe[s]) return true;
  }
  return false;
}

std::vector<ReducedComponentSize> sizes_of(const Surface& surface, const ReducedComponents& components) {
  std::vector<ReducedComponentSize> sizes(components.count);
  std::vector<std::uint32_t> of_sheet(surface.components.size(), 0);
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const Face& face = surface.faces[f];
    ReducedComponentSize& size = sizes[components.of_face[f]];
    of_sheet[face.component] = components.of_face[f];
    if (face.kind == PatchKind::toroidal) size.toroidal += face.area;
    if (face.kind == PatchKind::concave) size.reentrant += face.area;
    if (face.kind != PatchKind::convex) continue;
    size.contact += face.area;
    size.accessible += accessible_area(surface, face);
  }
  for (std::size_t c = 0; c < of_sheet.size(); ++c) sizes[of_sheet[c]].volume += surface.components[c].volume;
  return sizes;
}

ComponentSurface compute_component_surface(ReducedSurfaceEngine& engine, std::span<const Ball> atoms,
                                           double probe_radius, StageClock& clock) {
  ComponentSurface result;
  result.surface = compute_through_ties(atoms, [&](std::span<const Ball> balls) {
    const ReducedSurface rs = engine.reduce(balls, probe_radius, clock);
    const auto assembled = [&](const ReducedComponents* cut_within) {
      return assemble_surface(balls, probe_radius, rs, &clock, &engine.cusp_tracer(), ClipPlanes::listed, cut_within);
    };
    Surface surface = assembled(nullptr);
    if (!surface.certificate.closed) return surface;
    const ReducedComponents components = reduced_components(surface);
    return cut_each_other(surface, components) ? assembled(&components) : surface;
  });
  if (result.surface.certificate.closed) result.components = reduced_components(result.surface);
  return result;
}

}  // namespace meniscus
