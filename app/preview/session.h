// SPDX-License-Identifier: BSD-3-Clause
// A preview as the window, the page and recorded sessions drive it: commands go in, replies and pictures come out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>

#include "app/preview/command_json.h"
#include "app/preview/exporter.h"
#include "app/preview/preview_state.h"
#include "app/preview/shown_molecule.h"
#include "app/preview/view_cache.h"

namespace meniscus {

struct Command;
struct Outcome;

/// A state, what its pictures are made of, and the table of commands that make another state of it (commands.h). Used
/// by one thread.
class PreviewSession {
 public:
  /// A structure with instances has one model, and the renderer draws its copies. `state` says how it looks at first;
  /// without `camera` everything is shown. Throws InputError for a bad camera or first frame, and as color_atoms does.
  PreviewSession(std::unique_ptr<ViewRenderer> renderer, Structure structure, PreviewState state,
                 const std::optional<Camera>& camera, std::filesystem::path export_folder,
                 std::optional<TrajectoryPositions> trajectory = {}, SessionContext context = {});

  /// Carries out {"command": WORD, ...} and answers {"ok": true, ...} or {"ok": false, "error": "one clear line"};
  /// after an error nothing has changed. The commands: app/preview/commands.md. Throws GpuError only: then all is lost.
  nlohmann::json apply(const nlohmann::json& command);

  /// Calls `sink` with every command from now on that was carried out and is no mere question (is_question).
  void record(std::function<void(const nlohmann::json&)> sink) { sink_ = std::move(sink); }

  /// The picture of the state: see ViewCache. A new one may come with render and with apply (pick).
  bool render(Quality quality, const std::function<bool()>& stop = {}) {
    return pictures_.draw(state_, molecule_, quality, stop);
  }
  bool is_drawn(Quality quality) const { return pictures_.is_drawn(state_, quality); }
  std::vector<std::uint8_t> rgba() const { return pictures_.rgba(); }
  std::uint32_t texture() const { return pictures_.texture(); }
  glm::ivec2 picture_size() const { return pictures_.size(); }

  /// A command asked to end.
  bool wants_to_quit() const { return state_.ended; }
  const PreviewState& state() const { return state_; }
  /// At the frame of the state.
  const Structure& structure() const { return molecule_.structure(); }
  /// Of the figure's cuts: a sentence for each that cuts nothing or leaves nothing.
  std::vector<std::string> idle_cuts() const { return molecule_.idle_among(state_.figure.cuts, state_); }

 private:
  nlohmann::json carry_out(const nlohmann::json& command);
  nlohmann::json become(const Command& command, const std::function<Outcome(PreviewState)>& reduce);
  void note(const Command& command, const Outcome& next);

  PreviewState state_;
  ShownMolecule molecule_;
  ViewCache pictures_;
  Exporter exporter_;
  EditHistory history_;
  PreviewState first_;  ///< as it began
  std::function<void(const nlohmann::json&)> sink_;
};

/// Carries out the commands of the file `path`, up to one that asks to quit, and prints the replies.
void replay_commands(const std::string& path, std::span<const WrittenCommand> commands, PreviewSession& session,
                     std::ostream& replies);

}  // namespace meniscus
