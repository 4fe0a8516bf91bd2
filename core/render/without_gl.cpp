// SPDX-License-Identifier: BSD-3-Clause
// Has no renderer on GL, in builds without epoxy: there is no context to call this with.
#include "core/render/surface_renderer.h"

namespace meniscus {

std::unique_ptr<SurfaceRenderer> make_gl_renderer(const EglContext&) { return nullptr; }

}  // namespace meniscus
