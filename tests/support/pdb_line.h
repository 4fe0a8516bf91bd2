// SPDX-License-Identifier: BSD-3-Clause
// Makes atom records of PDB for tests.
#pragma once

#include <string>

#include <fmt/format.h>

namespace meniscus::test {

/// The fields of one record that tests vary; text fields may hold anything of their width.
struct PdbLine {
  std::string record = "ATOM";
  std::string name = " C  ";
  char altloc = ' ';
  std::string residue = "ALA";
  char chain = 'A';
  int number = 1;
  char insertion = ' ';
  std::string x = "   0.000", y = "   0.000", z = "   0.000";
  std::string occupancy = "  1.00", b_factor = " 20.00";
  std::string element = " C";

  std::string text() const {
    return fmt::format("{:<6}    1 {:<4}{}{:>3} {}{:>4}{}   {}{}{}{}{}          {}\n", record, name, altloc, residue,
                       chain, number, insertion, x, y, z, occupancy, b_factor, element);
  }
};

}  // namespace meniscus::test
