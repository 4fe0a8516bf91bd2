// SPDX-License-Identifier: BSD-3-Clause
// The pause of a bundle: while state/paused is there, no worker makes frames.
#pragma once

#include <filesystem>

namespace meniscus::farm {

/// Throws InputError: a link, or a folder, lies there.
bool is_paused(const std::filesystem::path& folder);

/// Nothing happens if that is so already. Throws OutputError.
void set_paused(const std::filesystem::path& folder, bool paused);

}  // namespace meniscus::farm
