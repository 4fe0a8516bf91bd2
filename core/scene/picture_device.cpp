// SPDX-License-Identifier: BSD-3-Clause
// Chooses between CPU and GL for pictures.
#include "core/scene/picture_device.h"

#include "core/base/error.h"

namespace meniscus {

PictureDevice::PictureDevice(const SurfaceRequest& request) : thread_limit_(request.threads) {
  if (!request.cpu) find_gl(request.gl);
  renderer_ = context_ ? make_gl_still_renderer(*context_) : std::make_unique<StillRenderer>();
}

// The automatic choice is never software GL. A list of devices does not show which they are: only a context knows its
// renderer.
void PictureDevice::find_gl(DeviceChoice choice) {
  if (choice.kind != DeviceChoice::Kind::automatic) {
    context_.emplace(choice);
    return;
  }
  choice.kind = DeviceChoice::Kind::gpu;
  try {
    context_.emplace(choice);
  } catch (const GpuError&) {
    context_.reset();  // EGL or a GPU is missing, or has no GL 4.5
  }
}

}  // namespace meniscus
