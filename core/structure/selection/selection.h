// SPDX-License-Identifier: BSD-3-Clause
// Sets of atoms by expression, in the words that users of PyMOL, VMD, MDAnalysis and GROMACS know.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

struct Atom;
struct SelectionSteps;

/// An expression that has been understood. Copies share it.
class Selection {
 public:
  /// One truth value an atom. A value that an atom lacks (NaN) meets no comparison. Where the atoms are of several
  /// copies of an assembly, `chain B` means all copies of it, `chain B-1` the first and `chain B-2` the second.
  /// `within` measures between atoms of this span, in Å, without periodic images, exactly: squared distance <= squared
  /// limit in double. Time is linear in atoms, n log n for `within`.
  std::vector<bool> evaluate(std::span<const Atom> atoms) const;

  /// Per atom: is it water or an ion, and does the expression speak of it? It does by the keyword of the class, by a
  /// residue name without wildcards, and of an ion also by its element or by an atom name that nothing but ions has in
  /// `atoms` (so that `name CA` does not mean calcium where there are alpha carbons).
  std::vector<bool> names(std::span<const Atom> atoms) const;

  /// For an expression that selects none of these atoms: what of it is not there, as the end of a sentence.
  std::string why_none(std::span<const Atom> atoms) const;

  /// Does it ask for radii, which not every moment knows?
  bool uses_radius() const;

  /// Does it ask where atoms are: for distances, coordinates, or what the backbone forms there? Not every file knows,
  /// and from frame to frame the answer changes.
  bool uses_positions() const;

  /// Does it tell the copies of an assembly apart, as `chain B-2` does?
  bool names_copies() const;

  /// What it may select of these atoms, wherever they are, and from which of them it measures distances.
  struct Reach {
    std::vector<bool> selected, measured;
  };
  Reach reach(std::span<const Atom> atoms) const;

  /// The same expression, which wherever atoms are means those that are `selected` of these, by Atom::index.
  Selection settled(std::span<const Atom> atoms, const std::vector<bool>& selected) const;

  const std::string& text() const { return text_; }

 private:
  friend Selection parse_selection(std::string_view text);
  friend Selection either(const Selection& a, const Selection& b);
  Selection() = default;
  std::string text_;
  std::shared_ptr<const SelectionSteps> steps_;
};

/// Understands an expression (selection_words.h lists the words). Throws SelectionError: a sentence, the expression and
/// a caret under the place. At most kLongestSelection bytes and kDeepestSelection levels of nesting.
Selection parse_selection(std::string_view text);

/// "(a) or (b)".
Selection either(const Selection& a, const Selection& b);

inline constexpr std::size_t kLongestSelection = 65'536;
inline constexpr int kDeepestSelection = 200;

/// What the atoms of a frame can be if they are not all of the file: "as many as it has without water: choose
/// --trajectory-atoms 'not water'", or that the two do not belong together.
std::string advice_on_count(std::span<const Atom> atoms, std::size_t frame_atoms);

}  // namespace meniscus
