// SPDX-License-Identifier: BSD-3-Clause
// Reads any bytes as the bundle.json of a farm, then writes the bundle and reads it again.
#include "app/farm/bundle.h"
#include "core/base/error.h"
#include "tests/fuzz/target.h"

namespace meniscus::fuzz {
namespace {

void run_bundle(std::string_view bytes) {
  static const ScratchFile file("bundle.json");
  file.write(bytes);
  try {
    const std::string text = farm::bundle_json(farm::read_bundle(file.folder()));
    file.write(text);
    require(farm::bundle_json(farm::read_bundle(file.folder())) == text, "a bundle written is read as it was");
  } catch (const InputError& error) {
    require_clear(error);
  }
}

const Registration registered_bundle{"bundle", run_bundle};

}  // namespace
}  // namespace meniscus::fuzz
