// SPDX-License-Identifier: BSD-3-Clause
// The table of all commands, and those of the session itself: undo and redo, sizes, keys, the end.
#include <algorithm>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "app/preview/command_json.h"
#include "app/preview/command_reader.h"
#include "app/preview/key_table.h"
#include "app/preview/look_json.h"
#include "app/preview/session.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/selection/selection.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

constexpr int kLongestSide = 8192;  // pixels; a GL texture holds it on all hardware of GL 4.5
constexpr int kMostSamples = 64;

/// Whoever carries it out again waits for exports.
Json recorded(Json command) {
  if (command_word(command) == "export") command.erase("wait");
  return command;
}

}  // namespace

struct PreviewSession::Command {
  /// What it does to the picture, and how it is undone.
  enum class Effect {
    none,
    picture,  ///< there is another; not to be undone
    edit,     ///< and this is a step by itself
    slide,    ///< the same command again makes one step of both
    motion    ///< and so do all movements of the camera
  };
  std::string_view word;
  std::vector<std::string_view> keys;
  Json (PreviewSession::*run)(const CommandReader&);
  Effect effect;
  bool is_recorded = true;  ///< by record(), unless it is a question

  std::string_view step() const {
    if (effect == Effect::edit) return {};
    return effect == Effect::motion ? "motion" : word;
  }
};

