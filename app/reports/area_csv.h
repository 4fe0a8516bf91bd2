// SPDX-License-Identifier: BSD-3-Clause
// Areas of atoms and residues, and derivatives by their positions, as comma-separated values.
#pragma once

#include <string>
#include <vector>

#include "core/scene/area_columns.h"
#include "core/scene/gradient_columns.h"
#include "core/structure/structure.h"

namespace meniscus {

/// A row for each atom used, in file order: index,model,chain,residue,number,icode,name,element,class,radius and the
/// columns. `index` is the place in the file, from 0; radius in Å, areas in Å². RFC 4180 with plain line feeds: text
/// with a comma or a quote stands in quotes; control characters are escaped. Each row begins with `prefix`.
std::string atom_csv_header(const std::vector<AreaColumn>& columns);
std::string atom_csv_rows(const Structure& structure, const std::vector<AreaColumn>& columns,
                          const std::string& prefix = "");

/// A row for each residue: model,chain,residue,number,icode,class,atoms and the columns, added up.
std::string residue_csv_header(const std::vector<AreaColumn>& columns);
std::string residue_csv_rows(const Structure& structure, const std::vector<AreaColumn>& columns,
                             const std::string& prefix = "");

/// A row for each atom as above, with three columns for each gradient: area_dx,area_dy,area_dz.
std::string gradient_csv_header(const std::vector<GradientColumn>& gradients);
std::string gradient_csv_rows(const Structure& structure, const std::vector<GradientColumn>& gradients,
                              const std::string& prefix = "");

/// A text as such tables have it.
std::string csv_cell(const std::string& text);

}  // namespace meniscus
