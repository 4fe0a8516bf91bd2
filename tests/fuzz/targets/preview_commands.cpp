// SPDX-License-Identifier: BSD-3-Clause
// Commands of a preview, one JSON object a line: recorded sessions, their values, and the merging of what waits.
#include <cmath>
#include <optional>

#include "app/preview/command_json.h"
#include "app/preview/look_json.h"
#include "app/preview/server/clients.h"
#include "core/base/error.h"
#include "core/camera/camera.h"
#include "core/camera/camera_json.h"
#include "core/render/look.h"
#include "tests/fuzz/target.h"

namespace meniscus::fuzz {
namespace {

using Json = nlohmann::json;

/// Calls what may refuse a command.
template <typename Action>
void attempt(Action&& action) {
  try {
    action();
  } catch (const RequestError& error) {
    require_clear(error);
  } catch (const InputError& error) {
    require_clear(error);
  }
}

void check_look(const CommandReader& reader) {
  reader.expect_only(look_keys());
  LookRequest plain;
  plain.preset = LookPreset::classic;
  const auto written = [&](const CommandReader& command) {
    return look_json(look_of(changed_look(plain, command), {960, 960}, glm::vec3(1.0f), Hues::free));
  };
  const Json look = written(reader);
  Json json = look;
  json["command"] = "look";
  require(written(CommandReader(json)) == look, "a look written is read as it was");
}

void check_values(const Json& command) {
  attempt([&] { check_look(CommandReader(command)); });
  attempt([&] { CommandReader(command).word(); });
  for (const char* key : {"dx", "factor", "camera", "index", "on", "path"}) {
    attempt([&] {
      const double number = CommandReader(command).number(key, -100.0, 100.0);
      require(number >= -100.0 && number <= 100.0, "numbers are within their bounds");
    });
    attempt([&] {
      const int number = CommandReader(command).integer(key, 0, 100);
      require(number >= 0 && number <= 100, "whole numbers are within their bounds");
    });
    attempt([&] { CommandReader(command).flag(key); });
    attempt([&] { CommandReader(command).text(key); });
    attempt([&] { CommandReader(command).choice(key, {"a", "b"}); });
    attempt([&] { validate_camera(parse_camera(json_line(CommandReader(command).value(key)), "camera"), "camera"); });
  }
}

/// What waits for a slow session goes into it in order, however much of it was merged.
void check_mailbox(const std::vector<WrittenCommand>& commands) {
  Mailbox mailbox;
  std::size_t put = 0, taken = 0;
  for (const WrittenCommand& written : commands)
    put += mailbox.put(1 + written.line % 2, written.line, written.command);
  mailbox.waiting_change();
  if (put == 0) return;
  for (const ClientCommand& command : mailbox.take(std::nullopt).commands) {
    taken += command.ids.size();
    require(Json::parse(json_line(command.command)) == command.command || !command.command.is_object(),
            "a command that waited is JSON");
  }
  require(taken == put, "no command is lost");
}

void run(std::string_view bytes) {
  static const ScratchFile scratch("session.jsonl");
  std::vector<WrittenCommand> commands;
  attempt([&] { commands = read_commands(scratch.write(bytes)); });
  for (const WrittenCommand& written : commands) {
    require(Json::parse(json_line(written.command)) == written.command, "a command written is read as it was");
    is_question(written.command);
    check_values(written.command);
  }
  check_mailbox(commands);
}

const Registration registration{"preview_commands", run};

}  // namespace
}  // namespace meniscus::fuzz
