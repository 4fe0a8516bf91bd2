// SPDX-License-Identifier: BSD-3-Clause
// The commands that change what is seen, and the table of all.
#include <algorithm>
#include <array>
#include <new>
#include <numbers>

#include <fmt/format.h>

#include "app/preview/camera_motion.h"
#include "app/preview/command_reader.h"
#include "app/preview/look_json.h"
#include "app/preview/session.h"
#include "core/scene/copied_atoms.h"
#include "core/scene/molecule.h"
#include "core/scene/surface_objects.h"
#include "core/scene/surface_request.h"
#include "core/structure/selection/selection.h"
#include "core/base/error.h"
#include "core/color/color_atoms.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

constexpr double kLongestDrag = 100.0;  // heights of the picture
constexpr int kLongestSide = 8192;      // pixels; a GL texture holds it on all hardware of GL 4.5
constexpr int kMostSamples = 64;
constexpr std::size_t kMostRules = 100;

glm::dvec2 drag_of(const CommandReader& command) {
  return {command.number("dx", -kLongestDrag, kLongestDrag), command.number("dy", -kLongestDrag, kLongestDrag)};
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

/// "rules": a list of texts, as --color reads them.
std::vector<ColorRule> rules_of(const CommandReader& command) {
  std::vector<ColorRule> rules;
  const Json& texts = command.value("rules");
  if (!texts.is_array() || texts.size() > kMostRules)
    throw RequestError(
        fmt::format("color: \"rules\" is a list of at most {} texts such as \"ligand=red\"", kMostRules));
  for (const Json& text : texts) {
    if (!text.is_string()) throw RequestError("color: each of \"rules\" is a text such as \"ligand=red\"");
    try {
      rules.push_back(parse_color_rule(text.get<std::string>()));
    } catch (const RequestError& error) {
      throw RequestError(std::string("color: ") + error.what());
    }
  }
  return rules;
}

/// Rules and opacities of before stay unless the command has others.
ColorScheme color_of(const CommandReader& command, const ColorScheme& before) {
  const NumberFile& file = before.file;
  const std::string word = command.text("scheme");
  const std::optional<ColorScheme> scheme = parse_color_scheme(word);
  if (!scheme) throw RequestError("color: " + in_quotes(word) + " is none of " + color_scheme_words());
  ColorScheme color = *scheme;
  if (color.by == ColorScheme::By::component)
    throw RequestError("color: parts of the surface have no atoms of their own; use meniscus render --color component");
  color.rules = command.has("rules") ? rules_of(command) : before.rules;
  if (color.by == ColorScheme::By::kind && !color.rules.empty())
    throw RequestError("color: \"kind\" colours patches, rules colour atoms; send \"rules\": [] with it");
  color.opacities = before.opacities;
  if (color.uses_file() && file.empty())
    throw RequestError("color: \"file\" needs numbers; begin the preview with --color-by-file FILE");
  color.set_numbers(file);
  if (!command.has("map")) return color;
  color.map = parse_color_map(command.text("map"));
  if (!color.map) throw RequestError("color: " + in_quotes(command.text("map")) + " is no map; see meniscus colors");
  if (!color.has_scale()) throw RequestError("color: \"map\" is for colours by a number, not " + in_quotes(word));
  return color;
}

}  // namespace

struct PreviewSession::Command {
  std::string_view word;
  std::vector<std::string_view> keys;
  Json (PreviewSession::*run)(const CommandReader&);
  bool changes_picture;
};