const std::vector<PreviewSession::Command>& PreviewSession::commands() {
  using S = PreviewSession;
  using Effect = Command::Effect;
  const std::vector<std::string_view> look = look_keys();
  static const std::vector<Command> table{
      {"orbit", {"dx", "dy"}, &S::orbit, Effect::motion},
      {"pan", {"dx", "dy"}, &S::pan, Effect::motion},
      {"zoom", {"factor", "x", "y"}, &S::zoom, Effect::motion},
      {"roll", {"degrees"}, &S::roll, Effect::motion},
      {"zoom_to", {"selection"}, &S::zoom_to, Effect::edit},
      {"center", {"x", "y"}, &S::center, Effect::edit},
      {"reset_view", {}, &S::reset_view, Effect::edit},
      {"camera", {"camera"}, &S::set_camera, Effect::edit},
      {"projection", {"projection"}, &S::set_projection, Effect::edit},
      {"save_view", {"name"}, &S::save_view, Effect::none},
      {"recall_view", {"name"}, &S::recall_view, Effect::edit},
      {"forget_view", {"name"}, &S::forget_view, Effect::none},
      {"surface", {"kind"}, &S::set_surface, Effect::edit},
      {"probe", {"radius"}, &S::set_probe, Effect::slide},
      {"show", {"selection"}, &S::show, Effect::edit},
      {"hide", {"selection"}, &S::hide, Effect::edit},
      {"represent", {"as", "selection"}, &S::represent, Effect::edit},
      {"object", {"object", "index"}, &S::put_object, Effect::slide},
      {"hide_surface", {"on"}, &S::hide_surface, Effect::edit},
      {"radii", {"stick", "tube"}, &S::set_radii, Effect::slide},
      {"color", {"scheme", "map", "range", "missing", "rules"}, &S::set_color, Effect::edit},
      {"paint", {"selection", "color"}, &S::paint, Effect::edit},
      {"patch_kinds", {"on"}, &S::set_patch_kinds, Effect::edit},
      {"opacity", {"opacity", "selection", "index"}, &S::set_opacity, Effect::slide},
      {"film_opacity", {"on"}, &S::set_film_opacity, Effect::edit},
      {"cut", {"plane", "index"}, &S::set_cut, Effect::slide},
      {"cap", {"color", "hatching"}, &S::set_cap, Effect::slide},
      {"remove", {"of", "index"}, &S::remove, Effect::edit},
      {"look", {look.begin(), look.end()}, &S::set_look, Effect::slide},
      {"preset", {"preset"}, &S::set_preset, Effect::edit},
      {"legend", {"on", "title", "letters", "place"}, &S::set_legend, Effect::edit},
      {"undo", {}, &S::undo, Effect::picture},
      {"redo", {}, &S::redo, Effect::picture},
      {"end_step", {}, &S::end_step, Effect::none},
      {"frame", {"index"}, &S::set_frame, Effect::picture},
      {"next_frame", {}, &S::next_frame, Effect::picture},
      {"key", {"on"}, &S::set_key, Effect::none},
      {"follow_keys", {"on"}, &S::follow_keys, Effect::picture},
      {"play", {"fps"}, &S::play, Effect::none},
      {"pause", {"fps"}, &S::pause, Effect::none},
      {"resize", {"width", "height"}, &S::resize, Effect::picture},
      {"samples", {"count"}, &S::set_samples, Effect::picture},
      {"press", {"key"}, &S::press, Effect::none, false},  // what it means is recorded
      {"pick", {"x", "y", "wait", "area"}, &S::pick, Effect::none},
      {"export",
       {"format", "path", "width", "height", "samples", "transparent", "force", "wait"},
       &S::export_view,
       Effect::none},
      {"export_state", {}, &S::export_state, Effect::none},
      {"cancel_export", {}, &S::cancel_export, Effect::none, false},
      {"save", {"path", "width", "height", "samples", "transparent", "force"}, &S::save_scene, Effect::none},
      {"open", {"path"}, &S::open_scene, Effect::edit},
      {"render_command", {"width", "height", "samples", "transparent"}, &S::render_command, Effect::none},
      {"stats", {}, &S::stats, Effect::none},
      {"state", {}, &S::state, Effect::none},
      {"choices", {}, &S::choices, Effect::none},
      {"quit", {}, &S::quit, Effect::none},
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
  const bool edits = command->effect >= Command::Effect::edit;
  const std::optional<PreviewFigure> before = edits ? std::optional<PreviewFigure>(view_) : std::nullopt;
  Json reply = (this->*command->run)(reader);
  // One more entry of a list is a step by itself, the slider that it has is another.
  const bool adds = (command->word == "object" || command->word == "cut") && !reader.has("index");
  if (edits) history_.note(adds ? std::string_view() : command->step(), *before);
  if (command->effect != Command::Effect::none) reply["revision"] = ++revision_;
  if (sink_ && !is_question(json) && command->is_recorded) sink_(recorded(json));
  reply["ok"] = true;
  return reply;
}

Json PreviewSession::undo(const CommandReader&) {
  restore(history_.undo(view_), "undo: nothing was changed yet");
  return {{"undo", history_.undo_steps()}, {"redo", history_.redo_steps()}};
}

Json PreviewSession::redo(const CommandReader&) {
  restore(history_.redo(view_), "redo: nothing was undone");
  return {{"undo", history_.undo_steps()}, {"redo", history_.redo_steps()}};
}

void PreviewSession::restore(const std::optional<PreviewFigure>& figure, const char* none) {
  if (!figure) throw RequestError(none);
  become(*figure, Changed::shapes);
}

Json PreviewSession::end_step(const CommandReader&) {
  history_.end_step();
  return Json::object();
}

Json PreviewSession::resize(const CommandReader& command) {
  view_.size = {command.integer("width", 16, kLongestSide), command.integer("height", 16, kLongestSide)};
  update_legend();
  if (view_.overview) look_at_all();
  return Json::object();
}

Json PreviewSession::set_samples(const CommandReader& command) {
  view_.samples = command.integer("count", 1, kMostSamples);
  return Json::object();
}

Json PreviewSession::press(const CommandReader& command) {
  const KeyMeaning meaning = key_meaning(command.text("key"), carry_out({{"command", "state"}}));
  Json reply = Json::object();
  if (meaning.command) {
    reply = carry_out(*meaning.command);  // which is recorded
    reply["command"] = *meaning.command;
  }
  if (meaning.action) reply["action"] = face_action_word(*meaning.action);
  return reply;
}

Json PreviewSession::quit(const CommandReader&) {
  quit_ = true;
  return Json::object();
}

}  // namespace meniscus
