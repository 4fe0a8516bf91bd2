// SPDX-License-Identifier: BSD-3-Clause
// Camera paths: every camera between the keys can be used.
#include "core/base/error.h"
#include "core/camera/camera.h"
#include "core/camera/camera_json.h"
#include "tests/fuzz/camera_checks.h"
#include "tests/fuzz/target.h"

namespace meniscus::fuzz {
namespace {

void run_camera_path(std::string_view bytes) {
  try {
    const CameraPath path = parse_camera_path(bytes, "path.json");
    for (const double frame : {-1.0, 0.0, 0.25, 1.0, 7.5, 10.0, 33.3, 1e6}) check_camera(path.at(frame));
  } catch (const InputError& error) {
    require_clear(error);
  }
}

const Registration registered_camera_path{"camera_path", run_camera_path};

}  // namespace
}  // namespace meniscus::fuzz