const std::vector<PreviewSession::Command>& PreviewSession::commands() {
  using S = PreviewSession;
  const std::span<const std::string_view> look = look_keys();
  static const std::vector<Command> table{
      {"orbit", {"dx", "dy"}, &S::orbit, true},
      {"pan", {"dx", "dy"}, &S::pan, true},
      {"zoom", {"factor"}, &S::zoom, true},
      {"roll", {"degrees"}, &S::roll, true},
      {"zoom_to", {"selection"}, &S::zoom_to, true},
      {"reset_view", {}, &S::reset_view, true},
      {"camera", {"camera"}, &S::set_camera, true},
      {"projection", {"projection"}, &S::set_projection, true},
      {"probe", {"radius"}, &S::set_probe, true},
      {"color", {"scheme", "map", "rules"}, &S::set_color, true},
      {"patch_kinds", {"on"}, &S::set_patch_kinds, true},
      {"look", {look.begin(), look.end()}, &S::set_look, true},
      {"frame", {"index"}, &S::set_frame, true},
      {"next_frame", {}, &S::next_frame, true},
      {"key", {"on"}, &S::set_key, true},
      {"follow_keys", {"on"}, &S::follow_keys, true},
      {"play", {"fps"}, &S::play, false},
      {"pause", {}, &S::pause, false},
      {"resize", {"width", "height"}, &S::resize, true},
      {"samples", {"count"}, &S::set_samples, true},
      {"pick", {"x", "y", "wait"}, &S::pick, false},
      {"export", {"format", "path", "width", "height", "samples", "force"}, &S::export_view, false},
      {"stats", {}, &S::stats, false},
      {"state", {}, &S::state, false},
      {"choices", {}, &S::choices, false},
      {"quit", {}, &S::quit, false},
  };
  return table;
}

Json PreviewSession::apply(const Json& command) {
  const auto failed = [](const std::string& error) { return Json{{"ok", false}, {"error", escaped(error)}}; };
  try {
    return carry_out(command);
  } catch (const GpuError&) {
    throw;
  } catch (const SelectionError& error) {
    return failed(error.sentence());
  } catch (const Error& error) {
    return failed(error.what());
  } catch (const std::bad_alloc&) {
    return failed("not enough memory");
  }
}

Json PreviewSession::carry_out(const Json& json) {
  const CommandReader reader(json);
  const auto command = std::ranges::find(commands(), reader.word(), &Command::word);
  if (command == commands().end()) {
    std::string words;
    for (const Command& known : commands()) words.append(words.empty() ? "" : ", ").append(known.word);
    throw RequestError(fmt::format("{} is no command; there are {}", in_quotes(reader.word()), words));
  }
  reader.expect_only(command->keys);
  Json reply = (this->*command->run)(reader);
  if (command->changes_picture) reply["revision"] = ++revision_;
  if (sink_ && !is_question(json)) sink_(json);
  reply["ok"] = true;
  return reply;
}

Json PreviewSession::orbit(const CommandReader& command) {
  look_from(orbited(view_.camera, drag_of(command)));
  return Json::object();
}

Json PreviewSession::pan(const CommandReader& command) {
  look_from(panned(view_.camera, drag_of(command)));
  return Json::object();
}

Json PreviewSession::zoom(const CommandReader& command) {
  look_from(zoomed(view_.camera, command.number("factor", 1e-3, 1e3)));
  return Json::object();
}

Json PreviewSession::roll(const CommandReader& command) {
  look_from(rolled(view_.camera, command.number("degrees", -360.0, 360.0) * (std::numbers::pi / 180.0)));
  return Json::object();
}

Json PreviewSession::zoom_to(const CommandReader& command) {
  const Selection selection = parse_selection(command.text("selection"));
  std::vector<Atom> atoms;
  for (const std::uint32_t a : shown_atoms()) atoms.push_back(structure_.atoms[a]);
  const std::vector<bool> chosen = selection.evaluate(atoms);
  std::vector<Ball> shown;
  for (std::size_t n = 0; n < atoms.size(); ++n)
    if (chosen[n]) shown.push_back(balls_[n]);
  const std::size_t count = shown.size();
  if (!structure_.instances.empty()) shown = reaching_balls(balls_, copies_of(structure_.instances, chosen));
  if (shown.empty()) throw RequestError("zoom_to: no atom of this frame is " + in_quotes(selection.text()));
  look_from(zoomed_to(view_.camera, shown, reach(), aspect()));
  return {{"atoms", count}};
}

