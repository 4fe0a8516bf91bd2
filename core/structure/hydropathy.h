// SPDX-License-Identifier: BSD-3-Clause
// How residues of proteins take to water.
#pragma once

#include <string_view>

namespace meniscus {

/// Hydropathy of an amino acid, -4.5 (arginine) to 4.5 (isoleucine): J. Kyte and R. F. Doolittle, J. Mol. Biol. 157,
/// 105 (1982), table 2. Force-field names of charge states and selenomethionine go with their parent; NaN for all
/// others.
double hydropathy(std::string_view residue_name);

}  // namespace meniscus
