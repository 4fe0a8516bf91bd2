// SPDX-License-Identifier: BSD-3-Clause
// Refuses what only GL can do, in builds without epoxy.
#include "app/commands/paper_bench.h"
#include "app/commands/render_command.h"
#include "core/gpu/egl_context.h"

namespace meniscus {

void render_views(const RenderCommand& command) {
  const EglContext context(command.scene.molecule.surface.gl);  // which throws
}

void print_paper_tables(const std::vector<PaperBenchMolecule>&, const PaperBenchSettings& settings) {
  const EglContext context(settings.device);  // likewise
}

}  // namespace meniscus