Json PreviewSession::reset_view(const CommandReader&) {
  look_at_all();
  return Json::object();
}

Json PreviewSession::set_camera(const CommandReader& command) {
  look_from(parse_camera(json_line(command.value("camera")), "camera"));
  return Json::object();
}

Json PreviewSession::set_projection(const CommandReader& command) {
  const std::size_t word = command.choice("projection", {"perspective", "orthographic"});
  look_from(projected(view_.camera, word == 0 ? Projection::perspective : Projection::orthographic, reach()));
  return Json::object();
}

Json PreviewSession::set_probe(const CommandReader& command) {
  const double radius = command.number("radius", 0.0, 1e6);
  const std::string fault = probe_fault(radius);
  if (!fault.empty()) throw RequestError("probe: " + fault);
  if (view_.copies_apart && radius > view_.probe_radius) require_apart(structure_, radius);
  view_.probe_radius = radius;
  return Json::object();
}

Json PreviewSession::set_color(const CommandReader& command) {
  const ColorScheme color = color_of(command, view_.color);
  require_colors_shared(structure_, color);
  coloring_ = color_atoms(structure_, color);
  view_.color = color;
  renderer_->set_coloring(frame_coloring());
  return Json::object();
}

Json PreviewSession::set_patch_kinds(const CommandReader& command) {
  view_.patch_kinds = command.flag("on");
  renderer_->set_coloring(frame_coloring());
  return Json::object();
}

Json PreviewSession::set_look(const CommandReader& command) {
  view_.look = changed_look(view_.look, command);
  return Json::object();
}

Json PreviewSession::set_frame(const CommandReader& command) {
  show_frame(static_cast<std::size_t>(command.integer("index", 0, static_cast<int>(frame_count()) - 1)));
  return Json::object();
}

Json PreviewSession::next_frame(const CommandReader&) {
  // A frame that cannot be read is passed over, or playing would never come past it.
  for (std::size_t step = 1;; ++step) {
    try {
      show_frame((view_.frame + step) % frame_count());
      return {{"frame", view_.frame}};
    } catch (const InputError&) {
      if (step >= frame_count()) throw;
    }
  }
}

Json PreviewSession::set_key(const CommandReader& command) {
  if (!command.flag_or(true, "on")) {
    view_.keys.erase(view_.frame);
  } else {
    for (const auto& [frame, camera] : view_.keys)
      if (frame != view_.frame && camera.projection != view_.camera.projection)
        throw RequestError("key: all keys of the camera must have one projection, that of the first");
    view_.keys[view_.frame] = view_.camera;
  }
  return {{"keys", view_.keys.size()}};
}

Json PreviewSession::follow_keys(const CommandReader& command) {
  view_.follows_keys = command.flag("on");
  show_frame(view_.frame);
  return {{"follow_keys", view_.follows_keys}};
}

Json PreviewSession::play(const CommandReader& command) {
  view_.frames_per_second = command.number_or(view_.frames_per_second, "fps", 0.1, 240.0);
  view_.playing = frame_count() > 1;
  return {{"playing", view_.playing}};
}

Json PreviewSession::pause(const CommandReader&) {
  view_.playing = false;
  return Json::object();
}

Json PreviewSession::resize(const CommandReader& command) {
  view_.size = {command.integer("width", 16, kLongestSide), command.integer("height", 16, kLongestSide)};
  if (overview_) look_at_all();
  return Json::object();
}

Json PreviewSession::set_samples(const CommandReader& command) {
  view_.samples = command.integer("count", 1, kMostSamples);
  return Json::object();
}

Json PreviewSession::quit(const CommandReader&) {
  quit_ = true;
  return Json::object();
}

}  // namespace meniscus
