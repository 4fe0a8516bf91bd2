// SPDX-License-Identifier: BSD-3-Clause
// Refuses what only GL can do, in builds without epoxy.
#include "app/commands/render_command.h"
#include "core/gpu/egl_context.h"

namespace meniscus {

void render_views(const RenderCommand& command) {
  const EglContext context(command.scene.molecule.surface.gl);  // which throws
}

}  // namespace meniscus
