// SPDX-License-Identifier: BSD-3-Clause
// Carries out commands, and keeps a live view current: first a draft, and the full picture when nothing moves.
#include "app/preview/session.h"

#include <new>

#include "app/preview/commands.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

/// Returns true if a cut depends on the camera.
bool follows_view(const FigureRequest& figure) {
  const auto is_of_view = [](const Cut& cut) { return cut.direction == glm::dvec3(0.0); };
  const auto has_such = [&](const FigureObjectRequest& object) { return std::ranges::any_of(object.cuts, is_of_view); };
  return std::ranges::any_of(figure.cuts, is_of_view) || std::ranges::any_of(figure.objects, has_such);
}

/// Returns the command as it is recorded. A replay waits for each export to end.
Json recorded(Json command) {
  if (command_word(command) == "export") command.erase("wait");
  return command;
}

}  // namespace

PreviewSession::PreviewSession(std::unique_ptr<PreviewRenderer> renderer, Structure structure, PreviewState state,
                               const std::optional<Camera>& camera, std::filesystem::path export_folder,
                               std::optional<TrajectoryPositions> trajectory, SessionContext context)
    : state_(std::move(state)),
      molecule_(std::move(structure), std::move(trajectory), context.read_shown, state_),
      pictures_(std::move(renderer)),
      exporter_{std::filesystem::absolute(export_folder).lexically_normal(), std::move(context)} {
  require_previewed(state_.molecule.color);
  state_.overview = !camera;
  state_.camera = camera ? *camera : molecule_.overview(state_);
  validate_camera(state_.camera, "the view");
  pictures_.take(state_, molecule_, Renewal::frame, true);
  first_ = state_;
}

