// SPDX-License-Identifier: BSD-3-Clause
// The commands of the strip: scenes that are kept, and the way from each to the next, as `meniscus film` goes.

#include "app/preview/command_json.h"
#include "app/preview/commands.h"
#include "core/base/error.h"
#include "core/scene/transition.h"

namespace meniscus {
namespace {

constexpr std::size_t kMostScenes = 50;
constexpr double kLongestScene = 3600.0;  // seconds of a scene, as `meniscus film` has it

/// Numbers change steadily; all else is that of the nearer scene.
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

/// place: from 0 to the last scene.
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

/// The scene that "index" names.
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
    constexpr double kRounding = 1e-6;  // of a share that is a whole number of steps
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
