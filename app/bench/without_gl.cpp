// SPDX-License-Identifier: BSD-3-Clause
// Reports that frames cannot be timed, in builds without GL.
#include "app/bench/paper_bench.h"
#include "core/gpu/egl_context.h"

namespace meniscus {

void print_paper_tables(const std::vector<PaperBenchMolecule>&, const PaperBenchSettings& settings) {
  const EglContext context(settings.device);  // throws
}

}  // namespace meniscus
