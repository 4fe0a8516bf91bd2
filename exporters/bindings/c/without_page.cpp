// SPDX-License-Identifier: BSD-3-Clause
// Replaces c_page.cpp in builds without the libraries for pages, and refuses every call.
#include "exporters/bindings/c/c_calls.h"

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
