// SPDX-License-Identifier: BSD-3-Clause
// Camera files.
#include "core/base/error.h"
#include "core/camera/camera_json.h"
#include "tests/fuzz/camera_checks.h"
#include "tests/fuzz/target.h"

namespace meniscus::fuzz {
namespace {

void run_camera(std::string_view bytes) {
  try {
    const Camera camera = parse_camera(bytes, "camera.json");
    check_camera(camera);
    require(same_camera(parse_camera(camera_json(camera), "again"), camera), "a camera written is read as it was");
  } catch (const InputError& error) {
    require_clear(error);
  }
}

const Registration registered_camera{"camera", run_camera};

}  // namespace
}  // namespace meniscus::fuzz
