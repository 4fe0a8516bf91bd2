// SPDX-License-Identifier: BSD-3-Clause
// Replaces the GL renderer of previews in builds without epoxy; it is never called, because there is no context.
#include "core/scene/renderers.h"

namespace meniscus {

std::unique_ptr<PreviewRenderer> make_gl_preview_renderer() { return nullptr; }

}  // namespace meniscus
