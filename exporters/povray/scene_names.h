// SPDX-License-Identifier: BSD-3-Clause
// Names of molecules as comments of a scene, restricted to those that can do nothing there.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/color/color_key.h"
#include "exporters/povray/palette.h"

namespace meniscus::povray {

/// The name, or nothing if it is longer than 40 bytes or holds anything but letters and digits of ASCII, blanks between
/// them, and _ ' * + - . , ( ) as names of atoms and classes have them: it then is in no scene.
std::string_view harmless_name(std::string_view name);

/// What the key calls a colour, as "  // chain A, C": at most five names. Empty: nothing that may be said.
std::string color_comment(const ColorKey& key, const SceneColor& color);

/// A line that tells a piece's kind and the atoms that it belongs to: "// toroidal A ARG 34 CA; A ARG 34 CB". atoms:
/// into `names`. A name that is not harmless is "?".
std::string piece_comment(PatchKind kind, std::span<const std::uint32_t> atoms, std::span<const std::string> names);

}  // namespace meniscus::povray
