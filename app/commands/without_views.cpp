// SPDX-License-Identifier: BSD-3-Clause
// Reports that views need GL, in builds without epoxy.
#include "app/commands/render_command.h"
#include "core/gpu/egl_context.h"

namespace meniscus {

void render_views(const RenderCommand& command) {
  const EglContext context(command.scene.molecule.surface.gl);  // throws
}

}  // namespace meniscus
