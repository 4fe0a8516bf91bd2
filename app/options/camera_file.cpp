// SPDX-License-Identifier: BSD-3-Clause
// Adds --save-camera, and writes its file.
#include "app/options/camera_file.h"

#include "app/options/property_options.h"
#include "core/camera/camera_json.h"

namespace meniscus {

void add_save_camera_option(CLI::App& command, std::string& path) { PropertyOptions(command).add("camera.save", path); }

void check_camera_file(const std::string& path, Existing existing) {
  if (!path.empty()) check_output(path, existing);
}

void save_camera(const std::string& path, Existing existing, const Camera& camera) {
  if (path.empty()) return;
  OutputFile file(path, existing);
  file.write(camera_json(camera));
  file.commit();
}

}  // namespace meniscus
