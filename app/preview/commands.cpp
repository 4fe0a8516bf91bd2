// SPDX-License-Identifier: BSD-3-Clause
// The table of commands, and the commands undo, redo, end_step and quit.
#include "app/preview/commands.h"

namespace meniscus {
namespace {

std::vector<Command> all_commands() {
  using Effect = Command::Effect;
  return {
      {"orbit", {"dx", "dy"}, Effect::slide, orbit},
      {"zoom_to", {"selection"}, Effect::edit, zoom_to},
      {"reset_view", {}, Effect::edit, reset_view},
      {"camera", {"camera"}, Effect::edit, set_camera},
      {"set", {"key", "value", "index"}, Effect::slide, set_property},
      {"add", {"key", "value"}, Effect::slide, set_property},
      {"look_into", {"selection"}, Effect::edit, look_into},
      {"take_away", {"selection"}, Effect::edit, take_away},
      {"bring_back", {"selection"}, Effect::edit, bring_back},
      {"strip", {"place"}, Effect::slide, show_strip},
      {"undo", {}, Effect::back, go_through_history},
      {"redo", {}, Effect::forward, go_through_history},
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

/// Words of commands in recorded sessions of former versions, and the keys by which "set" does the same.
constexpr std::pair<std::string_view, std::string_view> kFormerWords[] = {
    {"surface", "surface.kind"},         {"probe", "surface.probe"},           {"show", "surface.show"},
    {"patches", "surface.patches"},      {"color", "surface.color"},           {"patch_kinds", "surface.color"},
    {"projection", "camera.projection"}, {"samples", "image.samples"},         {"preset", "look.preset"},
    {"look", "look.ambient and so on"},  {"legend", "legend.shown and so on"}, {"hide", "surface.show"},
    {"paint", "surface.color"},          {"opacity", "surface.opacity"},       {"cut", "surface.clip"},
    {"object", "figure.object"},         {"represent", "figure.sticks"}};

const std::vector<Command>& command_table() {
  static const std::vector<Command> all = all_commands();
  return all;
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
        throw RequestError("{} is no command any more; use set with the key {}", in_quotes(word), key);
    std::vector<std::string_view> words;
    for (const Command& known : command_table()) words.push_back(known.word);
    throw RequestError("{} is not a command; the commands are {}", in_quotes(command.word()), fmt::join(words, ", "));
  }
  command.expect_only(row->keys);
  return *row;
}

Outcome go_through_history(const CommandReader& command, PreviewState state, const Surroundings& around) {
  const EditHistory& history = around.history;
  const bool is_back = command.word() == "undo";
  const PreviewFigure* const figure = is_back ? history.before() : history.after();
  if (!figure) throw RequestError(is_back ? "undo: nothing was changed yet" : "redo: nothing was undone");
  static_cast<PreviewFigure&>(state) = *figure;
  const std::size_t undo_steps = is_back ? history.undo_steps() - 1 : history.undo_steps() + 1;
  const std::size_t redo_steps = is_back ? history.redo_steps() + 1 : history.redo_steps() - 1;
  return {std::move(state), Renewal::shapes, {{"undo", undo_steps}, {"redo", redo_steps}}, true};
}

Outcome end_step(const CommandReader&, PreviewState state, const Surroundings&) { return {std::move(state)}; }

Outcome quit(const CommandReader&, PreviewState state, const Surroundings&) {
  state.ended = true;
  return {std::move(state)};
}

}  // namespace meniscus
