// SPDX-License-Identifier: BSD-3-Clause
// Which GL device a user asks for.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace meniscus {

/// A wish such as "auto", "gpu", "gpu:1" or "software".
struct DeviceChoice {
  enum class Kind {
    automatic,  ///< the first hardware GPU, else software GL
    gpu,        ///< hardware GPU number `index`, nothing else
    software    ///< software GL, nothing else
  };
  Kind kind = Kind::automatic;
  int index = 0;  ///< counts hardware GPUs only, from 0
};

/// Reads the words above; nothing for any other text.
std::optional<DeviceChoice> parse_device_choice(std::string_view text);

/// The inverse: "auto", "gpu:0", "software".
std::string to_string(const DeviceChoice& choice);

}  // namespace meniscus
