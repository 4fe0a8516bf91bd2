// SPDX-License-Identifier: BSD-3-Clause
// The bonds that CONECT records of PDB list, by the serial numbers of the atoms.
#pragma once

#include <string_view>
#include <vector>

#include "core/structure/structure.h"

namespace meniscus {

/// Gathers serial numbers and records while a file is read; the text must outlive it. Serial numbers are compared as
/// text, so every way of numbering beyond 99,999 works that gives each atom its own.
class PdbBonds {
 public:
  /// The atom record of the next atom, in the order of Atom::index.
  void add_atom(std::string_view line);
  /// A CONECT record.
  void add_record(std::string_view line) { records_.push_back(line); }

  /// Each bond once, lower atom first, ascending. Records that name no atom, or a number that several atoms bear, are
  /// passed over.
  std::vector<Bond> bonds() const;

 private:
  std::vector<std::string_view> serials_, records_;
};

}  // namespace meniscus
