// SPDX-License-Identifier: BSD-3-Clause
// Resolves names of properties, and declares the sets that commands have in common.
#include "app/options/taken_properties.h"

#include <stdexcept>

#include <fmt/format.h>

#include "app/film/film_format.h"

namespace meniscus {
namespace {

bool is_film(const GivenScene& given) { return is_film_path(given.scene.output); }

/// Returns what figures take, as pictures or for other programs.
TakenProperties shown_properties() {
  return run_properties().with({"Surface", "-surface.patches", "-surface.min_patch", "Colour", "Figure",
                                "-surface.clip_all", "Beside the surface", "Camera", "image.size", "image.width",
                                "image.height", "image.dpi", "output.file", "scene.save"});
}

}  // namespace

TakenProperties TakenProperties::with(std::initializer_list<std::string_view> names) const {
  TakenProperties more = *this;
  more.name(names);
  return more;
}

TakenProperties TakenProperties::needing(std::initializer_list<Need> needs) const {
  TakenProperties more = *this;
  more.needs_.insert(more.needs_.end(), needs.begin(), needs.end());
  return more;
}

void TakenProperties::name(std::initializer_list<std::string_view> names) {
  for (std::string_view name : names) {
    const bool is_left_out = name.starts_with('-');
    name.remove_prefix(is_left_out ? 1 : 0);
    bool is_known = false;
    for (const Property* property : properties()) {
      if (property->heading != name && property->key != name) continue;
      is_known = true;
      if (is_left_out)
        taken_.erase(property);
      else
        taken_.insert(property);
    }
    if (!is_known) throw std::logic_error(fmt::format("{} is neither a heading nor a key of properties", name));
  }
}

const TakenProperties& run_properties() {
  static const TakenProperties taken =
      TakenProperties{"Input",         "Radii",     "Assembly",     "Frames",     "Alignment of frames", "surface.kind",
                      "surface.probe", "Computing", "output.force", "scene.read", "scene.trust",         "scene.set"}
          .needing({{{"frames.jobs", "frames.progress"},
                     [](const GivenScene& given) { return given.scene.frames.asked(); },
                     "there is no run of frames"}});
  return taken;
}

const TakenProperties& figure_properties() {
  static const TakenProperties taken =
      shown_properties().needing({{{"image.dpi"},
                                   [](const GivenScene& given) {
                                     return given.any({"image.width", "image.height"});
                                   },
                                   "the size is in pixels; add @width@ or @height@ with a length, such as 85mm"}});
  return taken;
}

const TakenProperties& render_properties() {
  static const TakenProperties taken =
      shown_properties()
          .with({"Surface", "Figure", "Film", "Light", "Lines", "-look.material", "Picture", "Legend", "Labels"})
          .needing({film_need(), {{"frames.fps"}, is_film, "the output is not a film"}});
  return taken;
}

Need film_need() {
  return {{"frames.codec", "frames.crf", "frames.bits", "frames.chroma"},
          is_film,
          "the output is not a film; name one, such as -o a.mp4",
          true};
}

Need superposition_need(bool (*is_met)(const GivenScene& given)) {
  return {
      {"frames.superpose", "frames.center", "frames.reference"},
      is_met,
      "areas and volumes stay the same however a frame is turned and moved; places and gradients, which are written "
      "to files, do not"};
}

}  // namespace meniscus
