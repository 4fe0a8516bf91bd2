// SPDX-License-Identifier: BSD-3-Clause
// One name for what force fields and old files name differently: residues in other charge states, renamed atoms.
#pragma once

#include <string>
#include <string_view>

namespace meniscus {

/// "HSD", "HIE" -> "HIS"; "CYX" -> "CYS"; "ADE", "RA5" -> "A"; "DA3" -> "DA"; any water -> "HOH"; others as they are.
std::string canonical_residue(const std::string& residue_name);

/// "O1P" -> "OP1", "C5*" -> "C5'", "HN" -> "H", "OT2" -> "OXT"; of ILE also "CD" -> "CD1"; others as they are. The
/// residue is given by its canonical name.
std::string canonical_atom(std::string_view residue, const std::string& atom_name);

}  // namespace meniscus
