// SPDX-License-Identifier: BSD-3-Clause
// Recognizes words of selections in PyMOL and ChimeraX, and says what they are in our language.
#pragma once

#include <string>
#include <string_view>

namespace meniscus {

/// "'/a//A/10' is written in PyMOL's way; write 'chain A and resid 10'", as a message; empty if the word looks like
/// neither program's.
std::string advice_on_foreign_selection(std::string_view word);

}  // namespace meniscus
