// SPDX-License-Identifier: BSD-3-Clause
// Preloads gl_faults.h into a whole program, with the fault in MENISCUS_TEST_GL_FAULT, such as "drop_from 12".
#include <cstdlib>
#include <sstream>
#include <string>

#include "tests/gpu/gl_faults.h"

namespace {

using meniscus::testing::GlFault;

__attribute__((constructor)) void plan_what_was_asked_for() {
  const char* const text = std::getenv("MENISCUS_TEST_GL_FAULT");
  std::istringstream words(text ? text : "");
  std::string kind;
  GlFault fault;
  if (!(words >> kind >> fault.at)) std::abort();
  if (kind == "drop_from") fault.kind = GlFault::Kind::drop_from;
  if (kind == "drop_one") fault.kind = GlFault::Kind::drop_one;
  if (kind == "out_of_memory") fault.kind = GlFault::Kind::out_of_memory;
  if (kind == "idle") fault.kind = GlFault::Kind::idle;
  if (kind == "reset") fault.kind = GlFault::Kind::reset;
  if (fault.kind == GlFault::Kind::none) std::abort();
  meniscus::testing::plan(fault);
}

}  // namespace
