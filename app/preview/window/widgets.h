// SPDX-License-Identifier: BSD-3-Clause
// What several parts of the panel are made of; what lies over the picture: the help, and a note beside the mouse.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace meniscus {

/// A line that parts the panel.
void heading(const char* text);
/// Text of a file or the session, never a format.
void plain(const std::string& text);
/// The same in the colour of faults.
void fault(const std::string& text);
/// A name at the left; the next widget is at its right and fills the line.
void label(const char* text);
/// The next widget in the same line, close by.
void same_line();
/// Says more about the widget before, while the mouse is on it.
void tooltip(const std::string& text);
/// A list to choose from; the word chosen now, or nothing.
std::optional<std::string> chosen(const char* id, const std::string& current, const std::vector<std::string>& words);
/// A number of a slider with no more digits than it shows.
double rounded(float value);

/// What a pick says, in up to four lines: atom, residue and chain, kind of patch, exposed area.
std::array<std::string, 4> pick_lines(const nlohmann::json& pick);

/// All keys and gestures, in the middle of the window beside a panel of this width.
void draw_help(float panel);

/// What the mouse points at, as the command "pick" answers; nothing for null or a miss.
void draw_answer(const nlohmann::json& pick);

}  // namespace meniscus
