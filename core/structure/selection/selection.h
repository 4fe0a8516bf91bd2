// SPDX-License-Identifier: BSD-3-Clause
// Selections: sets of atoms by expression, in the words that users of PyMOL, VMD, MDAnalysis and GROMACS know, and
// places: groups of selected residues that are far apart.
#pragma once

#include <string_view>

#include "core/structure/structure.h"

namespace meniscus {

struct Atom;
struct SelectionSteps;
struct Structure;

/// A parsed expression. Copies share its data.
class Selection {
 public:
  /// Returns one truth value for each atom. A value that is missing (NaN) satisfies no comparison. In an assembly
  /// `chain B` means all copies of the chain, `chain B-1` the first and `chain B-2` the second. `within` is exact: it
  /// compares squared distances (Å) between atoms of this span in double precision, without periodic images. Time is
  /// linear in the number of atoms, and O(n log n) for `within`.
  std::vector<bool> evaluate(std::span<const Atom> atoms) const;

  /// Returns one truth value for each of Structure::atoms. The expression sees Structure::extra_atoms, too, so that
  /// "within 4 of ligand" is valid where the ligand is only drawn in addition to the surface.
  std::vector<bool> evaluate(const Structure& structure) const;

  /// Returns for each atom whether it is water or an ion that the expression names. Water and ions are named by the
  /// keyword of their class or by a residue name without wildcards. An ion is also named by its element, or by an atom
  /// name that only ions in `atoms` have (so that `name CA` does not mean calcium if there are alpha carbons).
  std::vector<bool> names(std::span<const Atom> atoms) const;

  /// Returns why an expression selects none of these atoms, as the end of a sentence.
  std::string why_none(std::span<const Atom> atoms) const;

  /// True if the expression uses radii, which are not always known yet.
  bool uses_radius() const;

  /// True if the expression uses positions, for distances, coordinates or secondary structure. Some files have no
  /// positions, and in a trajectory the selected atoms may differ from frame to frame.
  bool uses_positions() const;

  /// True if the expression distinguishes copies of an assembly, as `chain B-2` does.
  bool names_copies() const;

  /// The atoms that an expression may select at any positions, and the atoms from which it measures distances.
  struct PossibleAtoms {
    std::vector<bool> selected, measured;
  };
  PossibleAtoms possible(std::span<const Atom> atoms) const;

  /// Returns this expression with a fixed result: at any positions it selects the atoms that are `selected` here, by
  /// Atom::index.
  Selection fixed(std::span<const Atom> atoms, const std::vector<bool>& selected) const;

  const std::string& text() const { return text_; }

 private:
  friend Selection parse_selection(std::string_view text);
  friend Selection either(const Selection& a, const Selection& b);
  Selection() = default;
  std::string text_;
  std::shared_ptr<const SelectionSteps> steps_;
};

/// Parses an expression (selection_words.h lists the words). It may have at most kLongestSelection bytes and
/// kDeepestSelection levels of nesting. Throws SelectionError.
Selection parse_selection(std::string_view text);

/// Returns the expression "(a) or (b)".
Selection either(const Selection& a, const Selection& b);

/// The greatest number of bytes, and of levels of nesting, in an expression.
inline constexpr std::size_t kLongestSelection = 65'536;
inline constexpr int kDeepestSelection = 200;

/// Returns advice for a trajectory whose frames have another number of atoms than the file. It is either "as many as it
/// has without water: choose --trajectory-atoms 'not water'", or that the two do not belong together.
std::string advice_on_count(std::span<const Atom> atoms, std::size_t frame_atoms);

/// A selection and the text that follows it.
struct SelectionAndText {
  Selection atoms;
  std::string_view text;  ///< everything after the equal sign
};

/// Splits the text at the first "=" with a complete selection before it. "resid 17=K17=A" has the text "K17=A", and
/// "bfactor>=50=red" has the text "red". Returns nothing if there is no such sign.
std::optional<SelectionAndText> selection_and_text(std::string_view text);

/// The widest gap between two residues of one place, Å. Pockets are about as wide.
inline constexpr double kWidestGap = 10.0;

/// Returns the selected atoms of the first residue in the order of the file, and of the residues that gaps of at most
/// kWidestGap between selected atoms join to it.
std::vector<bool> first_place(std::span<const Atom> atoms, const std::vector<bool>& selected);

}  // namespace meniscus
