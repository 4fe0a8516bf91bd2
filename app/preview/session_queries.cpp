// SPDX-License-Identifier: BSD-3-Clause
// The commands that ask: what is under the cursor, how fast it is, what the state is.
#include <algorithm>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "app/options/object_option.h"
#include "core/camera/camera_json.h"
#include "app/preview/command_json.h"
#include "app/preview/command_reader.h"
#include "app/preview/key_table.h"
#include "app/preview/look_json.h"
#include "app/preview/session.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/scene/copied_atoms.h"
#include "core/color/color_scale.h"
#include "core/color/named_colors.h"
#include "core/properties/properties.h"
#include "core/structure/element_tables.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

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

/// Rules as --color has them: expressions of a user, not of a file.
Json rule_json(const ColorRule& rule) { return escaped(rule.atoms.text()) + "=" + scheme_word(rule.paint); }

const char* word_of(RepresentationRequest::Kind kind) { return option_word(kind) + 2; }  // without the dashes

const char* word_of(LegendStyle::Place place) {
  constexpr const char* kWords[] = {"auto", "right", "below"};
  return kWords[static_cast<std::size_t>(place)];
}

Json color_json(const ColorScheme& scheme) {
  Json color{{"scheme", scheme_word(scheme)}};
  if (scheme.map) color["map"] = map_name(*scheme.map);
  if (scheme.own_map) color["own_map"] = true;
  if (scheme.range) color["range"] = fmt::format("{}:{}", (*scheme.range)[0], (*scheme.range)[1]);
  if (scheme.missing) color["missing"] = hex_color(*scheme.missing);
  for (const ColorRule& rule : scheme.rules) color["rules"].push_back(rule_json(rule));
  return color;
}

}  // namespace

std::optional<PickedPoint> PreviewSession::point_at(const CommandReader& command) {
  const glm::ivec2 pixel{command.integer("x", 0, view_.size.x - 1), command.integer("y", 0, view_.size.y - 1)};
  if (drawn_.revision != revision_ || drawn_.quality == Quality::draft) render(Quality::plain);
  const glm::ivec2 shown = renderer_->size();
  return pixel.x < shown.x && pixel.y < shown.y ? renderer_->pick(pixel) : std::nullopt;
}

Json PreviewSession::pick(const CommandReader& command) {
  const bool wait = command.flag_or(true, "wait"), area_wanted = command.flag_or(true, "area");
  const std::optional<PickedPoint> point = point_at(command);
  if (!point) return {{"hit", false}};
  const bool of_molecule = point->object == 0 || !structure_.instances.empty();
  const bool of_surface = of_molecule || (point->object > 1 && beside_->objects.at(point->object - 2).surface);
  const std::size_t own = shown_atoms().size();
  Json reply = atom_json(point->atom < own ? structure_.atoms[shown_atoms()[point->atom]]
                                           : marked_->beside.at(point->atom - own));
  reply["hit"] = true;
  reply["kind"] = point->kind ? kind_word(*point->kind) : of_surface ? "cap" : "shape";
  reply["position"] = {point->position.x, point->position.y, point->position.z};
  if (!structure_.instances.empty()) reply["copy"] = point->copy + 1;
  reply["exposed_area"] = nullptr;
  reply["area_follows"] = false;
  // It has no part of the molecule's surface, or this is another one.
  if (point->atom >= own || (of_surface && !of_molecule)) return reply;
  if (const std::optional<double> area = exposed_area(point->atom, wait, area_wanted))
    reply["exposed_area"] = *area;
  else
    reply["area_follows"] = areas_.computing();
  return reply;
}

std::optional<double> PreviewSession::exposed_area(std::uint32_t atom, bool wait, bool area_wanted) {
  const auto area = [&](const AtomsInView& atoms, std::size_t place) {
    return area_wanted ? areas_.of(atoms, place, wait) : areas_.if_cheap(atoms, place);
  };
  if (structure_.instances.empty())
    return area({view_.frame, 0, view_.kind, view_.probe_radius, balls_, renderer_->surface()}, atom);
  // Copies of a group are as if it were alone.
  std::size_t group = 0;
  while (!std::ranges::binary_search(structure_.instances[group].atoms, atom)) ++group;
  const std::vector<std::uint32_t>& atoms = structure_.instances[group].atoms;
  std::vector<Ball> balls;
  balls.reserve(atoms.size());
  for (const std::uint32_t a : atoms) balls.push_back(balls_[a]);
  const auto place = static_cast<std::size_t>(std::ranges::lower_bound(atoms, atom) - atoms.begin());
  return area({view_.frame, group, view_.kind, view_.probe_radius, balls, nullptr}, place);
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
    if (!is_previewed(scheme.by) && scheme.by != first_color_.by) continue;
    if (scheme.by == ColorScheme::By::file && first_color_.file.empty()) continue;
    const auto is_copy = [](const Atom& atom) { return atom.copy > 0; };
    if (scheme.by == ColorScheme::By::copy && std::ranges::none_of(structure_.atoms, is_copy)) continue;
    ColorScheme color;
    color.by = scheme.by;
    schemes.push_back({{"word", scheme.word}, {"has_map", color.has_scale()}, {"description", scheme.description}});
  }
  for (const ColorMapMetadata& map : color_maps()) maps.push_back(map.name);
  Json keys = Json::array();
  for (const KeyHelp& row : key_help()) keys.push_back({{"keys", row.keys}, {"what", row.what}});
  Json actions = Json::object();
  for (const FaceKey& key : face_keys()) actions[std::string(key.key)] = face_action_word(key.action);
  return {{"schemes", schemes},
          {"maps", maps},
          {"keys", keys},
          {"actions", actions},
          {"presets", meniscus::words_of(property_of("look.preset"))},
          {"sliders", look_sliders()},
          {"representations", {"sticks", "balls", "spheres", "tube"}}};
}

