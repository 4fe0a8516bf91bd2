// SPDX-License-Identifier: BSD-3-Clause
// The molecular lipophilicity potential of proteins: the preference of each atom for octanol over water, and its decay
// with distance.
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

namespace meniscus {

struct ColorScale;
struct ColorScheme;
struct Structure;
struct VolumePaint;

/// Returns the contribution of an atom of an amino acid, with its hydrogens, to log P: sums of the contributions of its
/// atom types by S. A. Wildman and G. M. Crippen, J. Chem. Inf. Comput. Sci. 39, 868 (1999), within a peptide, with
/// side chains charged as at pH 7. Equal atoms of a charged group share its contribution. 0 for hydrogens, which count
/// with the atom that they are bonded to; NaN for all others.
double lipophilicity(std::string_view residue_name, std::string_view atom_name);

/// Returns the contribution of each atom by its bonds and its position in the chain, too. At the end of a chain C has a
/// carboxylate: two oxygens without hydrogens. N is an ammonium if its hydrogens say so or, if it has none, where it is
/// the first of its chain and no other residue is bonded to it. A sulphur of cysteine with a second heavy neighbour has
/// no hydrogen.
std::vector<double> lipophilicities(const Structure& structure);

/// Returns the scale of the potential; its default range is symmetric about 0 and the same for all molecules.
ColorScale lipophilicity_scale(const ColorScheme& scheme);

/// Returns the potential of the atoms used, with its colours: at a point the sum of lipophilicity times exp(-d) over
/// all atoms at d Å (J.-L. Fauchère, P. Quarendon and L. Kaetterer, J. Mol. Graph. 6, 203 (1988)), up to 8 Å. The grid
/// around the molecule has steps of 0.5 Å, or larger ones for huge molecules. Throws InputError without amino acids.
std::shared_ptr<const VolumePaint> lipophilicity_paint(const Structure& structure, const ColorScheme& scheme);

}  // namespace meniscus
