// SPDX-License-Identifier: BSD-3-Clause
// Reads bundle.json and checks what it asks for.
#include "app/farm/read_bundle.h"

#include <optional>
#include <string>

#include "app/farm/check_bundle.h"
#include "app/farm/inner_path.h"
#include "core/base/error.h"

namespace meniscus::farm {
namespace {

constexpr std::size_t kLargestManifest = std::size_t{64} << 20;

}  // namespace

Bundle read_bundle(const std::filesystem::path& folder) {
  const std::string path = (folder / "bundle.json").string();
  const std::optional<std::string> text = inner_text(folder, "bundle.json", kLargestManifest);
  if (!text) throw InputError(path, 0, "cannot be opened; meniscus farm bundle makes it");
  try {
    Bundle bundle = parse_bundle(*text);
    check_bundle(bundle);
    return bundle;
  } catch (const RequestError& error) {
    throw InputError(path, 0, error.what());
  }
}

}  // namespace meniscus::farm
