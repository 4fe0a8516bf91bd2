// SPDX-License-Identifier: BSD-3-Clause
// Writes a scene for pbrt-v4: the camera, then lights, materials and objects, those with copies as instances.
#include "exporters/path_tracers/path_tracer_scene.h"

#include <numbers>

#include <fmt/format.h>

#include "core/base/version.h"

namespace meniscus::path_tracers {
namespace {

/// Returns a parameter: its type and name in quotes, and its value in brackets. name: type and name.
std::string parameter(std::string_view name, std::string_view value) {
  return fmt::format(" \"{}\" [{}]", name, value);
}
std::string parameter(std::string_view name, double value) { return parameter(name, number_text(value)); }
std::string parameter(std::string_view name, const glm::vec3& value) { return parameter(name, vector_text(value)); }
std::string text_parameter(std::string_view name, std::string_view value) {
  return parameter(name, fmt::format("\"{}\"", value));
}

/// Returns a transformation in column-major order.
std::string transform_text(const glm::dmat3& axes, const glm::dvec3& origin) {
  return fmt::format("[{} 0 {} 0 {} 0 {} 1]", vector_text(axes[0]), vector_text(axes[1]), vector_text(axes[2]),
                     vector_text(origin));
}

/// Returns right-handed axes, the third of which is the unit vector `z`.
glm::dmat3 axes_along(const glm::dvec3& z) {
  const glm::dvec3 other = std::abs(z.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 x = glm::normalize(glm::cross(other, z));
  return {x, glm::cross(z, x), z};
}

class PbrtWriter {
 public:
  PbrtWriter(const PathTracerScene& scene, std::string name) : scene_(scene), name_(std::move(name)) {}

  std::string write() {
    begin();
    camera();
    line("WorldBegin");
    lights();
    if (scene_.material == Material::glass)
      line("MakeNamedMedium \"inside\"" + text_parameter("string type", "homogeneous") +
           parameter("rgb sigma_a", kGlassAbsorption) + parameter("rgb sigma_s", glm::vec3(0.0f)));
    for (std::size_t n = 0; n < scene_.items.size(); ++n) item(scene_.items[n], n);
    return std::move(text_);
  }

 private:
  void line(std::string_view text) { (text_ += text) += '\n'; }

  void begin() {
    line("# A molecular surface, written by Meniscus " MENISCUS_VERSION " for pbrt-v4. One unit is 1 Angstrom.");
    line(fmt::format("# Coordinates of the molecule are those here plus ({}).", vector_text(scene_.origin, ", ")));
    line(fmt::format("# Render with: pbrt {0}.pbrt      or of other quality: pbrt --spp 256 {0}.pbrt", name_));
  }

  void camera() {
    const Camera& camera = scene_.camera;
    const auto [right, up, forward] = view_basis(camera);
    const glm::dvec3 eye = camera.position - scene_.origin;
    const bool perspective = camera.projection == Projection::perspective;
    glm::dvec2 half = half_extent(camera, static_cast<double>(scene_.width) / scene_.height);
    if (perspective) half /= half.y;
    // The axes of pbrt are left-handed, the axes of the molecule right-handed.
    line("Scale -1 1 1");
    line(fmt::format("LookAt {}  {}  {}", vector_text(eye), vector_text(eye + forward), vector_text(up)));
    line(fmt::format(
        "Camera \"{}\"{}{}", perspective ? "perspective" : "orthographic",
        perspective ? parameter("float fov", camera.vertical_fov) : "",
        parameter("float screenwindow", fmt::format("{} {} {} {}", number_text(-half.x), number_text(half.x),
                                                    number_text(-half.y), number_text(half.y)))));
    line("Sampler \"zsobol\"" + parameter("integer pixelsamples", "64"));
    line("Integrator \"volpath\"" + parameter("integer maxdepth", scene_.material == Material::glass ? "32" : "8"));
    line("PixelFilter \"gaussian\"");
    line("Film \"rgb\"" + parameter("integer xresolution", std::to_string(scene_.width)) +
         parameter("integer yresolution", std::to_string(scene_.height)) +
         text_parameter("string filename", name_ + ".exr"));
  }

  void lights() {
    const Lights all = lights_of(scene_);
    line("LightSource \"infinite\"" + parameter("rgb L", all.environment));
    for (const DistantLight& light : all.distant)
      line("LightSource \"distant\"" + parameter("point3 from", "0 0 0") +
           parameter("point3 to", vector_text(light.direction)) +
           parameter("rgb L", std::numbers::pi_v<float> * light.strength));
    for (const Softbox& box : all.softboxes)
      attributes({"ConcatTransform " + transform_text(axes_along(box.direction), box.center),
                  "AreaLightSource \"diffuse\"" + parameter("rgb L", box.radiance),
                  "Shape \"disk\"" + parameter("float radius", box.radius)});
  }

  void attributes(const std::vector<std::string>& statements) {
    line("AttributeBegin");
    for (const std::string& statement : statements) line("  " + statement);
    line("AttributeEnd");
  }

  std::string material(bool is_surface, const glm::vec3& of) const {
    switch (is_surface ? scene_.material : Material::matte) {
      case Material::plastic:
        return text_parameter("string type", "coateddiffuse") + parameter("rgb reflectance", of) +
               parameter("float eta", kCoatIor) + parameter("float roughness", kCoatRoughness * kCoatRoughness) +
               parameter("bool remaproughness", "false");
      case Material::glass:
        return text_parameter("string type", "dielectric") + parameter("float eta", kGlassIor);
      case Material::wax:
        return text_parameter("string type", "subsurface") + parameter("rgb reflectance", of) +
               parameter("rgb mfp", kWaxMeanFreePath) + parameter("float eta", kWaxIor) +
               parameter("float roughness", kWaxRoughness) + parameter("bool remaproughness", "false");
      case Material::matte:
        break;
    }
    return text_parameter("string type", "diffuse") + parameter("rgb reflectance", of);
  }

  /// Returns a statement that selects the material of this colour. Each material is written once, before its first use.
  std::string look(bool is_surface, const glm::vec3& of) {
    const bool same = is_surface && scene_.material == Material::glass;  // dielectrics of pbrt have no colours
    const glm::vec3 key = same ? glm::vec3(1.0f) : of;
    std::vector<glm::vec3>& written = colors_[is_surface];
    const auto found = std::ranges::find(written, key);
    const std::string id =
        fmt::format("{}_{}", is_surface ? "surface_color" : "shape_color", found - written.begin() + 1);
    if (found == written.end()) {
      written.push_back(key);
      line(fmt::format("MakeNamedMaterial \"{}\"{}", id, material(is_surface, key)));
    }
    return fmt::format("NamedMaterial \"{}\"", id);
  }

  static std::string alpha(float opacity) {
    return opacity < 1.0f ? parameter("float alpha", number_text(opacity)) : std::string();
  }

  void item(const SceneItem& item, std::size_t n) {
    // Materials must be written before the object that uses them.
    std::vector<std::vector<std::string>> shapes;
    const auto shape = [&](const glm::vec3& of) -> std::vector<std::string>& {
      shapes.push_back({look(item.is_surface, of)});
      if (item.is_surface && scene_.material == Material::glass)
        shapes.back().push_back("MediumInterface \"inside\" \"\"");
      return shapes.back();
    };
    for (const SceneMesh& mesh : item.meshes)
      shape(mesh.colors.front())
          .push_back("Shape \"plymesh\"" +
                     text_parameter("string filename", fmt::format("{}_{}.ply", name_, ++meshes_)) +
                     alpha(mesh.opacity));
    for (const SceneSphere& sphere : item.spheres) {
      std::vector<std::string>& made = shape(sphere.paint.color);
      made.push_back("Translate " + vector_text(sphere.center));
      made.push_back("Shape \"sphere\"" + parameter("float radius", sphere.radius) + alpha(sphere.paint.opacity));
    }
    for (const SceneCylinder& cylinder : item.cylinders) {
      const glm::dvec3 along = cylinder.to - cylinder.from;
      std::vector<std::string>& made = shape(cylinder.paint.color);
      made.push_back("ConcatTransform " + transform_text(axes_along(glm::normalize(along)), cylinder.from));
      made.push_back("Shape \"cylinder\"" + parameter("float radius", cylinder.radius) + parameter("float zmin", 0.0) +
                     parameter("float zmax", glm::length(along)) + alpha(cylinder.paint.opacity));
    }
    const bool grouped = !item.is_placed_once();
    if (grouped) line(fmt::format("ObjectBegin \"object_{}\"", n + 1));
    for (const std::vector<std::string>& statements : shapes) attributes(statements);
    if (!grouped) return;
    line("ObjectEnd");
    for (const RigidMotion& copy : item.copies)
      attributes({"ConcatTransform " + transform_text(copy.rotation, copy.translation),
                  fmt::format("ObjectInstance \"object_{}\"", n + 1)});
  }

  const PathTracerScene& scene_;
  std::string name_;
  std::string text_;
  std::size_t meshes_ = 0;
  std::array<std::vector<glm::vec3>, 2> colors_;  ///< colours of the written materials, of shapes and of surfaces
};

}  // namespace

std::string pbrt_text(const PathTracerScene& scene, const std::string& name) { return PbrtWriter(scene, name).write(); }

}  // namespace meniscus::path_tracers
