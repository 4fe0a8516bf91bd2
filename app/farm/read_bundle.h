// SPDX-License-Identifier: BSD-3-Clause
// The bundle of a folder.
#pragma once

#include <filesystem>

#include "app/farm/bundle.h"

namespace meniscus::farm {

/// Reads DIR/bundle.json. Throws InputError: missing, damaged, of another schema, or asking for anything that this
/// program would not have bundled (check_bundle.h).
Bundle read_bundle(const std::filesystem::path& folder);

}  // namespace meniscus::farm
