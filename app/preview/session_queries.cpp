// SPDX-License-Identifier: BSD-3-Clause
// The commands that ask: what is under the cursor, how fast it is, what the state is; and exports.
#include <algorithm>
#include <cmath>

#include "app/preview/command_reader.h"
#include "app/preview/look_json.h"
#include "app/preview/session.h"
#include "app/preview/view_export.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/scene/copied_atoms.h"
#include "core/structure/radii.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

constexpr int kLongestExportedSide = 16384;  // pixels

const char* kind_word(PatchKind kind) {
  constexpr const char* kWords[] = {"convex", "toroidal", "concave"};
  return kWords[static_cast<std::size_t>(kind)];
}

Json atom_json(const Atom& atom) {
  return {{"index", atom.index},
          {"name", escaped(atom.name)},
          {"element", atom.element ? element_symbol(atom.element) : ""},
          {"residue", escaped(atom.residue_name)},
          {"residue_number", atom.residue_number},
          {"insertion_code", atom.insertion_code == ' ' ? "" : std::string(1, atom.insertion_code)},
          {"chain", escaped(atom.chain)},
          {"model", atom.model},
          {"place", escaped(atom_place(atom))}};
}

std::string scheme_word(const ColorScheme& color) {
  for (const ColorSchemeMetadata& scheme : color_schemes())
    if (scheme.by == color.by) return std::string(scheme.word);
  return hex_color(color.fixed);
}

}  // namespace

Json PreviewSession::pick(const CommandReader& command) {
  const glm::ivec2 pixel{command.integer("x", 0, view_.size.x - 1), command.integer("y", 0, view_.size.y - 1)};
  const bool wait = command.flag_or(true, "wait");
  if (drawn_.revision != revision_ || drawn_.quality == Quality::draft) render(Quality::plain);
  const std::optional<PickedPoint> point = renderer_->pick(pixel);
  if (!point) return {{"hit", false}};
  Json reply = atom_json(structure_.atoms[shown_atoms()[point->atom]]);
  reply["hit"] = true;
  reply["kind"] = kind_word(point->kind);
  reply["position"] = {point->position.x, point->position.y, point->position.z};
  if (!structure_.instances.empty()) reply["copy"] = point->copy + 1;
  const std::optional<double> area = exposed_area(point->atom, wait);
  reply["exposed_area"] = area ? Json(*area) : Json(nullptr);
  return reply;
}

std::optional<double> PreviewSession::exposed_area(std::uint32_t atom, bool wait) {
  if (structure_.instances.empty())
    return areas_.of({view_.frame, 0, view_.probe_radius, balls_, renderer_->surface()}, atom, wait);
  // Copies of a group are as if it were alone.
  std::size_t group = 0;
  while (!std::ranges::binary_search(structure_.instances[group].atoms, atom)) ++group;
  const std::vector<std::uint32_t>& atoms = structure_.instances[group].atoms;
  std::vector<Ball> balls;
  for (const std::uint32_t a : atoms) balls.push_back(balls_[a]);
  const auto place = static_cast<std::size_t>(std::ranges::lower_bound(atoms, atom) - atoms.begin());
  return areas_.of({view_.frame, group, view_.probe_radius, balls, nullptr}, place, wait);
}

Json PreviewSession::export_view(const CommandReader& command) {
  const std::size_t format = command.choice("format", {"png", "povray", "blender", "camera", "camera_path"});
  const ExportTarget target{export_path(export_folder_, command.text("path")),
                            command.flag_or(false, "force") ? Existing::replace : Existing::refuse};
  if (target.existing == Existing::refuse && std::filesystem::exists(target.path))
    throw RequestError(target.path.string() + " exists already; say that it may be replaced (force), or another name");
  ColorScheme color = view_.color;
  if (view_.patch_kinds) color.by = ColorScheme::By::kind;
  const Coloring coloring = frame_coloring();
  const ExportedView view{structure_,
                          shown_atoms(),
                          balls_,
                          coloring,
                          color,
                          view_.probe_radius,
                          view_.camera,
                          view_.look,
                          {command.integer_or(view_.size.x, "width", 16, kLongestExportedSide),
                           command.integer_or(view_.size.y, "height", 16, kLongestExportedSide)},
                          command.integer_or(view_.samples, "samples", 1, 1024)};
  Json reply{{"path", target.path.string()}};
  if (format == 0) export_picture(view, *renderer_, target);
  if (format == 1) reply["render_with"] = export_povray(view, target);
  if (format == 2) export_blender(view, target);
  if (format == 3) export_camera(view, target);
  if (format == 4) export_camera_path(camera_keys(), target);
  return reply;
}

Json PreviewSession::stats(const CommandReader&) {
  Json stages = Json::array();
  for (const StageTime& stage : stages_) stages.push_back({{"name", stage.name}, {"milliseconds", stage.milliseconds}});
  return {{"frame_milliseconds", frame_ms_},
          {"fps", frame_ms_ > 0.0 ? 1000.0 / frame_ms_ : 0.0},
          {"width", renderer_->size().x},
          {"height", renderer_->size().y},
          {"stages", stages}};
}

Json PreviewSession::choices(const CommandReader&) {
  Json schemes = Json::array(), maps = Json::array();
  for (const ColorSchemeMetadata& scheme : color_schemes()) {
    if (scheme.by == ColorScheme::By::component) continue;
    if (scheme.by == ColorScheme::By::file && view_.color.file.empty()) continue;
    ColorScheme color;
    color.by = scheme.by;
    schemes.push_back({{"word", scheme.word}, {"has_map", color.has_scale()}, {"description", scheme.description}});
  }
  for (const ColorMapMetadata& map : color_maps()) maps.push_back(map.name);
  return {{"schemes", schemes}, {"maps", maps}};
}

Json PreviewSession::state(const CommandReader&) {
  Json color{{"scheme", scheme_word(view_.color)}};
  if (view_.color.map) color["map"] = map_name(*view_.color.map);
  for (const ColorRule& rule : view_.color.rules)
    color["rules"].push_back(escaped(rule.atoms.text()) + "=" + scheme_word(rule.paint));
  std::size_t copies = 1;
  for (const Instances& group : structure_.instances) copies = std::max(copies, group.motions.size());
  return {{"file", escaped(structure_.file)},
          {"atoms", balls_.size()},
          {"copies", copies},
          {"placed_atoms", structure_.instances.empty() ? balls_.size() : placed_count(structure_.instances)},
          {"revision", revision_},
          {"frame", view_.frame},
          {"frame_number", number_of(view_.frame)},
          {"frames", frame_count()},
          {"keys", Json(camera_path_object(camera_keys()))["keys"]},
          {"follow_keys", view_.follows_keys},
          {"playing", view_.playing},
          {"fps", view_.frames_per_second},
          {"camera", Json(camera_object(view_.camera))},
          {"probe_radius", view_.probe_radius},
          {"color", color},
          {"patch_kinds", view_.patch_kinds},
          {"look", look_json(view_.look)},
          {"width", view_.size.x},
          {"height", view_.size.y},
          {"samples", view_.samples}};
}

}  // namespace meniscus
