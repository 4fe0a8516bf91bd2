// SPDX-License-Identifier: BSD-3-Clause
// Writes a scene for Mitsuba 3: camera, lights and materials, then the objects, those with copies as groups.
#include "exporters/path_tracers/path_tracer_scene.h"

#include <numbers>

#include <fmt/format.h>

#include "core/base/version.h"

namespace meniscus::path_tracers {
namespace {

/// Returns the element of a named value, which is how the format writes all values.
std::string named(std::string_view type, std::string_view name, std::string_view value) {
  return fmt::format("<{} name=\"{}\" value=\"{}\"/>", type, name, value);
}

std::string number(std::string_view name, double value) { return named("float", name, number_text(value)); }

std::string place(std::string_view type, std::string_view name, const glm::dvec3& p) {
  return fmt::format("<{} name=\"{}\" x=\"{}\" y=\"{}\" z=\"{}\"/>", type, name, number_text(p.x), number_text(p.y),
                     number_text(p.z));
}

std::string color_value(std::string_view name, const glm::vec3& color) {
  return named("rgb", name, vector_text(color, ", "));
}

/// Returns a texture with the colours of the vertices of the mesh to which it is applied.
std::string color_of_vertices(std::string_view name) {
  return fmt::format("<texture type=\"mesh_attribute\" name=\"{}\">{}</texture>", name,
                     named("string", "name", "vertex_color"));
}

std::string look_at(const glm::dvec3& origin, const glm::dvec3& forward, const glm::dvec3& up) {
  return fmt::format("<lookat origin=\"{}\" target=\"{}\" up=\"{}\"/>", vector_text(origin, ", "),
                     vector_text(origin + forward, ", "), vector_text(up, ", "));
}

class MitsubaWriter {
 public:
  MitsubaWriter(const PathTracerScene& scene, std::string name)
      : scene_(scene), name_(std::move(name)), extent_(extent_of(scene)), basis_(view_basis(scene.camera)) {}

  std::string write() {
    begin();
    camera();
    lights();
    if (scene_.material == Material::glass)
      line(fmt::format("<medium type=\"homogeneous\" id=\"inside\">{}{}</medium>",
                       color_value("sigma_t", kGlassAbsorption), color_value("albedo", glm::vec3(0.0f))));
    for (std::size_t n = 0; n < scene_.items.size(); ++n) item(scene_.items[n], n);
    line("</scene>");
    return std::move(text_);
  }

 private:
  void line(std::string_view text) { (text_ += text) += '\n'; }

  void begin() {
    line("<?xml version=\"1.0\" encoding=\"utf-8\"?>");
    line("<!-- A molecular surface, written by Meniscus " MENISCUS_VERSION " for Mitsuba 3. One unit is 1 Angstrom.");
    line(fmt::format("     Coordinates of the molecule are those here plus ({}).", vector_text(scene_.origin, ", ")));
    line(fmt::format("     Render with: mitsuba {0}.xml      or of other quality: mitsuba -Dspp=256 {0}.xml -->",
                     name_));
    line("<scene version=\"3.0.0\">");
    line("<default name=\"spp\" value=\"64\"/>");
    line(fmt::format("<default name=\"width\" value=\"{}\"/>", scene_.width));
    line(fmt::format("<default name=\"height\" value=\"{}\"/>", scene_.height));
    const bool glass = scene_.material == Material::glass;
    // Mitsuba 3.9.1 crashes where "path" hides emitters and things are placed as instances; "volpath" does not.
    const bool placed = !std::ranges::all_of(scene_.items, &SceneItem::is_placed_once);
    line(fmt::format("<integrator type=\"{}\">{}{}</integrator>", glass || placed ? "volpath" : "path",
                     named("integer", "max_depth", glass ? "32" : "8"), named("boolean", "hide_emitters", "true")));
  }

  void camera() {
    const Camera& camera = scene_.camera;
    const bool perspective = camera.projection == Projection::perspective;
    const glm::dvec3 eye = camera.position - scene_.origin;
    line(fmt::format("<sensor type=\"{}\">", perspective ? "perspective" : "orthographic"));
    std::string size;
    if (perspective) {
      line(named("string", "fov_axis", "y"));
      line(number("fov", camera.vertical_fov));
    } else {
      // The picture is two units wide without a scale.
      const double half = half_extent(camera, static_cast<double>(scene_.width) / scene_.height).x;
      size = fmt::format("<scale x=\"{0}\" y=\"{0}\"/>", number_text(half));
    }
    line(number("near_clip", kNearClip));
    line(number("far_clip", 2.0 * (glm::length(extent_.center - eye) + extent_.radius)));
    line(fmt::format("<transform name=\"to_world\">{}{}</transform>", size, look_at(eye, basis_.forward, basis_.up)));
    line(fmt::format("<film type=\"hdrfilm\">{}{}{}<rfilter type=\"gaussian\"/></film>",
                     named("integer", "width", "$width"), named("integer", "height", "$height"),
                     named("string", "pixel_format", "rgba")));
    line(fmt::format("<sampler type=\"independent\">{}</sampler>", named("integer", "sample_count", "$spp")));
    line("</sensor>");
  }

  void lights() {
    const Lights all = lights_of(scene_);
    line(fmt::format("<emitter type=\"constant\">{}</emitter>", color_value("radiance", all.environment)));
    for (const DistantLight& light : all.distant)
      line(fmt::format("<emitter type=\"directional\">{}{}</emitter>", place("vector", "direction", light.direction),
                       color_value("irradiance", std::numbers::pi_v<float> * light.strength)));
    for (const Softbox& box : all.softboxes) {
      line("<shape type=\"disk\">");
      line(fmt::format("<transform name=\"to_world\"><scale value=\"{}\"/>{}</transform>", number_text(box.radius),
                       look_at(box.center, box.direction, basis_.right)));
      line(fmt::format("<emitter type=\"area\">{}</emitter>", color_value("radiance", box.radiance)));
      line("</shape>");
    }
  }

