// SPDX-License-Identifier: BSD-3-Clause
// Commands of a preview, one JSON object a line: recorded sessions, their values, and merged waiting commands.
#include <optional>
#include <string>
#include <vector>

#include "app/preview/command_json.h"
#include "app/preview/server/clients.h"
#include "core/base/error.h"
#include "core/camera/camera.h"
#include "core/camera/camera_json.h"
#include "core/properties/properties.h"
#include "core/scene/scene.h"
#include "core/scene/scene_json.h"
#include "core/scene/scene_value.h"
#include "core/scene/scene_values.h"
#include "tests/fuzz/target.h"

namespace meniscus::fuzz {
namespace {

using Json = nlohmann::json;
using Ordered = nlohmann::ordered_json;

/// Calls an action that may refuse a command.
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

/// Checks that the value of a command "set" is written as it is read again.
void check_property(const CommandReader& reader) {
  const std::string key = reader.text("key");
  for (const Property* property : properties()) {
    if (property->key != key || !property->has(live)) continue;
    Scene scene, again;
    scene_values::replace_value(scene, *property,
                                texts_of_json(*property, Ordered::parse(reader.value("value").dump())));
    const std::vector<std::string> written = value_texts(scene, *property);
    scene_values::replace_value(again, *property, written);
    require(value_texts(again, *property) == written, "a property written is read as it was");
  }
}

void check_values(const Json& command) {
  attempt([&] { check_property(CommandReader(command)); });
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

/// Checks that waiting commands enter a slow session in order, however many of them were merged.
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

void run_preview_commands(std::string_view bytes) {
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

const Registration registered_preview_commands{"preview_commands", run_preview_commands};

}  // namespace
}  // namespace meniscus::fuzz
