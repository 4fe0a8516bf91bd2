// SPDX-License-Identifier: BSD-3-Clause
// Writes the walk as models of a PDB file.
#include "tests/cli/walking_atoms.h"

#include <cmath>

#include <fmt/format.h>

namespace meniscus::test {
namespace {

std::string atom_line(int serial, const char* name, double x, double y, double z, const char* element) {
  return fmt::format("ATOM  {:>5} {:<4} ALA A   1    {:>8.3f}{:>8.3f}{:>8.3f}  1.00 10.00          {:>2}\n", serial,
                     name, x, y, z, element);
}

}  // namespace

std::string walk(int frames, int bad_frame) {
  std::string text;
  for (int frame = 0; frame < frames; ++frame) {
    const double turn = 0.3 * frame, c = std::cos(turn), s = std::sin(turn);
    text += fmt::format("MODEL     {:>4}\n", frame + 1);
    const double sites[4][3] = {{0, 0, 0}, {1.5, 0, 0}, {2.0, 1.4, 0}, {1.2, 2.4 + 0.5 * frame, 0.3}};
    const char* names[4] = {" N", " CA", " C", " O"};
    for (int n = 0; n < 4; ++n) {
      std::string line =
          atom_line(n + 1, names[n], c * sites[n][0] - s * sites[n][1] + frame, s * sites[n][0] + c * sites[n][1],
                    sites[n][2], names[n] + 1 == std::string("CA") ? "C" : names[n] + 1);
      if (frame == bad_frame && n == 2) line.replace(30, 8, "     nan");
      text += line;
    }
    text += "ENDMDL\n";
  }
  return text + "END\n";
}

ProgramResult meniscus(const std::vector<std::string>& arguments) { return run_program(meniscus_program(), arguments); }

}  // namespace meniscus::test
