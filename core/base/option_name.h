// SPDX-License-Identifier: BSD-3-Clause
// Options in messages: core says what is wrong and which option would change it, each door how its users write that.
#pragma once

#include <string>
#include <string_view>

namespace meniscus {

/// How an option is written, "keep-water" by its name: "--keep-water", unless the door has another spelling.
std::string option_name(std::string_view name);

/// The spelling of this door, which is set before anything else is called.
using OptionSpelling = std::string (*)(std::string_view name);
void spell_options(OptionSpelling spelling);

}  // namespace meniscus
