// SPDX-License-Identifier: BSD-3-Clause
// Writes one union per colour, so that each texture is written once.
#include "exporters/povray/shape_objects.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/base/text.h"
#include "exporters/povray/scene_templates.h"
#include "exporters/povray/scene_text.h"

namespace meniscus::povray {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 20;
constexpr std::string_view kCastsShadow = " #if (Meniscus_Casts = 0) no_shadow #end";

/// The spheres and the parts of cylinders that have one colour.
struct ColorGroup {
  std::vector<const SphereShape*> spheres;
  struct Half {
    const CylinderShape* cylinder;
    glm::dvec3 from, to;
  };
  std::vector<Half> cylinders;
};

/// Writes shapes piecewise into a file, relative to the scene's origin.
class ShapeWriter {
 public:
  ShapeWriter(OutputFile& file, const glm::dvec3& origin) : file_(file), origin_(origin) {}

  void write(std::uint32_t color, const ColorGroup& group) {
    out_.literal(group.spheres.size() + group.cylinders.size() > 1 ? "union{\n" : "object{\n");
    for (const SphereShape* sphere : group.spheres) {
      out_.literal("sphere{").point(sphere->center - origin_).literal(",").length(sphere->radius).literal("}\n");
      flush(kPieceBytes);
    }
    for (const auto& [cylinder, from, to] : group.cylinders) {
      out_.literal("cylinder{").point(from - origin_).literal(",").point(to - origin_).literal(",");
      out_.length(cylinder->radius).literal(" open}\n");
      flush(kPieceBytes);
    }
    texture(color).literal(kCastsShadow).literal("\n}\n");
  }

  /// Writes a mesh. color: an index into the colours per vertex.
  void write(const MeshShape& mesh, const std::vector<std::uint32_t>& color) {
    std::map<std::uint32_t, std::size_t> place;
    for (const std::uint32_t c : color) place.try_emplace(c, place.size());
    std::vector<std::uint32_t> used(place.size());
    for (const auto& [c, n] : place) used[n] = c;
    out_.literal("mesh2{\n");
    list("vertex_vectors", mesh.positions, [&](const glm::dvec3& p) { out_.point(p - origin_); });
    list("normal_vectors", mesh.normals, [&](const glm::vec3& n) { out_.direction(glm::dvec3(n)); });
    list("texture_list", used, [&](std::uint32_t c) { texture(c); });
    list("face_indices", mesh.triangles, [&](const std::array<std::uint32_t, 3>& t) {
      out_.literal("<").count(t[0]).literal(",").count(t[1]).literal(",").count(t[2]).literal(">");
      for (const std::uint32_t v : t) out_.literal(",").count(place.at(color[v]));
    });
    out_.literal(kCastsShadow).literal("\n}\n");
  }

  void flush(std::size_t limit) {
    if (out_.text().size() < limit) return;
    file_.write(out_.text());
    out_.clear();
  }

 private:
  SceneText& texture(std::uint32_t color) {
    return out_.literal("texture{Meniscus_Shape_Texture[").count(color).literal("]}");
  }

  void list(std::string_view name, const auto& entries, const auto& append) {
    out_.literal(name).literal("{").count(entries.size());
    for (const auto& entry : entries) {
      out_.literal(",\n");
      append(entry);
      flush(kPieceBytes);
    }
    out_.literal("}\n");
  }

  OutputFile& file_;
  glm::dvec3 origin_;
  SceneText out_;
};

}  // namespace

void add_colors(const ColoredShapes& shapes, ColorTable& table, const ObjectStyle& style) {
  const auto add = [&](std::uint32_t atom) {
    if (shapes.coloring.shows(atom)) table.number(scene_color(shapes.coloring, atom, style));
  };
  for (const SphereShape& sphere : shapes.shapes.spheres) add(sphere.atom);
  for (const CylinderShape& cylinder : shapes.shapes.cylinders) {
    add(cylinder.from_atom);
    add(cylinder.to_atom);
  }
  for (const std::uint32_t atom : shapes.shapes.mesh.atoms) add(atom);
}

void write_shapes(OutputFile& file, const ColoredShapes& shapes, const glm::dvec3& origin, ColorTable& table,
                  const ObjectStyle& style) {
  const Coloring& coloring = shapes.coloring;
  const auto number = [&](std::uint32_t atom) { return table.number(scene_color(coloring, atom, style)); };
  std::map<std::uint32_t, ColorGroup> groups;
  for (const SphereShape& sphere : shapes.shapes.spheres)
    if (coloring.shows(sphere.atom)) groups[number(sphere.atom)].spheres.push_back(&sphere);
  for (const CylinderShape& cylinder : shapes.shapes.cylinders) {
    const bool from = coloring.shows(cylinder.from_atom), to = coloring.shows(cylinder.to_atom);
    const std::uint32_t first = from ? number(cylinder.from_atom) : kNone, last = to ? number(cylinder.to_atom) : kNone;
    const glm::dvec3 middle = 0.5 * (cylinder.from + cylinder.to);
    if (from) groups[first].cylinders.push_back({&cylinder, cylinder.from, first == last ? cylinder.to : middle});
    if (to && first != last) groups[last].cylinders.push_back({&cylinder, middle, cylinder.to});
  }
  file.write("// Sticks, balls and spheres beside the surface; coordinates are those of its geometry.\n");
  file.write(template_text(povray_templates(), "shapes.inc"));
  ShapeWriter writer(file, origin);
  for (const auto& [color, group] : groups) writer.write(color, group);
  if (!shapes.shapes.mesh.triangles.empty()) {
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t atom : shapes.shapes.mesh.atoms) {
      SceneColor color = scene_color(coloring, atom, style);
      if (!coloring.shows(atom)) color.opacity = 0.0f;
      numbers.push_back(table.number(color));
    }
    writer.write(shapes.shapes.mesh, numbers);
  }
  writer.flush(0);
}

}  // namespace meniscus::povray
