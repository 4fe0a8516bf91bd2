// SPDX-License-Identifier: BSD-3-Clause
// Makes web pages of scenes and surfaces.
#include "exporters/bindings/c/c_renderer.h"

#include "exporters/bindings/c/c_scene.h"
#include "exporters/bindings/c/c_structure.h"
#include "exporters/bindings/c/c_surface.h"
#include "exporters/page/scene_page.h"

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
