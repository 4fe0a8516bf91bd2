// SPDX-License-Identifier: BSD-3-Clause
// A preview as its page and recorded sessions drive it: commands go in, replies and pictures come out.
#pragma once

#include "app/preview/command_json.h"
#include "app/preview/preview_state.h"
#include "app/preview/shown_molecule.h"
#include "app/preview/view_cache.h"
#include "app/preview/view_export.h"

namespace meniscus {

struct Command;
struct Outcome;

/// A state, what its pictures are made of, and the table of commands that make another state of it (commands.h). Used
/// by one thread.
class PreviewSession {
 public:
  /// A structure with instances has one model, and the renderer draws its copies. `state` says how it looks at first;
  /// without `camera` everything is shown. Throws InputError for a bad camera or first frame, and as color_atoms does.
  PreviewSession(std::unique_ptr<PreviewRenderer> renderer, Structure structure, PreviewState state,
                 const std::optional<Camera>& camera, std::filesystem::path export_folder,
                 std::optional<TrajectoryPositions> trajectory = {}, SessionContext context = {});

  /// Carries out {"command": WORD, ...} and answers {"ok": true, ...} or {"ok": false, "error": "one clear line"};
  /// after an error nothing has changed. The commands: app/preview/commands.md. Throws GpuError only: then all is lost.
  nlohmann::json apply(const nlohmann::json& command);

  /// Calls `sink` with every command from now on that was carried out and is not a mere question (is_question).
  void record(std::function<void(const nlohmann::json&)> sink) {
    sink_ = std::move(sink);
    exporter_.all_recorded = sink_ != nullptr;
  }

  /// The picture of the state: see ViewCache. A new one may come with render and with apply (pick).
  bool render(Quality quality, const std::function<bool()>& stop = {}) {
    return pictures_.draw(state_, molecule_, quality, stop);
  }
  /// Whether atoms alone should be shown first: see ViewCache.
  bool wants_balls() const { return pictures_.wants_balls(state_, molecule_); }
  bool is_drawn(Quality quality) const { return pictures_.is_drawn(state_, quality); }
  /// True if there is a picture of the state, of whatever quality.
  bool is_drawn() const { return pictures_.is_drawn(state_); }
  /// Returns the figure for pages that cast it: see FigureTables.
  std::shared_ptr<const page::PackedFrame> figure(const std::function<bool()>& stop = {});
  /// The revision of the state in which the figure became what it is. The camera alone changes no figure, unless a cut
  /// follows it.
  std::uint64_t figure_revision() const { return figure_revision_; }
  std::vector<std::uint8_t> rgba() const { return pictures_.rgba(); }
  glm::ivec2 picture_size() const { return pictures_.size(); }

  /// Returns true after the command quit.
  bool wants_to_quit() const { return state_.ended; }
  const PreviewState& state() const { return state_; }
  /// Returns the files and folders that exports and saved scenes have written.
  std::vector<std::filesystem::path> written_paths() const { return exporter_.written_paths(); }
  /// At the frame of the state.
  const Structure& structure() const { return molecule_.structure(); }
  /// Of the figure's cuts: a sentence for each that cuts nothing or leaves nothing.
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
  PreviewState first_;  ///< as it began
  std::uint64_t last_edition_ = 0, figure_revision_ = 1;
  std::function<void(const nlohmann::json&)> sink_;
};

/// Carries out the commands of the file `path`, up to one that asks to quit, and prints the replies.
void replay_commands(const std::string& path, std::span<const WrittenCommand> commands, PreviewSession& session,
                     std::ostream& replies);

/// Decides when which picture of a session is due. Used by one thread, that of the session.
class LiveView {
 public:
  using Clock = std::chrono::steady_clock;

  /// The session lives longer.
  explicit LiveView(PreviewSession& session);

  /// Carries a command out; its reply.
  nlohmann::json apply(const nlohmann::json& command);

  /// Draws the view in this quality. waiting: the most that a command which waits will change. A draft goes on whatever
  /// moves, or nothing would be seen of a long drag, and is given up late, for another surface only; better pictures
  /// for any change. False: it was given up, or it cannot be drawn (fault). Throws GpuError.
  bool draw(Quality quality, const std::function<Change()>& waiting);
  /// Returns the figure for pages that cast it; nullptr if it was given up, which it is as late as a draft. Throws what
  /// FigureTables throws.
  std::shared_ptr<const page::PackedFrame> figure(const std::function<Change()>& waiting);

  /// Without a change for so long a picture of this quality is begun. A full one is rested for as long as it may take,
  /// for it stops between samples only.
  Clock::duration rest(Quality quality) const;
  /// The quality of the first picture after a change: balls while there was no surface yet and the first one takes
  /// long, else a draft, but of a trajectory that plays the full size once a
  /// picture of it has turned out to be made before the next frame is due.
  Quality at_once() const;
  /// The quality that is due at this time, as the view has rested since its last change.
  Quality due(Clock::time_point now) const;
  Clock::time_point last_change() const { return last_change_; }

  /// Why this view could not be drawn; empty if it was drawn, or is still to be.
  const std::string& fault() const { return fault_; }

 private:
  void note_change();

  PreviewSession& session_;
  std::uint64_t seen_revision_;
  Clock::time_point last_change_;
  Clock::duration rest_;
  std::optional<Clock::duration> draft_cost_, plain_cost_;  ///< of the last picture since the trajectory plays
  std::string fault_;
};

}  // namespace meniscus
