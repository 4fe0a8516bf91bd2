// SPDX-License-Identifier: BSD-3-Clause
// Parses and prints a user's choice of a device, and matches it with the devices of a machine, without GL.
#include "core/gpu/device_choice.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <iterator>

#include "core/base/text.h"

namespace meniscus {
namespace {

constexpr std::string_view kUuidPrefix = "gpu-";
constexpr std::size_t kShortestUuid = 8;  // number of digits

std::optional<int> parse_index(std::string_view text) {
  int index = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc() || end != text.data() + text.size() || index < 0) return {};
  return index;
}

/// True for a UUID or PCI address: hexadecimal digits and separators.
bool looks_like_a_name(std::string_view text) {
  if (lower_case(text).starts_with(kUuidPrefix)) text.remove_prefix(kUuidPrefix.size());
  const auto fits = [](unsigned char c) { return std::isxdigit(c) || c == '-' || c == ':' || c == '.'; };
  return text.size() >= kShortestUuid && std::ranges::all_of(text, fits);
}

bool is_called(const GlDevice& device, std::string_view name) {
  const std::string wanted = lower_case(name), uuid = lower_case(device.uuid);
  if (!uuid.empty() && (uuid.starts_with(wanted) || uuid.starts_with(std::string(kUuidPrefix) + wanted))) return true;
  return !device.pci.empty() && lower_case(device.pci) == wanted;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  return first == text.npos ? std::string_view{} : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// True if CUDA's list applies to this device.
bool known_to_cuda(const GlDevice& device) { return device.cuda_index.has_value(); }

/// Returns the devices that the list names, in its order.
std::vector<GlDevice> cuda_listed(std::string_view list, const std::vector<GlDevice>& devices) {
  std::vector<GlDevice> listed;
  while (!list.empty()) {
    const auto comma = std::min(list.find(','), list.size());
    const std::string_view entry = trimmed(list.substr(0, comma));
    list.remove_prefix(std::min(comma + 1, list.size()));
    const std::optional<int> index = parse_index(entry);
    const auto found = std::ranges::find_if(devices, [&](const GlDevice& device) {
      return index ? device.cuda_index == index
                   : !entry.empty() && lower_case(device.uuid).starts_with(lower_case(entry));
    });
    if (found == devices.end()) break;
    listed.push_back(*found);
  }
  return listed;
}

}  // namespace

std::optional<DeviceChoice> parse_device_choice(std::string_view text) {
  DeviceChoice choice;
  if (text == "auto") return choice;
  choice.kind = DeviceChoice::Kind::software;
  if (text == "software") return choice;
  choice.kind = DeviceChoice::Kind::gpu;
  if (text == "gpu") return choice;
  constexpr std::string_view kPrefix = "gpu:";
  if (!text.starts_with(kPrefix)) return std::nullopt;
  text.remove_prefix(kPrefix.size());
  choice.index = parse_index(text);
  if (choice.index) return choice;
  if (!looks_like_a_name(text)) return std::nullopt;
  choice.name = text;
  return choice;
}

std::string to_string(const DeviceChoice& choice) {
  switch (choice.kind) {
    case DeviceChoice::Kind::automatic:
      return "auto";
    case DeviceChoice::Kind::gpu:
      if (!choice.name.empty()) return "gpu:" + choice.name;
      return choice.index ? "gpu:" + std::to_string(*choice.index) : "gpu";
    case DeviceChoice::Kind::software:
      return "software";
  }
  return {};
}

bool can_list_devices(std::string_view client_extensions) {
  const auto has = [&](std::string_view name) {
    const std::string words = ' ' + std::string(client_extensions) + ' ';
    return words.find(' ' + std::string(name) + ' ') != words.npos;
  };
  return has("EGL_EXT_platform_device") && (has("EGL_EXT_device_base") || has("EGL_EXT_device_enumeration"));
}

std::vector<GlDevice> visible_gpus(const DeviceChoice& choice, std::span<const GlDevice> devices) {
  std::vector<GlDevice> gpus;
  std::ranges::copy_if(devices, std::back_inserter(gpus), [](const GlDevice& device) { return !device.software; });
  if (!choice.cuda_visible) return gpus;
  std::vector<GlDevice> visible = cuda_listed(*choice.cuda_visible, gpus);
  std::ranges::copy_if(gpus, std::back_inserter(visible), [](const GlDevice& d) { return !known_to_cuda(d); });
  return visible;
}

std::vector<DeviceAttempt> device_attempts(const DeviceChoice& choice, std::span<const GlDevice> devices) {
  std::vector<DeviceAttempt> attempts;
  if (choice.kind != DeviceChoice::Kind::software) {
    const std::vector<GlDevice> gpus = visible_gpus(choice, devices);
    for (std::size_t n = 0; n < gpus.size(); ++n) {
      const bool any = !choice.index && choice.name.empty();
      const GlDevice& device = gpus[any ? (n + static_cast<std::size_t>(choice.worker)) % gpus.size() : n];
      const bool wanted =
          any || (choice.index ? n == static_cast<std::size_t>(*choice.index) : is_called(device, choice.name));
      if (wanted) attempts.push_back({device, true});
    }
  }
  if (choice.kind == DeviceChoice::Kind::gpu) return attempts;
  for (const GlDevice& device : devices)
    if (device.software) attempts.push_back({device, false});
  return attempts;
}

}  // namespace meniscus
