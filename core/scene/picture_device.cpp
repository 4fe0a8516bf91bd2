// SPDX-License-Identifier: BSD-3-Clause
// Chooses between CPU and GL.
#include "core/scene/picture_device.h"

namespace meniscus {

PictureDevice::PictureDevice(const SurfaceRequest& request) {
  if (!request.cpu) context_.emplace(request.gl);
  renderer_ = context_ ? make_gl_renderer(*context_) : make_cpu_renderer();
}

}  // namespace meniscus
