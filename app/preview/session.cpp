// SPDX-License-Identifier: BSD-3-Clause
// Dispatches commands to the table, and takes over the states that they make.
#include "app/preview/session.h"

#include <new>

#include "app/preview/command_json.h"
#include "app/preview/commands.h"
#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

/// A replay waits for each export to end.
Json recorded(Json command) {
  if (command_word(command) == "export") command.erase("wait");
  return command;
}

}  // namespace

PreviewSession::PreviewSession(std::unique_ptr<ViewRenderer> renderer, Structure structure, PreviewState state,
                               const std::optional<Camera>& camera, std::filesystem::path export_folder,
                               std::optional<TrajectoryPositions> trajectory, SessionContext context)
    : state_(std::move(state)),
      molecule_(std::move(structure), std::move(trajectory), context.read_shown, state_),
      pictures_(std::move(renderer)),
      exporter_{std::move(export_folder), std::move(context)} {
  require_previewed(state_.color);
  state_.overview = !camera;
  state_.camera = camera ? *camera : molecule_.overview(state_);
  validate_camera(state_.camera, "the view");
  pictures_.take(state_, molecule_, Renewal::frame, true);
  first_ = state_;
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
  const Command& command = row_of(reader);
  const Surroundings around{state_, first_, history_, molecule_, pictures_, exporter_};
  Json reply = Json::object();
  if (const auto* reducer = std::get_if<Reducer*>(&command.run)) {
    reply = become(command, [&](PreviewState state) { return (*reducer)(reader, std::move(state), around); });
  } else if (const auto* service = std::get_if<Service*>(&command.run)) {
    reply = (*service)(reader, around);
  } else {
    const KeyMeaning meaning = std::get<Translator*>(command.run)(reader, around);
    if (meaning.command) {
      reply = carry_out(*meaning.command);  // which is recorded
      reply["command"] = *meaning.command;
    }
    if (meaning.action) reply["action"] = face_action_word(*meaning.action);
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
  if (next.frames_all && next.state.overview) next.state.camera = molecule_.overview(next.state);
  pictures_.take(next.state, molecule_, next.renewal, moves);
  if (command.makes_picture()) next.reply["revision"] = ++next.state.revision;
  note(command, next);
  state_ = std::move(next.state);
  return std::move(next.reply);
}

void PreviewSession::note(const Command& command, const Outcome& next) {
  using Effect = Command::Effect;
  if (command.is_step()) history_.note(next.is_own_step ? std::string_view() : command.kind_of_step(), state_);
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

}  // namespace meniscus
