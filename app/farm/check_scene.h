// SPDX-License-Identifier: BSD-3-Clause
// Checks that the POV-Ray scene of a bundle was written by this program: scenes are programs, which could read and
// write files anywhere.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace meniscus::farm {

/// What is in scene/. Throws InputError: an entry that is not a file of a scene, or a link; a word in a shared file
/// that this program does not write.
void check_scene(const std::filesystem::path& folder);

/// Fills the folder `to` with what POV-Ray needs for one frame: the bytes that were checked, so that nothing else of
/// scene/ is in its reach, whatever includes the scene names. Throws InputError for a setting or a word that this
/// program does not write, for a file that is missing; OutputError.
void copy_checked_scene(const std::filesystem::path& folder, std::uint64_t frame, const std::filesystem::path& to);

/// The words that are wrong in a text of POV-Ray's scene language, of which this program writes a small part: no
/// directive that opens a file but #include, no string from which a path out of the folder can be made, no function
/// that makes other strings. Empty: nothing is wrong.
std::string_view wrong_in_scene(std::string_view text);

/// The same for an .ini: the line that is wrong.
std::string_view wrong_in_settings(std::string_view text);

}  // namespace meniscus::farm