void PreviewSession::tell_figure(Json& state) const {
  Json& representations = state["representations"] = Json::array();
  for (const RepresentationRequest& request : view_.figure.representations.requests)
    representations.push_back({{"as", word_of(request.kind)}, {"selection", escaped(request.atoms.text())}});
  Json& opacities = state["opacities"] = Json::array();
  for (const OpacityRule& rule : view_.color.opacities) {
    opacities.push_back({{"opacity", std::stod(fmt::format("{}", rule.opacity))}});
    if (rule.atoms) opacities.back()["selection"] = escaped(rule.atoms->text());
  }
  Json& cuts = state["cuts"] = Json::array();
  for (const Cut& cut : view_.figure.cuts) cuts.push_back(cut_text(cut));
  state["cap"] = {{"color", view_.figure.cap.color ? hex_color(*view_.figure.cap.color) : "atom"},
                  {"hatching", view_.figure.cap.hatching}};
  state["film_opacity"] = view_.figure.thickens;
  Json& objects = state["objects"] = Json::array();
  for (const FigureObjectRequest& object : view_.figure.objects)
    objects.push_back(Json::parse(json_line(figure_object_json(object))));
  state["surface_hidden"] = view_.figure.hides_surface;
  const ExportWishes& wishes = view_.wishes;
  state["export"] = {{"width", wishes.size ? Json(wishes.size->x) : Json(nullptr)},
                     {"height", wishes.size ? Json(wishes.size->y) : Json(nullptr)},
                     {"samples", wishes.samples ? Json(*wishes.samples) : Json(nullptr)},
                     {"transparent", wishes.transparent}};
  state["show"] = view_.show ? Json(escaped(view_.show->text())) : Json(nullptr);
  state["legend"] = {{"on", view_.legend},
                     {"title", view_.legend_style.title ? Json(escaped(*view_.legend_style.title)) : Json(nullptr)},
                     {"letters", view_.legend_style.letters ? Json(*view_.legend_style.letters) : Json(nullptr)},
                     {"place", word_of(view_.legend_style.place)}};
  if (!legend_fault_.empty()) state["legend"]["fault"] = legend_fault_;
  Json& views = state["views"] = Json::array();
  for (const auto& [name, camera] : named_views_) views.push_back(escaped(name));
  state["undo"] = history_.undo_steps();
  state["redo"] = history_.redo_steps();
}

Json PreviewSession::state(const CommandReader&) {
  std::size_t copies = 1;
  for (const Instances& group : structure_.instances) copies = std::max(copies, group.motions.size());
  glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
  for (const Ball& ball : balls_) {
    low = glm::min(low, ball.center - ball.radius);
    high = glm::max(high, ball.center + ball.radius);
  }
  Json state{{"file", escaped(structure_.file)},
             {"atoms", balls_.size()},
             {"copies", copies},
             {"placed_atoms", structure_.instances.empty() ? balls_.size() : placed_count(structure_.instances)},
             {"low", {low.x, low.y, low.z}},
             {"high", {high.x, high.y, high.z}},
             {"revision", revision_},
             {"frame", view_.frame},
             {"frame_number", number_of(view_.frame)},
             {"frames", frame_count()},
             {"keys", Json(camera_path_object(camera_keys()))["keys"]},
             {"follow_keys", view_.follows_keys},
             {"playing", view_.playing},
             {"fps", view_.frames_per_second},
             {"camera", Json(camera_object(view_.camera))},
             {"surface", kind_word(view_.kind)},
             {"probe_radius", view_.probe_radius},
             {"color", color_json(view_.color)},
             {"patch_kinds", view_.patch_kinds},
             {"preset", preset_word(view_.look.preset)},
             {"look", look_json(look())},
             {"width", view_.size.x},
             {"height", view_.size.y},
             {"samples", view_.samples},
             {"drawn_by", renderer_->draws_on_cpu() ? "cpu" : "gl"}};
  tell_figure(state);
  return state;
}

}  // namespace meniscus
