// SPDX-License-Identifier: BSD-3-Clause
// The table of all commands of a preview: their words, their keys, their undo, and the functions that run them.
#pragma once

#include "app/preview/command_json.h"
#include "app/preview/preview_state.h"
#include "app/preview/shown_molecule.h"
#include "app/preview/view_cache.h"
#include "app/preview/view_export.h"

namespace meniscus {

/// The parts of a session that a command may read.
struct Surroundings {
  const PreviewState& state;
  const PreviewState& first;  ///< the state when the preview began
  const EditHistory& history;
  const ShownMolecule& molecule;  ///< the molecule in its present state
  ViewCache& pictures;
  Exporter& exporter;
};

/// The state that a command makes.
struct Outcome {
  PreviewState state;
  Renewal renewal = Renewal::nothing;
  nlohmann::json reply = nlohmann::json::object();
  bool frames_all = false;          ///< where everything is in view, everything comes into view again
  bool is_saved = false;            ///< a file has this figure
  bool is_own_step = false;         ///< undo takes it back alone, whatever the command before it was
  std::string step{};               ///< kind of the step; empty: the kind_of_step() of its command
  bool passes_over_damage = false;  ///< if its frame cannot be read, playing goes on from there
};

/// Makes a state from another one. Throws RequestError or InputError for a bad command.
using Reducer = Outcome(const CommandReader& command, PreviewState state, const Surroundings& around);
/// Answers or exports without changing the state. Throws RequestError or InputError for a bad command.
using Service = nlohmann::json(const CommandReader& command, const Surroundings& around);

struct Command {
  /// How the command affects the picture and undo.
  enum class Effect {
    none,      ///< the picture stays
    picture,   ///< there is another picture, which is not undone
    edit,      ///< there is another picture, and undo takes it back alone
    slide,     ///< there is another picture, and undo takes back a series of such commands at once
    back,      ///< the command undoes a step
    forward,   ///< the command redoes a step
    ends_step  ///< the next step is undone alone
  };
  std::string_view word;
  std::vector<std::string_view> keys;
  Effect effect;
  std::variant<Reducer*, Service*> run;
  bool is_recorded = true;  ///< false for questions, which no log needs

  bool is_step() const { return effect == Effect::edit || effect == Effect::slide; }
  bool makes_picture() const { return effect != Effect::none && effect != Effect::ends_step; }
  /// Returns true if the next picture of a film that plays would undo what the command does.
  bool pauses_film() const { return makes_picture() && word != "next_frame" && word != "resize"; }
  /// Returns the kind of the step; successive steps of one kind are undone together. Empty: the step is undone alone.
  std::string_view kind_of_step() const { return effect == Effect::edit ? std::string_view() : word; }
};

/// Returns the row of a command. Throws RequestError for an unknown word or key.
const Command& row_of(const CommandReader& command);

/// Returns the text of an error that a command threw, with the command's word before it unless the text has it.
std::string said_by(const std::string& word, const std::string& error);

/// Returns the values of all properties that the preview changes, by their keys, for the state.
nlohmann::json property_values(const PreviewState& state);
/// Returns what pages need for controls of these properties: names, limits, words and help.
nlohmann::json property_choices();

/// Answers the command "state".
Service get_state;

/// Returns the selections of an atom in the picture, of its residue, and of its chain or kind of molecule.
nlohmann::json place_selections(const Atom& atom, const ShownMolecule& molecule);

// The functions of the rows, by the file that defines them.
Reducer orbit, zoom_to, reset_view, set_camera, show_frame, next_frame, set_key, follow_keys, play, pause,
    resize;            // camera_commands.cpp
Reducer set_property;  // property_commands.cpp
/// Shows the next picture of a strip that plays; at its end playing ends.
Outcome next_of_strip(PreviewState state, const Surroundings& around);
Reducer keep_scene, forget_scene, time_scene, show_strip;  // camera_commands.cpp
Reducer go_through_history, end_step, quit;                // commands.cpp
Reducer look_into, take_away, bring_back;                  // content_commands.cpp
Service get_contents, locate;                              // content_commands.cpp
Service get_stats, get_choices, pick;                      // question_commands.cpp
Service export_view, get_films, export_state, cancel_export, save_scene, get_scene,
    render_command;  // export_commands.cpp
Reducer open_scene;  // export_commands.cpp

}  // namespace meniscus
