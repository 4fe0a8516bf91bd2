// SPDX-License-Identifier: BSD-3-Clause
// Writes names of molecules as comments of a scene, restricted to characters that have no effect there.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/color/color_key.h"
#include "exporters/povray/scene_colors.h"

namespace meniscus::povray {

/// Returns the name if it is harmless, and an empty text otherwise. A harmless name has at most 40 bytes and consists
/// of ASCII letters and digits, blanks between them, and the characters _ ' * + - . , ( ), which occur in names of
/// atoms and classes. No other name is ever written into a scene.
std::string_view harmless_name(std::string_view name);

/// Returns the names of a colour in the key as a comment, such as "  // chain A, C", with at most five names. The
/// result is empty if the colour has no harmless name.
std::string color_comment(const ColorKey& key, const SceneColor& color);

/// Returns a line with the kind of a piece and its atoms: "// toroidal A ARG 34 CA; A ARG 34 CB". atoms: indices into
/// `names`. A name that is not harmless becomes "?".
std::string piece_comment(PatchKind kind, std::span<const std::uint32_t> atoms, std::span<const std::string> names);

}  // namespace meniscus::povray
