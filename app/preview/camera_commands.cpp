// SPDX-License-Identifier: BSD-3-Clause
// The commands that move the camera and the time: views, frames, keys of the camera, sizes of pictures.

#include "app/preview/command_json.h"
#include "app/preview/commands.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/camera/camera_json.h"
#include "core/queries/copies.h"

namespace meniscus {
namespace {

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
  constexpr double kLongest = 100.0;  // heights of the picture
  const glm::dvec2 drag(command.number("dx", -kLongest, kLongest), command.number("dy", -kLongest, kLongest));
  return seen_from(state, orbited(state.camera, drag));
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

Outcome reset_view(const CommandReader&, PreviewState state, const Surroundings& around) {
  if (!around.first.overview) return seen_from(state, around.first.camera);
  state.overview = true;
  return {.state = std::move(state), .frames_all = true};
}

Outcome set_camera(const CommandReader& command, PreviewState state, const Surroundings&) {
  return seen_from(state, parse_camera(json_line(command.value("camera")), "camera"));
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
        throw RequestError("key: all keys of the camera must have the projection of the first one");
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
