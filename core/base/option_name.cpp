// SPDX-License-Identifier: BSD-3-Clause
// Spells options as on a command line, or as the door says that was opened.
#include "core/base/option_name.h"

namespace meniscus {
namespace {

std::string on_command_line(std::string_view name) { return "--" + std::string(name); }

OptionSpelling spelling_of_door = on_command_line;

}  // namespace

std::string option_name(std::string_view name) { return spelling_of_door(name); }

void spell_options(OptionSpelling spelling) { spelling_of_door = spelling; }

}  // namespace meniscus
