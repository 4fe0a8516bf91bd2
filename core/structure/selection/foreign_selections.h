// SPDX-License-Identifier: BSD-3-Clause
// Recognizes selections in the languages of PyMOL and ChimeraX, and translates them.
#pragma once

#include <string>
#include <string_view>

namespace meniscus {

/// Returns the message "'/a//A/10' is written in PyMOL's way; write 'chain A and resid 10'". The result is empty if the
/// word does not look like a selection of either program.
std::string advice_on_foreign_selection(std::string_view word);

}  // namespace meniscus
