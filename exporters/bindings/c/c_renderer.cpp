// SPDX-License-Identifier: BSD-3-Clause
// Draws pictures of computed surfaces, on the CPU or on a GL thread, and makes web pages of scenes and surfaces. Builds
// without the libraries for pages refuse to make them.
#include "exporters/bindings/c/c_renderer.h"

#include "core/properties/properties.h"
#include "core/scene/scene_value.h"
#include "exporters/bindings/c/c_scene.h"
#include "exporters/bindings/c/c_surface.h"

#ifdef MENISCUS_WITH_PAGES
#include "exporters/bindings/c/c_structure.h"
#include "exporters/page/scene_page.h"
#endif

namespace meniscus::c_api {
namespace {

glm::dvec3 vector_of(const double (&from)[3]) { return {from[0], from[1], from[2]}; }

void copy(const glm::dvec3& from, double (&to)[3]) {
  for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis];
}

Projection projection_of(std::int32_t word) {
  if (word != MENISCUS_PERSPECTIVE && word != MENISCUS_ORTHOGRAPHIC)
    refuse(MENISCUS_USAGE, "projection is {}, neither MENISCUS_PERSPECTIVE nor MENISCUS_ORTHOGRAPHIC", word);
  return word == MENISCUS_PERSPECTIVE ? Projection::perspective : Projection::orthographic;
}

/// Returns the camera of a caller. Refuses an impossible camera.
Camera camera_from(const meniscus_camera* given) {
  const meniscus_camera from = read_struct(given, meniscus_camera{}, "meniscus_camera");
  require_zero(from.reserved, "meniscus_camera.reserved");
  Camera camera;
  camera.position = vector_of(from.position);
  camera.target = vector_of(from.target);
  camera.up = vector_of(from.up);
  camera.projection = projection_of(from.projection);
  if (camera.projection == Projection::perspective)
    camera.vertical_fov = from.vertical_fov;
  else
    camera.height = from.height;
  validate_camera(camera, "camera");
  return camera;
}

meniscus_camera struct_of(const Camera& camera) {
  meniscus_camera result{};
  copy(camera.position, result.position);
  copy(camera.target, result.target);
  copy(camera.up, result.up);
  result.vertical_fov = camera.vertical_fov;
  result.height = camera.height;
  result.projection = camera.projection == Projection::perspective ? MENISCUS_PERSPECTIVE : MENISCUS_ORTHOGRAPHIC;
  return result;
}

/// Refuses a scene with properties that a picture of a computed surface does not have.
void check_of_surface(const Scene& scene) {
  for (const Property* property : properties())
    if (is_scene_value(*property) && !is_of_surface(*property) && !value_texts(scene, *property).empty())
      refuse(MENISCUS_USAGE,
             "{}: a picture of a surface has the look and the size of a scene; meniscus_render_scene() draws the rest",
             value_name(*property));
  const ColorScheme& color = scene.molecule.color;
  if ((scene.molecule.color_named && color.by != ColorScheme::By::fixed) || !color.rules.empty())
    refuse(MENISCUS_USAGE, "color: a bare surface does not know its atoms' elements; give one colour, or atom_colors");
}

Coloring coloring_for(const Scene& scene, const float* of_atoms, std::size_t atoms) {
  const glm::vec3 color = scene.molecule.color_named ? scene.molecule.color.fixed : kPlainColor;
  return coloring_of({color.x, color.y, color.z}, of_atoms, atoms);
}

RenderSettings settings_of(const Scene& scene) {
  RenderSettings settings;
  settings.size = scene.picture.size();
  settings.samples = scene.image.samples;
  settings.adaptive = Unevenness::pays_off(scene.picture.size());
  settings.look = look_of(scene.look, scene.picture.size(), scene.image.background, Hues::free);
  return settings;
}

}  // namespace

SurfacePicture surface_picture(const meniscus_surface* surface, const meniscus_scene* scene,
                               const meniscus_camera* camera, const float* atom_colors) {
  require(surface, "surface");
  if (scene) require(scene, "scene");
  if (const Preset& preset = preset_of(scene ? scene->copy().look.preset : LookPreset{}); !preset.settings.empty())
    refuse(MENISCUS_USAGE, "preset: {} draws atoms of a molecule; meniscus_render_scene() does that", preset.word);
  const meniscus_scene defaults;
  SurfacePicture picture{completed(scene ? *scene : defaults), {}, {}};
  check_of_surface(picture.scene);
  const std::vector<Ball>& atoms = surface->finished->surface.atoms;
  picture.camera = camera ? camera_from(camera)
                          : frame_camera(atoms, picture.scene.picture.aspect(), picture.scene.picture.projection);
  picture.coloring = coloring_for(picture.scene, atom_colors, atoms.size());
  return picture;
}

}  // namespace meniscus::c_api