  /// Returns the BSDF of a surface or a shape. color(parameter) returns the element of a colour parameter.
  template <class Color>
  std::string material(bool is_surface, float opacity, const Color& color) const {
    const Material kind = is_surface ? scene_.material : Material::matte;
    std::string made;
    switch (kind) {
      case Material::matte:
        made = fmt::format("<bsdf type=\"diffuse\">{}</bsdf>", color("reflectance"));
        break;
      case Material::plastic:  // "principled", because "roughplastic" cannot have colours of vertices
        made = fmt::format("<bsdf type=\"principled\">{}{}{}</bsdf>", color("base_color"),
                           number("roughness", kCoatRoughness), number("eta", kCoatIor));
        break;
      case Material::glass:
        made = fmt::format("<bsdf type=\"dielectric\">{}{}{}</bsdf>", number("int_ior", kGlassIor),
                           number("ext_ior", 1.0), color("specular_transmittance"));
        break;
      case Material::wax:
        made = fmt::format("<bsdf type=\"principled\">{}{}{}{}</bsdf>", color("base_color"),
                           number("roughness", kWaxRoughness), number("flatness", 1.0), number("specular", 0.4));
        break;
    }
    if (kind != Material::glass) made = fmt::format("<bsdf type=\"twosided\">{}</bsdf>", made);
    if (opacity >= 1.0f) return made;
    return fmt::format("<bsdf type=\"mask\"><float name=\"opacity\" value=\"{}\"/>{}</bsdf>", number_text(opacity),
                       made);
  }

  /// Returns references to a material and to the medium inside it. Each material is written once, before its first use.
  /// written: the keys of the written materials.
  template <class Key, class Color>
  std::string look(std::vector<Key>& written, const Key& key, std::string_view id_begin, bool is_surface, float opacity,
                   const Color& color) {
    const auto found = std::ranges::find(written, key);
    const std::string id = fmt::format("{}_{}", id_begin, found - written.begin() + 1);
    if (found == written.end()) {
      written.push_back(key);
      std::string made = material(is_surface, opacity, color);
      line(made.insert(made.find('>'), fmt::format(" id=\"{}\"", id)));
    }
    const bool glass = is_surface && scene_.material == Material::glass;
    return fmt::format("<ref id=\"{}\"/>{}", id, glass ? "<ref name=\"interior\" id=\"inside\"/>" : "");
  }

  std::string look(bool is_surface, const Paint& paint) {
    return look(paints_[is_surface], paint, is_surface ? "surface_color" : "shape_color", is_surface, paint.opacity,
                [&](std::string_view parameter) {
                  return color_value(parameter, written_color(scene_.material, is_surface, paint.color));
                });
  }

  std::string look_of_vertices(bool is_surface, float opacity) {
    return look(opacities_[is_surface], opacity, is_surface ? "surface" : "shape", is_surface, opacity,
                color_of_vertices);
  }

  void item(const SceneItem& item, std::size_t n) {
    const bool grouped = !item.is_placed_once();
    // Materials must be written before the group that uses them.
    std::vector<std::string> shapes;
    for (const SceneMesh& mesh : item.meshes)
      shapes.push_back(fmt::format("<shape type=\"ply\">{}{}</shape>",
                                   named("string", "filename", fmt::format("{}_{}.ply", name_, ++meshes_)),
                                   look_of_vertices(item.is_surface, mesh.opacity)));
    for (const SceneSphere& sphere : item.spheres)
      shapes.push_back(fmt::format("<shape type=\"sphere\">{}{}{}</shape>", place("point", "center", sphere.center),
                                   number("radius", sphere.radius), look(item.is_surface, sphere.paint)));
    for (const SceneCylinder& cylinder : item.cylinders)
      shapes.push_back(fmt::format("<shape type=\"cylinder\">{}{}{}{}</shape>", place("point", "p0", cylinder.from),
                                   place("point", "p1", cylinder.to), number("radius", cylinder.radius),
                                   look(item.is_surface, cylinder.paint)));
    if (grouped) line(fmt::format("<shape type=\"shapegroup\" id=\"object_{}\">", n + 1));
    for (const std::string& shape : shapes) line(shape);
    if (!grouped) return;
    line("</shape>");
    for (const RigidMotion& copy : item.copies)
      line(
          fmt::format("<shape type=\"instance\"><ref id=\"object_{}\"/><transform name=\"to_world\"><matrix "
                      "value=\"{}\"/></transform></shape>",
                      n + 1, matrix_text(copy)));
  }

  /// Returns the matrix of a motion in row-major order.
  static std::string matrix_text(const RigidMotion& motion) {
    std::string text;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) text += number_text(motion.rotation[column][row]) + " ";
      text += number_text(motion.translation[row]) + " ";
    }
    return text + "0 0 0 1";
  }

  static constexpr double kNearClip = 0.01;  // Å; must not be 0

  const PathTracerScene& scene_;
  std::string name_;
  Extent extent_;
  ViewBasis basis_;
  std::string text_;
  std::size_t meshes_ = 0;
  std::array<std::vector<Paint>, 2> paints_;     ///< written materials of one colour, of shapes and of surfaces
  std::array<std::vector<float>, 2> opacities_;  ///< written materials with colours of vertices, by their opacity
};

}  // namespace

std::string mitsuba_text(const PathTracerScene& scene, const std::string& name) {
  return MitsubaWriter(scene, name).write();
}

}  // namespace meniscus::path_tracers
