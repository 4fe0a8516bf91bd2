// SPDX-License-Identifier: BSD-3-Clause
// A preview that pages and recorded sessions drive: it receives commands, and returns replies and pictures.
#pragma once

#include "app/preview/command_json.h"
#include "app/preview/preview_state.h"
#include "app/preview/shown_molecule.h"
#include "app/preview/view_cache.h"
#include "app/preview/view_export.h"

namespace meniscus {

struct Command;
struct Outcome;

/// A state, its pictures, and the table of commands that make other states of it (commands.h). Used by one thread.
class PreviewSession {
 public:
  /// Begins with `state`; without `camera` everything is in view. A structure with instances has one model, and the
  /// renderer draws its copies. Throws InputError for a bad camera or first frame, and the errors of color_atoms.
  PreviewSession(std::unique_ptr<PreviewRenderer> renderer, Structure structure, PreviewState state,
                 const std::optional<Camera>& camera, std::filesystem::path export_folder,
                 std::optional<TrajectoryPositions> trajectory = {}, SessionContext context = {});

  /// Carries out {"command": WORD, ...} and answers {"ok": true, ...} or {"ok": false, "error": "one clear line"}; an
  /// error changes nothing. The commands are in app/preview/commands.md. Throws only GpuError, which ends the session.
  nlohmann::json apply(const nlohmann::json& command);

  /// Calls `sink` from now on with every command that was carried out, except questions (is_question).
  void record(std::function<void(const nlohmann::json&)> sink) {
    sink_ = std::move(sink);
    exporter_.all_recorded = sink_ != nullptr;
  }

  /// Draws the picture of the state (ViewCache::draw). apply() may draw another one for a pick.
  bool render(Quality quality, const std::function<bool()>& stop = {}) {
    return pictures_.draw(state_, molecule_, quality, stop);
  }
  /// Returns true if atoms alone should be shown first: see ViewCache.
  bool wants_balls() const { return pictures_.wants_balls(state_, molecule_); }
  bool is_drawn(Quality quality) const { return pictures_.is_drawn(state_, quality); }
  /// Returns true if there is a picture of the state, of any quality.
  bool is_drawn() const { return pictures_.is_drawn(state_); }
  /// Returns the figure for pages that cast it: see FigureTables.
  std::shared_ptr<const page::PackedFrame> figure(const std::function<bool()>& stop = {});
  /// Returns the revision that made the present figure. The camera changes it only if a cut follows the camera.
  std::uint64_t figure_revision() const { return figure_revision_; }
  std::vector<std::uint8_t> rgba() const { return pictures_.rgba(); }
  glm::ivec2 picture_size() const { return pictures_.size(); }

  /// Returns true after the command quit.
  bool wants_to_quit() const { return state_.ended; }
  const PreviewState& state() const { return state_; }
  /// Returns the files and folders that exports and saved scenes have written.
  std::vector<std::filesystem::path> written_paths() const { return exporter_.written_paths(); }
  /// Returns the structure at the frame of the state.
  const Structure& structure() const { return molecule_.structure(); }
  /// Returns a sentence for each of the figure's cuts that cuts nothing or leaves nothing.
  std::vector<std::string> ineffective_cuts() const { return molecule_.ineffective_among(state_.figure.cuts, state_); }

 private:
  nlohmann::json carry_out(const nlohmann::json& command);
  nlohmann::json become(const Command& command, const std::function<Outcome(PreviewState)>& reduce);
  void note(const Command& command, Outcome& next);

  PreviewState state_;
  ShownMolecule molecule_;
  ViewCache pictures_;
  FigureTables tables_;
  Exporter exporter_;
  EditHistory history_;
  PreviewState first_;  ///< the state when the preview began
  std::uint64_t last_edition_ = 0, figure_revision_ = 1;
  std::function<void(const nlohmann::json&)> sink_;
};

/// Carries out the commands of the file `path`, up to one that asks to quit, and prints the replies.
void replay_commands(const std::string& path, std::span<const WrittenCommand> commands, PreviewSession& session,
                     std::ostream& replies);

/// Decides when each picture of a session is due. Used by the session's thread only.
class LiveView {
 public:
  using Clock = std::chrono::steady_clock;

  /// The session must live longer than the view.
  explicit LiveView(PreviewSession& session);

  /// Carries out a command and returns its reply.
  nlohmann::json apply(const nlohmann::json& command);

  /// Draws the view in this quality. waiting: returns the largest change of the commands that wait. A draft goes on
  /// while the view moves, so that a long drag shows something, and is given up late and only for another surface;
  /// better pictures for any change. Returns false if it was given up or cannot be drawn (fault). Throws GpuError.
  bool draw(Quality quality, const std::function<Change()>& waiting);
  /// Returns the figure for pages that cast it; nullptr if given up, as late as a draft. Throws like FigureTables.
  std::shared_ptr<const page::PackedFrame> figure(const std::function<Change()>& waiting);

  /// Returns how long the view must rest before a picture of this quality is begun. For a full picture this is about as
  /// long as it takes to draw, because it stops between samples only.
  Clock::duration rest(Quality quality) const;
  /// Returns the quality of the first picture after a change: balls while there is no surface yet and the first one
  /// takes long, else a draft. A trajectory that plays has the full size once a picture of it was made before its next
  /// frame was due.
  Quality at_once() const;
  /// Returns the quality that is due at this time, after the view has rested since its last change.
  Quality due(Clock::time_point now) const;
  Clock::time_point last_change() const { return last_change_; }

  /// Returns why this view could not be drawn; empty if it was drawn or has yet to be.
  const std::string& fault() const { return fault_; }

 private:
  void note_change();

  PreviewSession& session_;
  std::uint64_t seen_revision_;
  Clock::time_point last_change_;
  Clock::duration rest_;
  std::optional<Clock::duration> draft_cost_, plain_cost_;  ///< costs of the last pictures since the trajectory plays
  std::string fault_;
};

}  // namespace meniscus
