// SPDX-License-Identifier: BSD-3-Clause
// Checks names character by character, and writes the harmless ones as comments.
#include "exporters/povray/scene_names.h"

#include <algorithm>

namespace meniscus::povray {
namespace {

constexpr std::size_t kLongestName = 40, kMostNames = 5;

bool is_letter_or_digit(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

bool is_allowed(char c) {
  return is_letter_or_digit(c) || std::string_view(" _'*+-.,()").find(c) != std::string_view::npos;
}

std::string_view kind_name(PatchKind kind) {
  switch (kind) {
    case PatchKind::convex:
      return "convex";
    case PatchKind::toroidal:
      return "toroidal";
    case PatchKind::concave:
      break;
  }
  return "concave";
}

}  // namespace

std::string_view harmless_name(std::string_view name) {
  const bool harmless = !name.empty() && name.size() <= kLongestName && name.front() != ' ' && name.back() != ' ' &&
                        std::ranges::all_of(name, is_allowed) && std::ranges::any_of(name, is_letter_or_digit);
  return harmless ? name : std::string_view{};
}

std::string color_comment(const ColorKey& key, const SceneColor& color) {
  if (color.by_map) return {};
  std::string names;
  std::size_t count = 0;
  for (const ColorClass& entry : key.classes) {
    if (entry.color != color.color || harmless_name(entry.name).empty()) continue;
    if (++count > kMostNames) break;
    names.append(count == 1 ? "" : ", ").append(entry.name);
  }
  for (const ColorKey& other : key.others)
    if (count == 0 && !color_comment(other, color).empty()) return color_comment(other, color);
  if (count == 0) return {};
  std::string comment = "  // ";
  if (!harmless_name(key.title).empty()) comment.append(key.title).append(" ");
  return comment + names + (count > kMostNames ? ", ..." : "");
}

std::string piece_comment(PatchKind kind, std::span<const std::uint32_t> atoms, std::span<const std::string> names) {
  std::string comment("// ");
  comment += kind_name(kind);
  for (std::size_t n = 0; n < atoms.size(); ++n) {
    const std::string_view name = atoms[n] < names.size() ? harmless_name(names[atoms[n]]) : std::string_view{};
    comment.append(n == 0 ? " " : "; ").append(name.empty() ? "?" : name);
  }
  return comment + "\n";
}

}  // namespace meniscus::povray
