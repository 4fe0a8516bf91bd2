// SPDX-License-Identifier: BSD-3-Clause
// The commands that change what is shown: parts of the surface, what is drawn beside it, cuts.
#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/preview/commands.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/properties/properties.h"
#include "core/scene/cut.h"
#include "core/scene/molecule.h"
#include "core/scene/scene_json.h"
#include "core/scene/scene_values.h"
#include "core/scene/surface_computer.h"

namespace meniscus {
namespace {

/// What is beside the surface has changed; the camera stays.
Outcome with_shapes(PreviewState& state, nlohmann::json reply = nlohmann::json::object()) {
  return {std::move(state), Renewal::shapes, std::move(reply)};
}

/// Throws RequestError where no more may be drawn beside the surface.
void require_room_for_set(const CommandReader& command, const FigureRequest& figure) {
  if (figure.representations.requests.size() + figure.objects.size() >= kMostShown)
    throw RequestError(
        fmt::format("{}: at most {} sets of atoms are drawn beside a surface; remove one", command.word(), kMostShown));
}

/// The place in a list that "index" names.
template <typename Entries>
std::size_t index_in(const Entries& entries, const CommandReader& command) {
  return static_cast<std::size_t>(command.integer("index", 0, static_cast<int>(entries.size()) - 1));
}

/// Removes the entry that "index" names from what "of" names, or all of them.
template <typename Entries>
void remove_from(Entries& entries, const CommandReader& command) {
  if (entries.empty()) throw RequestError(fmt::format("remove: there are no {}", command.text("of")));
  if (!command.has("index")) return entries.clear();
  entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(index_in(entries, command)));
}

/// Whether both are made of the same atoms in the same way, so that only looks differ.
bool same_shape(const FigureObjectRequest& a, const FigureObjectRequest& b) {
  return a.shapes == b.shapes && a.text() == b.text() && a.radius == b.radius && a.kind == b.kind &&
         a.probe_radius == b.probe_radius;
}

Outcome with_part(const CommandReader& command, PreviewState& state, const Surroundings& around) {
  const std::size_t atoms = command.naming([&] { return around.molecule.count_shown(state); });
  return {std::move(state), Renewal::colors, {{"atoms", atoms}}};
}

}  // namespace

Outcome hide(const CommandReader& command, PreviewState state, const Surroundings& around) {
  const std::string hidden = "not (" + command.selection().text() + ")";
  state.molecule.show = command.naming([&] {
    return parse_selection(state.molecule.show ? fmt::format("({}) and {}", state.molecule.show->text(), hidden)
                                               : hidden);
  });
  return with_part(command, state, around);
}

Outcome represent(const CommandReader& command, PreviewState state, const Surroundings&) {
  using Kind = RepresentationRequest::Kind;
  constexpr std::array<Kind, 6> kKinds{Kind::sticks, Kind::balls_and_sticks, Kind::spheres, Kind::backbone,
                                       Kind::bases,  Kind::sugar_symbols};
  const Kind kind = kKinds[command.choice("as", {"sticks", "balls", "spheres", "tube", "bases", "glycans"})];
  require_room_for_set(command, state.figure);
  std::vector<RepresentationRequest>& requests = state.figure.representations.requests;
  requests.push_back({kind, command.selection()});
  const std::size_t index = requests.size() - 1;
  return with_shapes(state, {{"index", index}});
}

Outcome put_object(const CommandReader& command, PreviewState state, const Surroundings&) {
  std::vector<FigureObjectRequest>& objects = state.figure.objects;
  FigureObjectRequest object = command.naming([&] { return parse_figure_object(command.value("object").dump()); });
  if (object.color) command.naming([&] { return require_previewed(*object.color); });
  if (command.has("index")) {
    const std::size_t index = index_in(objects, command);
    const bool same = same_shape(objects[index], object);
    objects[index] = std::move(object);
    if (!same) return with_shapes(state, {{"index", index}});
    return {std::move(state), Renewal::colors, {{"index", index}}};
  }
  require_room_for_set(command, state.figure);
  objects.push_back(std::move(object));
  const std::size_t index = objects.size() - 1;
  Outcome next = with_shapes(state, {{"index", index}});
  next.is_own_step = true;  // what its sliders do is another
  return next;
}

Outcome set_cut(const CommandReader& command, PreviewState state, const Surroundings& around) {
  constexpr std::size_t kMostCuts = 16;
  std::vector<Cut>& cuts = state.figure.cuts;
  const Cut cut = command.naming([&] { return parse_cut(command.text("plane")); });
  const bool is_new = !command.has("index");
  if (is_new && cuts.size() == kMostCuts)
    throw RequestError(fmt::format("cut: at most {} planes; remove one", kMostCuts));
  const std::size_t index = is_new ? cuts.size() : index_in(cuts, command);
  if (is_new) cuts.push_back(cut);
  cuts[index] = cut;
  nlohmann::json reply{{"index", index}};
  if (const auto idle = around.molecule.ineffective_among({&cut, 1}, state); !idle.empty())
    reply["note"] = idle.front();
  return {.state = std::move(state), .renewal = Renewal::cuts, .reply = std::move(reply), .is_own_step = is_new};
}

Outcome remove_entry(const CommandReader& command, PreviewState state, const Surroundings&) {
  switch (command.choice("of", {"representations", "cuts", "rules", "opacities", "objects"})) {
    case 0:
      remove_from(state.figure.representations.requests, command);
      return with_shapes(state);
    case 1:
      remove_from(state.figure.cuts, command);
      return {std::move(state), Renewal::cuts};
    case 2:
      remove_from(state.molecule.color.rules, command);
      return {std::move(state), Renewal::colors};
    case 3:
      remove_from(state.molecule.color.opacities, command);
      return {std::move(state), Renewal::colors};
    default:
      remove_from(state.figure.objects, command);
      return with_shapes(state);
  }
}

}  // namespace meniscus
