// SPDX-License-Identifier: BSD-3-Clause
// Cuts the objects of a scene by planes, and writes caps and shapes grouped by colour.
#include "exporters/povray/surface_pieces.h"

#include "core/base/text.h"
#include "core/mesh/mesh_objects.h"
#include "core/queries/copies.h"
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

/// Returns the caps that cut.planes make. Their tolerance is a tenth of a pixel, clamped to 0.002 to 0.02 Å. Throws
/// what section_caps() throws.
CapMesh make_caps(std::span<const SurfaceObject> objects, const SurfaceCut& cut, const Camera& camera, int width,
                  int height) {
  const MeshRequest request{kFinest, kPixelShare};
  const double tolerance = tolerance_of(request, {width, height}, camera, placed_balls(objects));
  return section_caps(objects, cut.planes, cut.style.color.has_value(), std::clamp(tolerance, kFinest, kCoarsest));
}

}  // namespace

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
