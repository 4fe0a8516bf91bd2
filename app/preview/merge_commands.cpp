// SPDX-License-Identifier: BSD-3-Clause
// Adds drags, multiplies zooms, and lets the last of other movements count.
#include "app/preview/merge_commands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

namespace meniscus {
namespace {

bool is_one_of(std::span<const std::string_view> words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

bool are_numbers(const nlohmann::json& a, const nlohmann::json& b, const char* key) {
  return a.contains(key) && b.contains(key) && a[key].is_number() && b[key].is_number();
}

}  // namespace

bool merge_commands(nlohmann::json& first, const nlohmann::json& second) {
  constexpr std::array<std::string_view, 2> kDrags{"orbit", "pan"};
  constexpr std::array<std::string_view, 6> kLatest{"probe", "frame", "resize", "pick", "samples", "look"};
  if (!first.is_object() || !second.is_object() || first.size() != second.size()) return false;
  if (!first.contains("command") || !first["command"].is_string() ||
      first["command"] != second.value("command", nlohmann::json()))
    return false;
  const std::string word = first["command"];
  if (is_one_of(kDrags, word) && first.size() == 3 && are_numbers(first, second, "dx") &&
      are_numbers(first, second, "dy")) {
    const auto sum = [&](const char* key) { return first[key].get<double>() + second[key].get<double>(); };
    const double dx = sum("dx"), dy = sum("dy");
    if (!std::isfinite(dx) || !std::isfinite(dy)) return false;  // no number of JSON
    first["dx"] = dx;
    first["dy"] = dy;
    return true;
  }
  const auto same = [&](const char* key) {
    return first.value(key, nlohmann::json()) == second.value(key, nlohmann::json());
  };
  if (word == "zoom" && same("x") && same("y") && are_numbers(first, second, "factor")) {
    const auto is_factor = [](double factor) { return factor >= 1.0 / kMostZoom && factor <= kMostZoom; };
    const double before = first["factor"].get<double>(), after = second["factor"].get<double>();
    if (!is_factor(before) || !is_factor(after)) return false;  // refused, each by itself
    first["factor"] = std::clamp(before * after, 1.0 / kMostZoom, kMostZoom);
    return true;
  }
  // A slider that belongs to one entry of a list.
  constexpr std::array<std::string_view, 3> kEntries{"object", "cut", "opacity"};
  const bool same_entry = is_one_of(kEntries, word) && first.contains("index") && same("index");
  // A pick that is waited for is a click, and each click counts.
  const auto waits = [](const nlohmann::json& pick) { return !pick.contains("wait") || pick["wait"] != false; };
  if (!(is_one_of(kLatest, word) || same_entry) || (word == "pick" && (waits(first) || waits(second)))) return false;
  if (std::ranges::any_of(first.items(), [&](const auto& item) { return !second.contains(item.key()); })) return false;
  first = second;
  return true;
}

}  // namespace meniscus
