// SPDX-License-Identifier: BSD-3-Clause
// Fixed columns: clients go by the line, by the field, or by the place in the line.
#include "app/msms/report.h"

#include <array>

#include <sys/resource.h>
#include <unistd.h>

#include <fmt/format.h>

#include "core/base/text.h"

namespace meniscus::msms {
namespace {

/// The version whose files and lines these are.
constexpr const char* kAnswersAs = "2.6.1";

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 && name.front() ? name.data() : "localhost";
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

std::string banner() {
  return fmt::format(
      "MSMS {} started on {}\n"
      "Copyright of the Meniscus developers: this is meniscus-msms " MENISCUS_VERSION
      ", which answers as MSMS does\n"
      "Compilation flags none\n",
      kAnswersAs, host());
}

std::string input_lines(const Arguments& arguments, std::size_t spheres, double smallest_radius,
                        double largest_radius) {
  return fmt::format(
      "INPUT  {} {} spheres 0 collision only, radii {:6.3f} to {:6.3f}\n"
      "PARAM  Probe_radius {:6.3f} density {:6.3f} hdensity {:6.3f}\n",
      escaped(arguments.spheres), spheres, smallest_radius, largest_radius, arguments.probe_radius, arguments.density,
      arguments.hdensity);
}

std::string component_lines(std::size_t count) {
  std::string lines;
  for (std::size_t c = 1; c < count; ++c) lines += fmt::format("    RS component {} identified\n", c);
  return lines;
}

std::string analytic_table(double probe_radius, std::span<const ReducedComponentSize> sizes) {
  std::string table =
      "ANALYTICAL SURFACE AREA :\n    Comp. probe_radius,   reent,    toric,   contact    SES       SAS\n";
  for (std::size_t c = 0; c < sizes.size(); ++c)
    table += fmt::format("{:7d} {:11.3f} {:11.3f} {:9.3f} {:9.3f} {:9.3f} {:9.3f}\n", c, probe_radius,
                         sizes[c].reentrant, sizes[c].toroidal, sizes[c].contact, sizes[c].area(), sizes[c].accessible);
  return table;
}

std::string numeric_table(double probe_radius, std::span<const ReducedComponentSize> sizes) {
  std::string table = "NUMERICAL VOLUMES AND AREA\n    Comp. probe_radius SES_volume SES_area)\n";
  double total = 0;
  for (std::size_t c = 0; c < sizes.size(); ++c) {
    table += fmt::format("{:8d} {:9.2f} {:12.3f} {:10.3f}\n", c, probe_radius, sizes[c].volume, sizes[c].area());
    total += sizes[c].volume;
  }
  return table + fmt::format("    Total ses_volume: {:9.3f}\n", total);
}

std::string ending(std::chrono::steady_clock::time_point start) {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const std::chrono::duration<double> real = std::chrono::steady_clock::now() - start;
  return fmt::format("MSMS terminated normally\nTotal Time real: {:.2f} user: {:.2f} sys: {:.2f}\n", real.count(),
                     seconds_of(used.ru_utime), seconds_of(used.ru_stime));
}

}  // namespace meniscus::msms
