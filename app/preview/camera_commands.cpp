// SPDX-License-Identifier: BSD-3-Clause
// Commands that change the camera, the frame, the camera's keys, the size of the picture and the strip of kept scenes.
// The distance of a camera does not drift, however often it is turned.
#include "app/preview/command_json.h"
#include "app/preview/commands.h"
#include "app/preview/preview_state.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/camera/camera_json.h"
#include "core/math/ball.h"
#include "core/queries/copies.h"
#include "core/scene/transition.h"

namespace meniscus {
namespace {

double distance_of(const Camera& camera) { return glm::length(camera.position - camera.target); }

/// Returns how many Å of height the target's plane shows per Å of the camera's distance.
double height_per_distance(const Camera& camera) {
  return 2.0 * std::tan(camera.vertical_fov * (std::numbers::pi / 360.0));
}

/// Returns v turned about the unit vector `axis` (Rodrigues 1840).
glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return v * c + glm::cross(axis, v) * s + axis * (glm::dot(axis, v) * (1.0 - c));
}

/// Returns an orthographic camera moved back, so that no ball comes before its plane however it turns about its target.
Camera outside(Camera camera, std::span<const Ball> balls) {
  if (camera.projection == Projection::perspective) return camera;
  double reach = 0.0;
  for (const Ball& ball : balls) reach = std::max(reach, glm::length(ball.center - camera.target) + ball.radius);
  const glm::dvec3 forward = view_basis(camera).forward;
  camera.position = camera.target - forward * std::max(2.0 * reach, 1e-2);
  return camera;
}

}  // namespace

double height_at_target(const Camera& camera) {
  return camera.projection == Projection::orthographic ? camera.height
                                                       : height_per_distance(camera) * distance_of(camera);
}

Camera orbited(const Camera& camera, glm::dvec2 drag) {
  const double length = std::hypot(drag.x, drag.y);
  const ViewBasis basis = view_basis(camera);
  if (length == 0.0) return camera;
  const glm::dvec3 axis = glm::normalize(basis.up * (-drag.x / length) + basis.right * (-drag.y / length));
  const double angle = length * std::numbers::pi;
  Camera moved = camera;
  moved.position = camera.target - glm::normalize(turned(basis.forward, axis, angle)) * distance_of(camera);
  moved.up = glm::normalize(turned(basis.up, axis, angle));
  return moved;
}

Camera projected(const Camera& camera, Projection projection, std::span<const Ball> balls) {
  if (projection == camera.projection) return camera;
  Camera other = camera;
  other.projection = projection;
  if (projection == Projection::orthographic) {
    other.height = height_at_target(camera);
    return outside(other, balls);
  }
  other.position = camera.target - view_basis(camera).forward * (camera.height / height_per_distance(camera));
  return other;
}

Camera zoomed_to(const Camera& camera, std::span<const Ball> shown, std::span<const Ball> balls, double aspect) {
  return outside(frame_camera(shown, view_basis(camera), aspect, camera), balls);
}

Camera overview(std::span<const Ball> balls, double aspect, Projection projection) {
  return outside(frame_camera(balls, aspect, projection), balls);
}

