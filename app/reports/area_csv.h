// SPDX-License-Identifier: BSD-3-Clause
// Areas of atoms and residues as comma-separated values.
#pragma once

#include <string>
#include <vector>

#include "core/scene/area_columns.h"
#include "core/structure/structure.h"

namespace meniscus {

/// A row for each atom used, in file order: index,model,chain,residue,number,icode,name,element,class,radius and the
/// columns. `index` is the place in the file, from 0; radius in Å, areas in Å². RFC 4180 with plain line feeds: text
/// with a comma or a quote stands in quotes; control characters are escaped.
std::string atom_csv(const Structure& structure, const std::vector<AreaColumn>& columns);

/// A row for each residue: model,chain,residue,number,icode,class,atoms and the columns, added up.
std::string residue_csv(const Structure& structure, const std::vector<AreaColumn>& columns);

}  // namespace meniscus
