// SPDX-License-Identifier: BSD-3-Clause
// The commands that move the camera and the time: named views, frames, keys of the camera, sizes of pictures.
#include <algorithm>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "app/preview/camera_motion.h"
#include "app/preview/command_json.h"
#include "app/preview/commands.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/camera/camera_json.h"
#include "core/scene/copied_atoms.h"

namespace meniscus {
namespace {

constexpr double kLongestDrag = 100.0;  // heights of the picture

glm::dvec2 drag_of(const CommandReader& command) {
  return {command.number("dx", -kLongestDrag, kLongestDrag), command.number("dy", -kLongestDrag, kLongestDrag)};
}

/// The same state, which is given away, with another camera.
Outcome seen_from(PreviewState& state, const Camera& camera, nlohmann::json reply = nlohmann::json::object()) {
  state.camera = camera;
  state.overview = false;
  return {std::move(state), Renewal::nothing, std::move(reply)};
}

/// Of the chosen atoms; none of groups that have none.
std::vector<Instances> copies_of(const std::vector<Instances>& copies, const std::vector<bool>& chosen) {
  std::vector<Instances> kept;
  for (Instances group : copies) {
    std::erase_if(group.atoms, [&](std::uint32_t atom) { return !chosen[atom]; });
    if (!group.atoms.empty()) kept.push_back(std::move(group));
  }
  return kept;
}

/// The view that "name" names.
std::map<std::string, Camera>::iterator named_view(const CommandReader& command, PreviewState& state) {
  const std::string name = command.text("name");
  const auto view = state.named_views.find(name);
  if (view == state.named_views.end())
    throw RequestError(fmt::format("{}: no view is called {}", command.word(), in_quotes(name)));
  return view;
}

constexpr int kLongestSide = 8192;  // pixels; a GL texture holds it on all hardware of GL 4.5

Outcome at_frame(PreviewState state, std::size_t frame, const Surroundings& around) {
  state.frame = frame;
  if (state.follows_keys && !state.keys.empty()) {
    const double number = static_cast<double>(around.molecule.number_of(frame));
    state.camera = CameraPath(camera_keys(around.molecule, state)).at(number);
    state.overview = false;
  }
  return {std::move(state), Renewal::frame};
}

Outcome played(const CommandReader& command, PreviewState state, bool plays) {
  const bool strip = command.flag_or(false, "strip");
  double& rate = strip ? state.strip_rate : state.frames_per_second;
  rate = command.number_or(rate, "fps", 0.1, 240.0);
  state.playing = plays;
  state.plays_strip = plays && strip;
  return {std::move(state), Renewal::nothing, {{"playing", plays}}};
}

}  // namespace

Outcome orbit(const CommandReader& command, PreviewState state, const Surroundings&) {
  return seen_from(state, orbited(state.camera, drag_of(command)));
}

Outcome pan(const CommandReader& command, PreviewState state, const Surroundings&) {
  return seen_from(state, panned(state.camera, drag_of(command)));
}

Outcome zoom(const CommandReader& command, PreviewState state, const Surroundings& around) {
  constexpr double kMost = 1e3;  // more does not come of one movement; wheels are added up while a picture is drawn
  const double factor = std::clamp(command.number("factor", 1.0 / kMostZoom, kMostZoom), 1.0 / kMost, kMost);
  if (command.has("x") != command.has("y")) throw RequestError("zoom: \"x\" and \"y\" are one place; give both");
  glm::dvec2 place(0.0);  // from the middle
  if (command.has("x")) {
    const glm::dvec2 size(around.molecule.picture_size(state));
    place = {command.number("x", 0.0, state.size.x), command.number("y", 0.0, state.size.y)};
    place = (place - 0.5 * size) / size.y;
  }
  const Camera camera = command.has("x") ? zoomed_at(state.camera, factor, place) : zoomed(state.camera, factor);
  return seen_from(state, camera);
}

Outcome roll(const CommandReader& command, PreviewState state, const Surroundings&) {
  return seen_from(state, rolled(state.camera, command.number("degrees", -360.0, 360.0) * (std::numbers::pi / 180.0)));
}

Outcome zoom_to(const CommandReader& command, PreviewState state, const Surroundings& around) {
  const ShownMolecule& molecule = around.molecule;
  const Selection selection = command.selection();
  const std::vector<Atom> atoms = molecule.atoms_in_view();
  const std::vector<bool> chosen = selection.evaluate(atoms);
  std::vector<Ball> shown;
  for (std::size_t n = 0; n < atoms.size(); ++n)
    if (chosen[n]) shown.push_back({atoms[n].position, atoms[n].radius});
  const std::size_t count = shown.size();
  const std::vector<Instances>& copies = molecule.structure().instances;
  if (!copies.empty()) shown = reaching_balls(molecule.balls(), copies_of(copies, chosen));
  if (shown.empty()) throw RequestError("zoom_to: no atom of this frame is " + in_quotes(selection.text()));
  const Camera camera = zoomed_to(state.camera, shown, balls_in_view(molecule), molecule.aspect(state));
  return seen_from(state, camera, {{"atoms", count}});
}

Outcome center(const CommandReader& command, PreviewState state, const Surroundings& around) {
  const auto point = around.pictures.pick(state, around.molecule, pixel_of(command, state));
  if (!point) throw RequestError("center: nothing is there");
  const Camera camera = centered(state.camera, point->position, balls_in_view(around.molecule));
  return seen_from(state, camera, {{"position", {point->position.x, point->position.y, point->position.z}}});
}

Outcome reset_view(const CommandReader&, PreviewState state, const Surroundings& around) {
  if (!around.first.overview) return seen_from(state, around.first.camera);
  state.overview = true;
  return {.state = std::move(state), .frames_all = true};
}

Outcome set_camera(const CommandReader& command, PreviewState state, const Surroundings&) {
  return seen_from(state, parse_camera(json_line(command.value("camera")), "camera"));
}

Outcome save_view(const CommandReader& command, PreviewState state, const Surroundings&) {
  constexpr std::size_t kMostViews = 100, kLongestName = 60;
  const std::string name = command.text("name");
  if (name.empty() || name.size() > kLongestName)
    throw RequestError(fmt::format("save_view: a name has 1 to {} letters", kLongestName));
  if (!state.named_views.contains(name) && state.named_views.size() == kMostViews)
    throw RequestError(fmt::format("save_view: at most {} views are kept; forget one", kMostViews));
  state.named_views[name] = state.camera;
  const std::size_t count = state.named_views.size();
  return {std::move(state), Renewal::nothing, {{"views", count}}};
}

Outcome recall_view(const CommandReader& command, PreviewState state, const Surroundings&) {
  return seen_from(state, named_view(command, state)->second);
}

Outcome forget_view(const CommandReader& command, PreviewState state, const Surroundings&) {
  state.named_views.erase(named_view(command, state));
  const std::size_t count = state.named_views.size();
  return {std::move(state), Renewal::nothing, {{"views", count}}};
}

Outcome show_frame(const CommandReader& command, PreviewState state, const Surroundings& around) {
  const int last = static_cast<int>(around.molecule.frame_count()) - 1;
  return at_frame(std::move(state), static_cast<std::size_t>(command.integer("index", 0, last)), around);
}

Outcome next_frame(const CommandReader&, PreviewState state, const Surroundings& around) {
  if (state.plays_strip) return next_of_strip(std::move(state), around);
  const std::size_t next = (state.frame + 1) % around.molecule.frame_count();
  Outcome outcome = at_frame(std::move(state), next, around);
  outcome.reply["frame"] = next;
  outcome.passes_over_damage = true;  // or playing would never come past it
  return outcome;
}

Outcome set_key(const CommandReader& command, PreviewState state, const Surroundings&) {
  if (!command.flag_or(true, "on")) {
    state.keys.erase(state.frame);
  } else {
    for (const auto& [frame, camera] : state.keys)
      if (frame != state.frame && camera.projection != state.camera.projection)
        throw RequestError("key: all keys of the camera must have one projection, that of the first");
    state.keys[state.frame] = state.camera;
  }
  const std::size_t count = state.keys.size();
  return {std::move(state), Renewal::nothing, {{"keys", count}}};
}

Outcome follow_keys(const CommandReader& command, PreviewState state, const Surroundings& around) {
  state.follows_keys = command.flag("on");
  const std::size_t frame = state.frame;
  Outcome outcome = at_frame(std::move(state), frame, around);
  outcome.reply["follow_keys"] = outcome.state.follows_keys;
  return outcome;
}

Outcome play(const CommandReader& command, PreviewState state, const Surroundings& around) {
  const bool strip = command.flag_or(false, "strip");
  const std::size_t pictures = strip ? state.strip.size() : around.molecule.frame_count();
  return played(command, std::move(state), pictures > 1);
}

Outcome pause(const CommandReader& command, PreviewState state, const Surroundings&) {
  return played(command, std::move(state), false);
}

Outcome resize(const CommandReader& command, PreviewState state, const Surroundings&) {
  state.size = {command.integer("width", 16, kLongestSide), command.integer("height", 16, kLongestSide)};
  return {.state = std::move(state), .renewal = Renewal::legend, .frames_all = true};
}

}  // namespace meniscus
