// SPDX-License-Identifier: BSD-3-Clause
// Prints assemblies line by line, and data of the first and the last frame of a trajectory.
#include "app/reports/file_report.h"

#include <cmath>
#include <iostream>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus {

void print_assemblies(const Structure& structure) {
  if (structure.assemblies.empty()) {
    fmt::print(std::cout, "assemblies    none described\n");
    return;
  }
  fmt::print(std::cout, "\n{:<14} {:>10}  {:<24} {}\n", "assembly", "copies", "chains", "");
  for (const Assembly& assembly : structure.assemblies) {
    for (const AssemblyPart& part : assembly.parts) {
      std::string chains = part.chains.empty() ? "all" : escaped(fmt::format("{}", fmt::join(part.chains, ",")));
      if (chains.size() > 24) chains = fmt::format("{}... ({})", chains.substr(0, 14), part.chains.size());
      fmt::print(std::cout, "{:<14} {:>10}  {:<24} {}\n", escaped(assembly.id), with_thousands(part.motions.size()),
                 chains, escaped(assembly.description));
    }
  }
}

namespace {

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::acos(glm::dot(a, b) / (glm::length(a) * glm::length(b))) * 180.0 / std::numbers::pi;
}

std::string box_text(const Frame& frame) {
  if (!frame.cell) return "none in the first frame";
  const auto& [a, b, c] = std::array{(*frame.cell)[0], (*frame.cell)[1], (*frame.cell)[2]};
  return fmt::format("{:.3f} {:.3f} {:.3f} Å, {:.2f} {:.2f} {:.2f} degrees (first frame)", glm::length(a),
                     glm::length(b), glm::length(c), degrees_between(b, c), degrees_between(a, c),
                     degrees_between(a, b));
}

/// Reads a frame. A frame that cannot be read is reported, and returned without contents.
Frame read_or_warn(Trajectory& trajectory, std::uint64_t number) {
  Frame frame;
  try {
    trajectory.read(number, frame);
  } catch (const InputError& error) {
    fmt::print(std::cerr, "meniscus: warning: {}\n", escaped(error.what()));
  }
  return frame;
}

}  // namespace

void print_trajectory(Trajectory& trajectory) {
  const Frame first = read_or_warn(trajectory, 0);
  const Frame last = read_or_warn(trajectory, trajectory.frame_count() - 1);
  fmt::print(std::cout, "trajectory    {} ({})\n", escaped(trajectory.path()), trajectory.format());
  fmt::print(std::cout, "atoms         {} in each frame\n", with_thousands(trajectory.atom_count()));
  fmt::print(std::cout, "frames        {} (0 to {})\n", with_thousands(trajectory.frame_count()),
             trajectory.frame_count() - 1);
  if (first.time && last.time) {
    fmt::print(std::cout, "times         {:.3f} to {:.3f} ps\n", *first.time, *last.time);
  } else {
    fmt::print(std::cout, "times         none\n");
  }
  if (first.step && last.step) fmt::print(std::cout, "steps         {} to {}\n", *first.step, *last.step);
  fmt::print(std::cout, "box           {}\n", box_text(first));
  if (!trajectory.cut_short().empty()) fmt::print(std::cout, "cut short     {}\n", trajectory.cut_short());
  for (const Warning& warning : trajectory.warnings())
    fmt::print(std::cerr, "meniscus: warning: {}: {}\n", trajectory.path(), warning.text);
}

}  // namespace meniscus
