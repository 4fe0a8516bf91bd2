// SPDX-License-Identifier: BSD-3-Clause
// A GL 4.5 core context without any window, on a device of the user's choice.
#pragma once

#include <string>
#include <vector>

#include "core/gpu/device_choice.h"

namespace meniscus {

/// What EGL says about one device.
struct GlDevice {
  int egl_index = 0;  ///< place in EGL's own list
  bool software = false;
  int gpu_index = -1;  ///< the N of "gpu:N"; -1 for software devices
  std::string name;    ///< driver file, or EGL's extension words; only for people to read
};

/// All devices that EGL_EXT_device_enumeration offers. Throws GpuError when EGL cannot enumerate devices.
std::vector<GlDevice> list_gl_devices();

/// Owns one GL 4.5 core context, current on the thread that made it. All GL calls of the library need one current.
class EglContext {
 public:
  /// Throws GpuError when no device fits `choice` or it has no GL 4.5.
  explicit EglContext(const DeviceChoice& choice = {});
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /// Makes the context current on the calling thread. Throws GpuError.
  void make_current();

  bool is_software() const { return is_software_; }
  const std::string& vendor() const { return vendor_; }
  const std::string& renderer() const { return renderer_; }
  const std::string& version() const { return version_; }

 private:
  bool try_device(const GlDevice& device, std::string& why_not);
  bool adopt_context(void* display, void* context, std::string& why_not);

  void* display_ = nullptr;
  void* context_ = nullptr;
  bool is_software_ = false;
  std::string vendor_, renderer_, version_;
};

}  // namespace meniscus