meniscus_status meniscus_surface_camera(const meniscus_surface* surface, double aspect, meniscus_projection projection,
                                        meniscus_camera* camera) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(surface, "surface");
    require(camera, "camera");
    constexpr double kWidest = meniscus::scene_values::kLargestSide;
    check_range("aspect", aspect, 1.0 / kWidest, kWidest);
    const meniscus::Camera found =
        meniscus::frame_camera(surface->finished->surface.atoms, aspect, projection_of(projection));
    write_struct(camera, struct_of(found), "meniscus_camera");
  });
}

meniscus_status meniscus_renderer_new(meniscus_device device, meniscus_renderer** renderer) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(renderer, "renderer");
    check_device(device);
    *renderer = new meniscus_renderer(device);
  });
}

meniscus_renderer* meniscus_renderer_retain(meniscus_renderer* renderer) { return meniscus::c_api::retain(renderer); }
void meniscus_renderer_release(meniscus_renderer* renderer) { meniscus::c_api::release(renderer); }

meniscus_status meniscus_render(meniscus_renderer* renderer, const meniscus_surface* surface,
                                const meniscus_scene* scene, const meniscus_camera* camera, const float* atom_colors,
                                std::uint8_t* rgba, std::size_t rgba_size) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(renderer, "renderer");
    const SurfacePicture picture = surface_picture(surface, scene, camera, atom_colors);
    require_room(picture.scene, rgba, rgba_size);
    const FinishedSurface& finished = *surface->finished;
    const meniscus::Surface& whole = finished.whole();
    meniscus::Framebuffer drawn;
    renderer->run([&](meniscus::StillRenderer& still_renderer, const meniscus::EglContext*) {
      run_on_threads(finished.threads, [&] {
        drawn = still_renderer.render(meniscus::whole_surface(whole, picture.coloring), picture.camera,
                                      settings_of(picture.scene));
      });
    });
    write_pixels(drawn, picture.scene, rgba);
  });
}

meniscus_page* meniscus_page_retain(meniscus_page* page) { return meniscus::c_api::retain(page); }
void meniscus_page_release(meniscus_page* page) { meniscus::c_api::release(page); }

meniscus_status meniscus_page_html(const meniscus_page* page, const char** html, std::size_t* size) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(page, "page");
    require(html, "html");
    if (size) require(size, "size");
    *html = page->html.c_str();
    if (size) *size = page->html.size();
  });
}

#ifdef MENISCUS_WITH_PAGES

meniscus_status meniscus_scene_page(const meniscus_scene* scene, meniscus_page** page) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(scene, "scene");
    require(page, "page");
    const meniscus::Scene complete = drawable(*scene);
    std::string html;
    run_on_threads(complete.molecule.surface.threads, [&] { html = meniscus::page::scene_page(complete); });
    *page = new meniscus_page(std::move(html));
  });
}

meniscus_status meniscus_surface_page(const meniscus_surface* surface, const meniscus_structure* structure,
                                      const meniscus_scene* scene, const meniscus_camera* camera,
                                      const float* atom_colors, meniscus_page** page) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(page, "page");
    const SurfacePicture picture = surface_picture(surface, scene, camera, atom_colors);
    const FinishedSurface& finished = *surface->finished;
    const meniscus::Structure* const names = structure ? &structure_of(structure) : nullptr;
    if (names && names->atoms.size() != finished.surface.atoms.size())
      refuse(MENISCUS_USAGE, "structure has {} atoms, and the surface is of {}", names->atoms.size(),
             finished.surface.atoms.size());
    std::string html;
    const meniscus::Surface& whole = finished.whole();
    run_on_threads(finished.threads, [&] {
      html = meniscus::page::surface_page(whole, picture.coloring, names, picture.scene, picture.camera,
                                          meniscus::page::png_still);
    });
    *page = new meniscus_page(std::move(html));
  });
}

#else

namespace {

meniscus_status refused() {
  using namespace meniscus::c_api;
  return guarded(
      [] { refuse(MENISCUS_USAGE, "this build makes no pages: it was made without scenes, zlib or libdeflate"); });
}

}  // namespace

meniscus_status meniscus_scene_page(const meniscus_scene*, meniscus_page**) { return refused(); }
meniscus_status meniscus_surface_page(const meniscus_surface*, const meniscus_structure*, const meniscus_scene*,
                                      const meniscus_camera*, const float*, meniscus_page**) {
  return refused();
}

#endif
