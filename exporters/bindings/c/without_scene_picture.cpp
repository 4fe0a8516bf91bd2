// SPDX-License-Identifier: BSD-3-Clause
// Replaces c_scene_picture.cpp in builds without the libraries for scene files, and refuses every call.
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
