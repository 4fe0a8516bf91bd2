// SPDX-License-Identifier: BSD-3-Clause
// The table of commands, and those of the session itself: undo and redo, keys, the end.
#include "app/preview/commands.h"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

std::vector<Command> all_commands() {
  using Effect = Command::Effect;
  return {
      {"orbit", {"dx", "dy"}, Effect::motion, orbit},
      {"pan", {"dx", "dy"}, Effect::motion, pan},
      {"zoom", {"factor", "x", "y"}, Effect::motion, zoom},
      {"roll", {"degrees"}, Effect::motion, roll},
      {"zoom_to", {"selection"}, Effect::edit, zoom_to},
      {"center", {"x", "y"}, Effect::edit, center},
      {"reset_view", {}, Effect::edit, reset_view},
      {"camera", {"camera"}, Effect::edit, set_camera},
      {"save_view", {"name"}, Effect::none, save_view},
      {"recall_view", {"name"}, Effect::edit, recall_view},
      {"forget_view", {"name"}, Effect::none, forget_view},
      {"hide", {"selection"}, Effect::edit, hide},
      {"represent", {"as", "selection"}, Effect::edit, represent},
      {"object", {"object", "index"}, Effect::slide, put_object},
      {"set", {"key", "value"}, Effect::slide, set_property},
      {"paint", {"selection", "color"}, Effect::edit, paint},
      {"opacity", {"opacity", "selection", "index"}, Effect::slide, set_opacity},
      {"cut", {"plane", "index"}, Effect::slide, set_cut},
      {"remove", {"of", "index"}, Effect::edit, remove_entry},
      {"look_into", {"selection"}, Effect::edit, look_into},
      {"take_away", {"selection"}, Effect::edit, take_away},
      {"bring_back", {"selection"}, Effect::edit, bring_back},
      {"strip", {"place"}, Effect::slide, show_strip},
      {"undo", {}, Effect::back, undo},
      {"redo", {}, Effect::forward, redo},
      {"end_step", {}, Effect::ends_step, end_step},
      {"frame", {"index"}, Effect::picture, show_frame},
      {"next_frame", {}, Effect::picture, next_frame},
      {"key", {"on"}, Effect::none, set_key},
      {"follow_keys", {"on"}, Effect::picture, follow_keys},
      {"keep_scene", {"index"}, Effect::none, keep_scene},
      {"forget_scene", {"index"}, Effect::none, forget_scene},
      {"time_scene", {"index", "hold", "transition"}, Effect::none, time_scene},
      {"play", {"fps", "strip"}, Effect::none, play},
      {"pause", {"fps"}, Effect::none, pause},
      {"resize", {"width", "height"}, Effect::picture, resize},
      {"press", {"key"}, Effect::none, press, false},  // what it means is recorded
      {"pick", {"x", "y", "place", "wait", "area"}, Effect::none, pick},
      {"export",
       {"format", "of", "path", "archive", "width", "height", "samples", "transparent", "turns", "seconds", "force",
        "wait"},
       Effect::none,
       export_view},
      {"films", {"width", "height", "seconds"}, Effect::none, get_films},
      {"export_state", {}, Effect::none, export_state},
      {"cancel_export", {}, Effect::none, cancel_export, false},
      {"save", {"path", "width", "height", "samples", "transparent", "force", "strip"}, Effect::none, save_scene},
      {"open", {"path"}, Effect::edit, open_scene},
      {"scene", {"width", "height", "samples", "transparent"}, Effect::none, get_scene},
      {"render_command", {"width", "height", "samples", "transparent"}, Effect::none, render_command},
      {"contents", {"selection"}, Effect::none, get_contents},
      {"locate", {"selection"}, Effect::none, locate},
      {"stats", {}, Effect::none, get_stats},
      {"state", {}, Effect::none, get_state},
      {"choices", {}, Effect::none, get_choices},
      {"quit", {}, Effect::none, quit},
  };
}

/// Words that recorded sessions of former versions may have, and the keys by which "set" does the same.
constexpr std::pair<std::string_view, std::string_view> kFormerWords[] = {
    {"surface", "surface.kind"},         {"probe", "surface.probe"},          {"show", "surface.show"},
    {"patches", "surface.patches"},      {"color", "surface.color"},          {"patch_kinds", "surface.color"},
    {"projection", "camera.projection"}, {"samples", "image.samples"},        {"preset", "look.preset"},
    {"look", "look.ambient and so on"},  {"legend", "legend.shown and so on"}};

const std::vector<Command>& command_table() {
  static const std::vector<Command> all = all_commands();
  return all;
}

/// The figure that undo or redo brings back, in place of the state's.
Outcome restored(PreviewState state, const PreviewFigure& figure, std::size_t undo_steps, std::size_t redo_steps) {
  static_cast<PreviewFigure&>(state) = figure;
  return {std::move(state), Renewal::shapes, {{"undo", undo_steps}, {"redo", redo_steps}}, true};
}

}  // namespace

std::string said_by(const std::string& word, const std::string& error) {
  for (const Command& known : command_table())
    if (error.starts_with(std::string(known.word) + ": ")) return word + error.substr(known.word.size());
  return error;
}

const Command& row_of(const CommandReader& command) {
  const auto row = std::ranges::find(command_table(), command.word(), &Command::word);
  if (row == command_table().end()) {
    for (const auto& [word, key] : kFormerWords)
      if (command.word() == word)
        throw RequestError(fmt::format("{} is no command any more; use set with the key {}", in_quotes(word), key));
    std::vector<std::string_view> words;
    for (const Command& known : command_table()) words.push_back(known.word);
    throw RequestError(
        fmt::format("{} is not a command; the commands are {}", in_quotes(command.word()), fmt::join(words, ", ")));
  }
  command.expect_only(row->keys);
  return *row;
}

Outcome undo(const CommandReader&, PreviewState state, const Surroundings& around) {
  const EditHistory& history = around.history;
  if (!history.before()) throw RequestError("undo: nothing was changed yet");
  return restored(std::move(state), *history.before(), history.undo_steps() - 1, history.redo_steps() + 1);
}

Outcome redo(const CommandReader&, PreviewState state, const Surroundings& around) {
  const EditHistory& history = around.history;
  if (!history.after()) throw RequestError("redo: nothing was undone");
  return restored(std::move(state), *history.after(), history.undo_steps() + 1, history.redo_steps() - 1);
}

Outcome end_step(const CommandReader&, PreviewState state, const Surroundings&) { return {std::move(state)}; }

Outcome quit(const CommandReader&, PreviewState state, const Surroundings&) {
  state.ended = true;
  return {std::move(state)};
}

KeyMeaning press(const CommandReader& command, const Surroundings& around) {
  return key_meaning(command.text("key"), get_state(command, around));
}

}  // namespace meniscus
