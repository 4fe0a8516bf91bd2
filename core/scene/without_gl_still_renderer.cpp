// SPDX-License-Identifier: BSD-3-Clause
// Replaces the GL renderer in builds without epoxy; it is never called, because there is no context.
#include "core/scene/renderers.h"

namespace meniscus {

std::unique_ptr<StillRenderer> make_gl_still_renderer(const EglContext&) { return nullptr; }

}  // namespace meniscus