namespace {

/// Returns an outcome that takes the state and gives it another camera.
Outcome seen_from(PreviewState& state, const Camera& camera, nlohmann::json reply = nlohmann::json::object()) {
  state.camera = camera;
  state.overview = false;
  return {std::move(state), Renewal::nothing, std::move(reply)};
}

/// Returns the copies reduced to the chosen atoms, without the groups that have none of them.
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
  outcome.passes_over_damage = true;  // playing would otherwise stop at the damaged frame
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

namespace {

constexpr std::size_t kMostScenes = 50;
constexpr double kLongestScene = 3600.0;  // seconds of a scene, as `meniscus film` has it

/// Returns a figure whose numbers change steadily between two scenes; all else comes from the nearer scene.
PreviewFigure figure_between(const PreviewFigure& from, const PreviewFigure& to, double share,
                             const Surroundings& around) {
  const PreviewFigure &nearer = share < 0.5 ? from : to, &other = share < 0.5 ? to : from;
  const double way = std::min(share, 1.0 - share);
  const ShownMolecule& molecule = around.molecule;
  PreviewFigure figure = nearer;
  figure.overview = false;
  figure.camera = camera_between(nearer.camera, other.camera, way);
  if (nearer.molecule.surface.kind == other.molecule.surface.kind)
    figure.molecule.surface.probe_radius =
        radius_between(nearer.molecule.surface.probe_radius, other.molecule.surface.probe_radius, way);
  const auto shape_radius = [&](std::optional<double> ShapeRadii::*radius) {
    std::optional<double>& shown = figure.figure.representations.*radius;
    if (shown) shown = radius_between(*shown, (other.figure.representations.*radius).value_or(0.0), way);
  };
  shape_radius(&ShapeRadii::stick_radius);
  shape_radius(&ShapeRadii::tube_radius);

  std::vector<Ball> balls = molecule.framing_balls();
  for (Ball& ball : balls)
    ball.radius += std::max(from.molecule.surface.probe_radius, to.molecule.surface.probe_radius);
  figure.figure.cuts = cuts_at(planes_between(molecule.planes(from), molecule.planes(to), balls, share));
  if (nearer.figure.cuts.empty()) figure.figure.cap = other.figure.cap;

  const auto look = [&](const PreviewFigure& of) {
    return look_of(of.look, around.state.size, of.shown_background(), of.hues(), of.molecule.patches.has_value());
  };
  const Look between = look_between(look(nearer), look(other), way);
  figure.look = look_request(nearer.look, between, nearer.molecule.patches.has_value());
  figure.image.background = between.background;
  return figure;
}

/// Returns the state at a place of the strip, from 0 (the first scene) to the number of the last scene.
Outcome at_place(PreviewState state, double place, const Surroundings& around) {
  const std::vector<KeptScene>& strip = around.state.strip;
  const auto scene = static_cast<std::size_t>(place);
  const double share = eased(place - std::floor(place), Pace::smooth);
  static_cast<PreviewFigure&>(state) =
      share > 0.0 ? figure_between(strip[scene].figure, strip[scene + 1].figure, share, around) : strip[scene].figure;
  state.frame = strip[share < 0.5 ? scene : scene + 1].frame;
  state.strip_place = place;
  state.strip_shown = 1;
  require_copies_apart(around.molecule.structure(), state, around.state.probe_reach());
  const Renewal renewal = state.frame == around.state.frame ? Renewal::shapes : Renewal::frame;
  return {std::move(state), renewal};
}

/// Returns the scene that "index" names.
std::vector<KeptScene>::iterator scene_in(const CommandReader& command, PreviewState& state) {
  if (state.strip.empty()) throw RequestError("{}: no scene is kept", command.word());
  return state.strip.begin() + command.integer("index", 0, static_cast<int>(state.strip.size()) - 1);
}

Outcome with_strip(PreviewState& state) {
  const std::size_t count = state.strip.size();
  if (state.plays_strip) state.playing = state.plays_strip = false;
  state.strip_place = std::min(state.strip_place, count > 0 ? static_cast<double>(count - 1) : 0.0);
  return {std::move(state), Renewal::nothing, {{"scenes", count}}};
}

}  // namespace

Outcome keep_scene(const CommandReader& command, PreviewState state, const Surroundings&) {
  KeptScene kept{state, state.frame};
  kept.number = ++state.last_kept;
  const auto with_times_of = [&](const KeptScene& other) {
    kept.hold = other.hold;
    kept.transition = other.transition;
  };
  if (command.has("index")) {
    const auto replaced = scene_in(command, state);
    with_times_of(*replaced);
    *replaced = std::move(kept);
  } else {
    if (state.strip.size() == kMostScenes)
      throw RequestError("keep_scene: at most {} scenes are kept; forget one", kMostScenes);
    if (!state.strip.empty()) with_times_of(state.strip.back());
    state.strip.push_back(std::move(kept));
    state.strip_place = static_cast<double>(state.strip.size() - 1);
  }
  const std::uint64_t number = state.last_kept;
  Outcome next = with_strip(state);
  next.reply["number"] = number;
  return next;
}

Outcome forget_scene(const CommandReader& command, PreviewState state, const Surroundings&) {
  state.strip.erase(scene_in(command, state));
  return with_strip(state);
}

Outcome time_scene(const CommandReader& command, PreviewState state, const Surroundings&) {
  const auto scene = scene_in(command, state);
  scene->hold = command.number_or(scene->hold, "hold", 0.0, kLongestScene);
  scene->transition = command.number_or(scene->transition, "transition", 0.0, kLongestScene);
  return with_strip(state);
}

Outcome show_strip(const CommandReader& command, PreviewState state, const Surroundings& around) {
  if (state.strip.empty()) throw RequestError("strip: no scene is kept; keep_scene keeps one");
  const double place = command.number("place", 0.0, static_cast<double>(state.strip.size() - 1));
  return at_place(std::move(state), place, around);
}

Outcome next_of_strip(PreviewState state, const Surroundings& around) {
  const auto scene = static_cast<std::size_t>(state.strip_place);
  const KeptScene& kept = state.strip[scene];
  const double rate = state.strip_rate, way = state.strip_place - std::floor(state.strip_place);
  const bool is_last = scene + 1 == state.strip.size();
  Outcome next;
  if (way == 0.0 && state.strip_shown < kept.held(rate)) {
    next.state = std::move(state);
    ++next.state.strip_shown;
  } else if (is_last) {
    next.state = std::move(state);
  } else {
    const double steps = static_cast<double>(kept.between(rate)) + 1.0;
    constexpr double kRounding = 1e-6;  // tolerance of a share that is a whole number of steps
    const double share = (std::floor(way * steps + kRounding) + 1.0) / steps;
    next = at_place(std::move(state), static_cast<double>(scene) + std::min(share, 1.0), around);
  }
  PreviewState& shown = next.state;
  const double place = shown.strip_place;
  if (place + 1.0 == static_cast<double>(shown.strip.size()) && shown.strip_shown >= shown.strip.back().held(rate))
    shown.playing = shown.plays_strip = false;
  next.reply["place"] = place;
  return next;
}

}  // namespace meniscus
