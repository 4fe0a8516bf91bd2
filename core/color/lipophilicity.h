// SPDX-License-Identifier: BSD-3-Clause
// The molecular lipophilicity potential of proteins: how much each atom likes octanol better than water, and how far
// that reaches.
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

/// What an atom of an amino acid, with its hydrogens, adds to log P: sums of the contributions of its atom types by
/// S. A. Wildman and G. M. Crippen, J. Chem. Inf. Comput. Sci. 39, 868 (1999), within a peptide, side chains as charged
/// as they are at pH 7. Equal atoms of a charged group share what it has. 0 for hydrogens, which count with the atom
/// that has them; NaN for all others.
double lipophilicity(std::string_view residue_name, std::string_view atom_name);

/// The same of each atom by its bonds and its place, too. At the end of a chain C has a carboxylate: two oxygens
/// without hydrogens. N is an ammonium where its hydrogens say so or, if it has none, where it is the first of its
/// chain; and where no other residue is bonded to it. A sulphur of cysteine with a second heavy neighbour has no
/// hydrogen.
std::vector<double> lipophilicities(const Structure& structure);

/// Of the potential; its default range is symmetric about 0 and the same for all molecules.
ColorScale lipophilicity_scale(const ColorScheme& scheme);

/// The potential of the atoms used, and how it is coloured: at a point the sum of lipophilicity times exp(-d) over all
/// atoms at d Å (J.-L. Fauchère, P. Quarendon and L. Kaetterer, J. Mol. Graph. 6, 203 (1988)), as far as 8 Å. On a
/// grid of 0.5 Å around the molecule, of huge ones a coarser one. Throws InputError where there are no amino acids.
std::shared_ptr<const VolumePaint> lipophilicity_paint(const Structure& structure, const ColorScheme& scheme);

}  // namespace meniscus
