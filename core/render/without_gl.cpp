// SPDX-License-Identifier: BSD-3-Clause
// Replaces the GL renderer in builds without epoxy: without a context it is never called.
#include "core/render/surface_renderer.h"

namespace meniscus {

std::unique_ptr<SurfaceRenderer> make_gl_renderer(const EglContext&) { return nullptr; }

}  // namespace meniscus
