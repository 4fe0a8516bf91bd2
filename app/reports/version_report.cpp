// SPDX-License-Identifier: BSD-3-Clause
// Queries compiler, libraries and GL for their versions.
#include "app/reports/version_report.h"

#include <cstdlib>
#include <exception>
#include <string_view>

#include <sys/utsname.h>
#if defined(__GLIBC__)
#include <gnu/libc-version.h>
#endif

#include <CLI/Version.hpp>
#include <fmt/format.h>
#include <glm/detail/setup.hpp>
#include <nlohmann/detail/abi_macros.hpp>
#include <tbb/version.h>
#include <libdeflate.h>
#include <zlib.h>

#include "app/process/program_main.h"
#include "core/base/version.h"
#include "core/gpu/egl_context.h"
#include "core/image/image_codec.h"

namespace meniscus {
namespace {

#if defined(__clang__)
constexpr const char* kCompiler = __VERSION__;
#else
constexpr const char* kCompiler = "GCC " __VERSION__;
#endif

std::string row(std::string_view what, std::string_view answer) { return fmt::format("\n{:<12}{}", what, answer); }

/// Returns the result of `ask`, or the reason why there is none.
template <class Ask>
std::string answer_of(Ask ask) {
  try {
    return ask();
  } catch (const std::exception& error) {
    return fmt::format("none: {}", error.what());
  }
}

std::string system_line() {
  utsname system{};
  ::uname(&system);
  std::string line = fmt::format("{} {} {}", system.sysname, system.release, system.machine);
#if defined(__GLIBC__)
  line += fmt::format(", glibc {}", ::gnu_get_libc_version());
#endif
  return line;
}

std::string libraries_line() {
  return fmt::format(
      "oneTBB {}, fmt {}.{}.{}, zlib {}, libdeflate {}, GLM {}.{}.{}, CLI11 {}, JSON for Modern C++ "
      "{}.{}.{}",
      TBB_runtime_version(), FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100, ::zlibVersion(),
      LIBDEFLATE_VERSION_STRING, GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH, CLI11_VERSION,
      NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH);
}

std::string gl_line() {
  DeviceChoice choice;
  if (const char* visible = std::getenv("CUDA_VISIBLE_DEVICES")) choice.cuda_visible = visible;
  const EglContext context(choice);
  return fmt::format("{}, {}; {}", context.version(), context.renderer(), context.vendor());
}

}  // namespace

std::string version_line() { return std::string("meniscus ") + build_version(); }

std::string version_report() {
  return version_line() + row("sources", build_date()) +
         row("compiler", fmt::format("{}, {}", kCompiler, MENISCUS_BUILD_TYPE)) + row("system", system_line()) +
         row("libraries", libraries_line()) + row("pictures", answer_of([] { return image_codec().library(); })) +
         row("GL", answer_of(gl_line));
}

std::string citation() {
  return fmt::format(R"(@software{{meniscus,
  title   = {{Meniscus: exact solvent-excluded surfaces of molecules}},
  author  = {{{{The Meniscus authors}}}},
  version = {{{}}},
  year    = {{2026}},
  license = {{BSD-3-Clause}}
}}

@inproceedings{{krone2010,
  title     = {{Parallel computation and interactive visualization of time-varying solvent excluded surfaces}},
  author    = {{Krone, Michael and Dachsbacher, Carsten and Ertl, Thomas}},
  booktitle = {{Proceedings of the First ACM International Conference on Bioinformatics and Computational Biology}},
  year      = {{2010}}
}})",
                     MENISCUS_VERSION);
}

}  // namespace meniscus
