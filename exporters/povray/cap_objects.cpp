// SPDX-License-Identifier: BSD-3-Clause
// Cuts the objects of a scene by planes, and writes their caps as flat meshes.
#include "exporters/povray/scene_shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/text.h"
#include "core/mesh/mesh_objects.h"
#include "core/queries/copies.h"
#include "exporters/povray/scene_templates.h"
#include "exporters/povray/scene_text.h"

namespace meniscus::povray {
namespace {

constexpr double kPixelShare = 0.1, kFinest = 0.002, kCoarsest = 0.02;  // Å
constexpr std::size_t kCapFlushBytes = std::size_t{1} << 20;
constexpr double kStripeOffset = 1e4;  // a whole number of stripes that keeps the argument of mod() positive

/// Appends the "texture{...}" of a hatched cap. distance: from one stripe to the next, Å.
void append_hatching(SceneText& out, std::uint32_t color, const ClipPlane& plane, double distance,
                     const glm::dvec3& origin) {
  const glm::dvec3 along = glm::normalize(hatching_direction(plane.normal)) / distance;
  const double phase = glm::dot(origin, along);
  out.literal("#if (Meniscus_Buffer = 0) texture{pigment{function{mod(");
  for (int axis = 0; axis < 3; ++axis) out.full(along[axis]).literal(axis == 0 ? "*x+" : axis == 1 ? "*y+" : "*z+");
  out.full(phase - std::floor(phase) + kStripeOffset).literal(",1)} pigment_map{");
  const auto entry = [&](double place, const char* pigment) {
    out.literal("[").ratio(place).literal(" ").literal(pigment).literal("[").count(color).literal("]]");
  };
  for (const double place : {0.0, kHatchedShare}) entry(place, "Meniscus_Cap_Dark");
  for (const double place : {kHatchedShare, 1.0}) entry(place, "Meniscus_Cap_Pigment");
  out.literal("}} finish{Meniscus_Cap_Finish[").count(color).literal("]}} #else texture{Meniscus_Cap_Texture[");
  out.count(color).literal("]} #end");
}

}  // namespace

CapMesh make_caps(std::span<const SurfaceObject> objects, const SurfaceCut& cut, const Camera& camera, int width,
                  int height) {
  const MeshRequest request{kFinest, kPixelShare};
  const double tolerance = tolerance_of(request, {width, height}, camera, placed_balls(objects));
  return section_caps(objects, cut.planes, cut.style.color.has_value(), std::clamp(tolerance, kFinest, kCoarsest));
}

Caps colored_caps(CapMesh mesh, std::span<const SurfaceObject> objects, const CapStyle& style,
                  const ObjectStyle& object_style, ColorTable& table) {
  std::vector<SceneColor> atoms;
  const ObjectStyle cap_style{false, object_style.finish};
  for (const SurfaceObject& object : objects)
    for (std::size_t copy = 0; copy < object.copies.size(); ++copy)
      for (std::uint32_t a = 0; a < object.surface.atoms.size(); ++a)
        atoms.push_back(scene_color(object.coloring, a, cap_style, style.color));
  Caps caps;
  for (const std::uint32_t atom : mesh.atom) caps.color.push_back(table.number(atoms[atom]));
  caps.mesh = std::move(mesh);
  return caps;
}

void write_caps(OutputFile& file, const Caps& caps, const SurfaceCut& cut, const glm::dvec3& origin) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> groups;
  for (std::size_t n = 0; n < caps.mesh.triangles.size(); ++n) groups[{caps.mesh.plane[n], caps.color[n]}].push_back(n);
  SceneText out;
  const auto flush = [&](std::size_t limit) {
    if (out.text().size() < limit) return;
    file.write(out.text());
    out.clear();
  };
  out.literal("// Where planes cut the solid; coordinates are those of the surface's geometry.\n");
  SceneText dark;
  dark.ratio(kHatchedLight);
  out.literal(filled(template_text(povray_templates(), "caps.inc"), {{"DARK", dark.text()}}));
  std::vector<std::size_t> place(caps.mesh.positions.size());
  for (const auto& [key, triangles] : groups) {
    std::vector<std::uint32_t> used;
    for (const std::size_t n : triangles)
      used.insert(used.end(), caps.mesh.triangles[n].begin(), caps.mesh.triangles[n].end());
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (std::size_t n = 0; n < used.size(); ++n) place[used[n]] = n;
    out.literal("mesh2{\nvertex_vectors{").count(used.size());
    for (const std::uint32_t v : used) {
      out.literal(",\n").point(caps.mesh.positions[v] - origin);
      flush(kCapFlushBytes);
    }
    out.literal("}\nface_indices{").count(triangles.size());
    for (const std::size_t n : triangles) {
      const auto& t = caps.mesh.triangles[n];
      out.literal(",\n<")
          .count(place[t[0]])
          .literal(",")
          .count(place[t[1]])
          .literal(",")
          .count(place[t[2]])
          .literal(">");
      flush(kCapFlushBytes);
    }
    out.literal("}\n");
    const auto& [plane, color] = key;
    if (cut.style.hatching > 0.0)
      append_hatching(out, color, cut.planes[plane], cut.style.hatching, origin);
    else
      out.literal("texture{Meniscus_Cap_Texture[").count(color).literal("]}");
    out.literal("\n}\n");
  }
  flush(0);
}

CutObjects::CutObjects(std::span<const SurfaceObject> objects, const SurfaceCut& cut, const Camera& camera,
                       const SceneOptions& options)
    : cuts_(!cut.planes.empty() && !objects.empty()), objects_(objects) {
  if (!cuts_ && !copies_differ(objects)) return;
  if (cuts_) caps_ = make_caps(objects, cut, camera, options.width, options.height);
  whole_ = merged({objects.begin(), objects.end()});
  objects_ = {&whole_, 1};
}

}  // namespace meniscus::povray
