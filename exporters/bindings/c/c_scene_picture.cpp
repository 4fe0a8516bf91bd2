// SPDX-License-Identifier: BSD-3-Clause
// Scenes of molecules: reads and writes them as JSON, draws them as `meniscus render` does, and colours atoms by
// schemes. Builds without the libraries for scene files refuse every call.
#ifdef MENISCUS_WITH_SCENES

#include "core/scene/scene_picture.h"

#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/color/color_schemes.h"
#include "core/color/coloring.h"
#include "core/mesh/tessellate.h"
#include "core/scene/scene_json.h"
#include "exporters/bindings/c/c_renderer.h"
#include "exporters/bindings/c/c_scene.h"
#include "exporters/bindings/c/c_structure.h"

namespace meniscus::c_api {
namespace {

constexpr std::size_t kLargestScene = std::size_t{16} << 20;

bool names_file(const SceneSetting& setting, const std::string& text) {
  const ValueType type = setting.property->type;
  return type == ValueType::file || (type == ValueType::camera && !text.starts_with('{'));
}

/// Reads a scene from JSON. file: the path or name in messages. trust: the rules for paths in a file; none for a text
/// of the caller, whose paths may lead anywhere.
Scene scene_of(std::string_view json, const std::string& file, const std::optional<SceneTrust>& trust) {
  Scene scene;
  for (SceneSetting& setting : parse_scene(json, file)) {
    for (std::string& text : setting.texts)
      if (trust && names_file(setting, text)) text = trust->path(*setting.property, text, setting.place);
    set_at(scene, *setting.property, setting.texts, MENISCUS_INPUT, file + ": " + setting.place);
  }
  return scene;
}

}  // namespace

Scene drawable(const meniscus_scene& scene) {
  Scene drawn = completed(scene);
  std::string& file = drawn.molecule.file;
  if (file.empty()) refuse(MENISCUS_USAGE, "file: the scene has no molecule; set the path of its file");
  if (file == "-") file = "./-";
  drawn.molecule.surface.check = check_by_mesh;
  return drawn;
}

std::vector<glm::vec3> structure_colors(const Structure& structure, std::string_view scheme) {
  using By = ColorScheme::By;
  constexpr std::array kOfMore{By::kind,          By::component, By::buried,       By::rmsf,
                               By::accessibility, By::file,      By::conservation, By::lipophilicity};
  const std::optional<ColorScheme> by = parse_color_scheme(scheme);
  if (!by) refuse(MENISCUS_USAGE, "scheme: {} is not one of {}", in_quotes(scheme), color_scheme_words());
  if (std::ranges::find(kOfMore, by->by) != kOfMore.end())
    refuse(MENISCUS_USAGE, "scheme: {} needs more than the atoms of a file; a scene has it", in_quotes(scheme));
  return color_atoms(structure, *by).atom;
}

}  // namespace meniscus::c_api

meniscus_status meniscus_scene_read(const char* path, meniscus_scene** scene) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(path, "path");
    require(scene, "scene");
    const std::string file = std::string_view(path) == "-" ? "./-" : path;
    const std::string json = meniscus::read_text_file(file, kLargestScene).text;
    meniscus::SceneTrust trust{.file = file};
    trust.advice = "parse the text of the scene if it is yours";
    *scene = new meniscus_scene(scene_of(json, file, trust));
  });
}

meniscus_status meniscus_scene_parse(const char* json, meniscus_scene** scene) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(json, "json");
    require(scene, "scene");
    *scene = new meniscus_scene(scene_of(json, "json", {}));
  });
}

meniscus_status meniscus_scene_json(const meniscus_scene* scene, const char* folder, const char** json) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(scene, "scene");
    require(json, "json");
    const meniscus::Scene copy = scene->copy();
    if (const std::string fault = meniscus::scene_fault(copy); !fault.empty()) throw meniscus::RequestError(fault);
    *json = scene->keep(meniscus::scene_text(copy, folder && *folder ? folder : "."));
  });
}

meniscus_status meniscus_render_scene(meniscus_renderer* renderer, const meniscus_scene* scene, std::uint8_t* rgba,
                                      std::size_t rgba_size) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(renderer, "renderer");
    require(scene, "scene");
    const meniscus::Scene complete = drawable(*scene);
    require_room(complete, rgba, rgba_size);
    meniscus::Framebuffer drawn;
    renderer->run([&](meniscus::StillRenderer& draws, const meniscus::EglContext* context) {
      run_on_threads(complete.molecule.surface.threads, [&] {
        // Volume maps are sampled on the CPU only.
        meniscus::StillRenderer cpu_renderer;
        const bool on_cpu = context && meniscus::picture_request(complete).cpu;
        drawn = on_cpu ? scene_picture(complete, cpu_renderer, nullptr) : scene_picture(complete, draws, context);
      });
    });
    write_pixels(drawn, complete, rgba);
  });
}

#else

#include "exporters/bindings/c/c_calls.h"
#include "exporters/bindings/c/c_structure.h"

namespace {

meniscus_status refused(const char* what) {
  using namespace meniscus::c_api;
  return guarded([&] {
    refuse(MENISCUS_USAGE, "this build {} no scenes: it was made without gemmi, nlohmann_json or FreeType", what);
  });
}

}  // namespace

std::vector<glm::vec3> meniscus::c_api::structure_colors(const Structure&, std::string_view) {
  refuse(MENISCUS_USAGE, "this build has no colour schemes: it was made without nlohmann_json or FreeType");
}

meniscus_status meniscus_scene_read(const char*, meniscus_scene**) { return refused("reads"); }
meniscus_status meniscus_scene_parse(const char*, meniscus_scene**) { return refused("parses"); }
meniscus_status meniscus_scene_json(const meniscus_scene*, const char*, const char**) { return refused("writes"); }
meniscus_status meniscus_render_scene(meniscus_renderer*, const meniscus_scene*, std::uint8_t*, std::size_t) {
  return refused("draws");
}

#endif
