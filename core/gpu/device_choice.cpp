// SPDX-License-Identifier: BSD-3-Clause
// Reading and writing the user's wish for a device.
#include "core/gpu/device_choice.h"

#include <charconv>

namespace meniscus {

std::optional<DeviceChoice> parse_device_choice(std::string_view text) {
  if (text == "auto") return DeviceChoice{};
  if (text == "software") return DeviceChoice{DeviceChoice::Kind::software, 0};
  if (text == "gpu") return DeviceChoice{DeviceChoice::Kind::gpu, 0};
  constexpr std::string_view kPrefix = "gpu:";
  if (!text.starts_with(kPrefix)) return std::nullopt;
  text.remove_prefix(kPrefix.size());
  int index = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc() || end != text.data() + text.size() || index < 0) return std::nullopt;
  return DeviceChoice{DeviceChoice::Kind::gpu, index};
}

std::string to_string(const DeviceChoice& choice) {
  switch (choice.kind) {
    case DeviceChoice::Kind::automatic:
      return "auto";
    case DeviceChoice::Kind::gpu:
      return "gpu:" + std::to_string(choice.index);
    case DeviceChoice::Kind::software:
      return "software";
  }
  return {};
}

}  // namespace meniscus
