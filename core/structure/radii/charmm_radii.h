// SPDX-License-Identifier: BSD-3-Clause
// Radii of CHARMM's force fields: topologies say which type an atom has, parameters how large a type is.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/structure/radii/radii_file.h"
#include "core/base/text_file.h"

namespace meniscus {

/// Does a line with these fields begin a part of a topology or parameter file?
bool is_charmm_line(const std::vector<std::string_view>& fields);

/// Gathers topology (RESI, PRES, ATOM) and NONBONDED parameters from .rtf, .prm and .str files, after CHARMM's
/// documentation (rtop, parmfile; B. R. Brooks et al., J. Comput. Chem. 30, 1545 (2009)).
class CharmmRadii {
 public:
  /// Throws InputError with file and line.
  void read(const TextFile& file);
  bool empty() const { return files_.empty(); }
  /// Half of Rmin by residue and atom. Atoms that only patches (PRES) name belong to every residue that lacks them; the
  /// first patch counts. Throws InputError if topology or parameters are missing, or no type has parameters.
  RadiiTable table() const;

 private:
  enum class Section { topology, nonbonded, other };
  void read_atom(const TextFile& file, std::size_t line, const std::vector<std::string_view>& fields);
  void read_type(const TextFile& file, std::size_t line, const std::vector<std::string_view>& fields);

  std::string files_;                                                   // joined by ", "
  std::map<std::string, std::map<std::string, std::string>> residues_;  // residue -> atom -> type
  std::map<std::string, std::string> patch_atoms_;                      // atom -> type
  std::map<std::string, double> radii_;                                 // type -> Rmin/2
  std::string residue_;                                                 // being read; empty: a patch
  Section section_ = Section::other;
};

}  // namespace meniscus