Json PreviewSession::apply(const Json& command) {
  const auto failed = [&](const std::string& error) {
    const std::string word = command_word(command);
    std::string said = said_by(word, error);
    if ((word == "set" || word == "add") && !said.starts_with(word + ": "))
      said = fmt::format("{}: {}: {}", word, command["key"].get<std::string>(), said);
    return Json{{"ok", false}, {"error", escaped(said)}};
  };
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

std::shared_ptr<const page::PackedFrame> PreviewSession::figure(const std::function<bool()>& stop) {
  return tables_.packed(state_, molecule_, stop);
}

Json PreviewSession::carry_out(const Json& json) {
  const CommandReader reader(json);
  const Command& command = row_of(reader);
  const Surroundings around{state_, first_, history_, molecule_, pictures_, exporter_};
  Json reply = Json::object();
  if (const auto* reducer = std::get_if<Reducer*>(&command.run)) {
    reply = become(command, [&](PreviewState state) { return (*reducer)(reader, std::move(state), around); });
  } else {
    reply = std::get<Service*>(command.run)(reader, around);
  }
  if (sink_ && command.is_recorded && !is_question(json)) sink_(recorded(json));
  reply["ok"] = true;
  return reply;
}

Json PreviewSession::become(const Command& command, const std::function<Outcome(PreviewState)>& reduce) {
  Outcome next = reduce(state_);
  bool moves = false;
  for (std::size_t tried = 1;; ++tried) {
    try {
      validate_camera(next.state.camera, "the view");
      moves = molecule_.become(next.state, next.renewal);
      break;
    } catch (const InputError&) {
      if (!next.passes_over_damage || tried >= molecule_.frame_count()) throw;
      next = reduce(std::move(next.state));
    }
  }
  if (state_.plays_strip && command.pauses_film()) next.state.playing = next.state.plays_strip = false;
  if (next.frames_all && next.state.overview) next.state.camera = molecule_.overview(next.state);
  pictures_.take(next.state, molecule_, next.renewal, moves);
  if (command.makes_picture()) next.reply["revision"] = ++next.state.revision;
  note(command, next);
  if (next.renewal != Renewal::nothing || follows_view(next.state.figure)) figure_revision_ = next.state.revision;
  state_ = std::move(next.state);
  return std::move(next.reply);
}

void PreviewSession::note(const Command& command, Outcome& next) {
  using Effect = Command::Effect;
  if (command.is_step() && next.renewal != Renewal::nothing) next.state.edition = ++last_edition_;
  if (next.is_saved) exporter_.saved = next.state.edition;
  const std::string_view step = next.step.empty() ? command.kind_of_step() : next.step;
  if (command.is_step()) history_.note(next.is_own_step ? std::string_view() : step, state_);
  if (command.effect == Effect::back) history_.go_back(state_);
  if (command.effect == Effect::forward) history_.go_forward(state_);
  if (command.effect == Effect::ends_step) history_.end_step();
}

void replay_commands(const std::string& path, std::span<const WrittenCommand> commands, PreviewSession& session,
                     std::ostream& replies) {
  for (const auto& [line, command] : commands) {
    if (session.wants_to_quit()) return;
    print_reply(path, line, session.apply(command), replies);
  }
}

namespace {

using namespace std::chrono_literals;

constexpr auto kPause = 60ms;      // The draft gets its full size when the hand has paused this long.
constexpr auto kPatience = 400ms;  // A draft of a surface that is no longer wanted is given up after this time.
constexpr LiveView::Clock::duration kRest = 150ms, kLongestRest = 1500ms;

/// Returns true if another surface is wanted than the one that has been computed since `begin`.
bool is_unwanted(LiveView::Clock::time_point begin, const std::function<Change()>& waiting) {
  return LiveView::Clock::now() - begin > kPatience && waiting() == Change::surface;
}

}  // namespace

LiveView::LiveView(PreviewSession& session)
    : session_(session), seen_revision_(session.state().revision), last_change_(Clock::now()), rest_(kRest) {}

nlohmann::json LiveView::apply(const nlohmann::json& command) {
  nlohmann::json reply = session_.apply(command);
  note_change();
  return reply;
}

void LiveView::note_change() {
  if (session_.state().revision == seen_revision_) return;
  seen_revision_ = session_.state().revision;
  last_change_ = Clock::now();
  fault_.clear();
  if (session_.state().playing) return;
  draft_cost_.reset();
  plain_cost_.reset();
}

bool LiveView::draw(Quality quality, const std::function<Change()>& waiting) {
  const Clock::time_point begin = Clock::now();
  const auto stop = [&] { return quality != Quality::draft ? waiting() != Change::none : is_unwanted(begin, waiting); };
  try {
    const bool whole = session_.render(quality, stop);
    if (!whole) return false;
  } catch (const GpuError&) {
    throw;
  } catch (const Error& error) {
    fault_ = error.what();
    return false;
  }
  const Clock::duration cost = Clock::now() - begin;
  if (quality == Quality::draft) draft_cost_ = cost;
  if (quality == Quality::plain) plain_cost_ = cost;
  if (quality == Quality::full) rest_ = std::clamp(cost, kRest, kLongestRest);
  return true;
}

std::shared_ptr<const page::PackedFrame> LiveView::figure(const std::function<Change()>& waiting) {
  return session_.figure([begin = Clock::now(), &waiting] { return is_unwanted(begin, waiting); });
}

LiveView::Clock::duration LiveView::rest(Quality quality) const {
  if (quality <= Quality::draft) return Clock::duration::zero();
  return quality == Quality::plain ? kPause : rest_;
}

Quality LiveView::at_once() const {
  if (!session_.is_drawn() && session_.wants_balls()) return Quality::balls;
  if (!session_.state().playing || !draft_cost_) return Quality::draft;
  constexpr int kMostLikely = 3;  // a plain picture, of 4 times the pixels, likely takes no longer than so many drafts
  const std::chrono::duration<double> frame(0.8 / session_.state().rate());
  return plain_cost_.value_or(kMostLikely * *draft_cost_) < frame ? Quality::plain : Quality::draft;
}

Quality LiveView::due(Clock::time_point now) const {
  const Clock::duration rested = now - last_change_;
  if (session_.state().playing) return at_once();
  if (rested < rest(Quality::plain)) return Quality::draft;
  return rested < rest(Quality::full) ? Quality::plain : Quality::full;
}

}  // namespace meniscus
