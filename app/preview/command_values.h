// SPDX-License-Identifier: BSD-3-Clause
// Values of commands that several of them have: selections, and what names its command when it is wrong.
#pragma once

#include <string>

#include "app/preview/command_reader.h"
#include "core/base/error.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

/// Of words and numbers that a command has, what `parse` makes of them; both kinds of errors name the command.
template <typename Parse>
auto naming(const CommandReader& command, const Parse& parse) {
  try {
    return parse();
  } catch (const SelectionError& error) {
    throw RequestError(command.word() + ": " + error.sentence());
  } catch (const RequestError& error) {
    throw RequestError(command.word() + ": " + error.what());
  }
}

/// Throws RequestError.
inline Selection selection_of(const CommandReader& command, const char* key = "selection") {
  const std::string text = command.text(key);
  return naming(command, [&] { return parse_selection(text); });
}

}  // namespace meniscus
