// SPDX-License-Identifier: BSD-3-Clause
// A parsed selection: tests of atoms and operations on sets, in postfix order.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace meniscus {

/// Questions that need no value.
enum class AtomFlag : std::uint8_t {
  all,
  none,
  protein,
  nucleic,
  polymer,
  ligand,
  water,
  ion,
  organic,
  inorganic,
  heteroatom,
  hydrogen,
  heavy,
  backbone,
  sidechain,
  helix,
  strand,
  coil,
  glycan,
  lipid
};

/// What of an atom is compared with values.
enum class AtomField : std::uint8_t {
  chain,
  residue_name,
  name,
  altloc,
  element,
  residue_number,
  index,
  serial,
  model,
  b_factor,
  occupancy,
  charge,
  radius,
  hydrophobicity,
  x,
  y,
  z
};

enum class Comparison : std::uint8_t { less, less_or_equal, greater, greater_or_equal, equal, not_equal };

/// A value of a text field; with wildcards, * stands for any characters and ? for one.
struct TextPattern {
  std::string text;
  bool wildcards = false;
};

struct FlagTest {
  AtomFlag flag;
};
struct TextTest {
  AtomField field;
  std::vector<TextPattern> values;
};
/// Closed ranges; elements by atomic number.
struct NumberTest {
  AtomField field;
  std::vector<std::array<double, 2>> ranges;
};
/// Closed ranges of residue number and insertion code, ordered as in 52, 52A, 52B, 53.
struct ResidueTest {
  using Id = std::pair<std::int32_t, char>;
  std::vector<std::array<Id, 2>> ranges;
};
struct CompareTest {
  AtomField field;
  Comparison comparison;
  double value;
};
/// Set operations take their operands from the top of the stack.
struct NotStep {};
struct AndStep {};
struct OrStep {};
struct WithinStep {
  double distance;    ///< Å
  bool with_the_set;  ///< are the atoms of the set itself in the result?
};
struct WholeStep {
  bool chains;  ///< whole chains, else whole residues
};

struct SelectionSteps;

/// What an expression selected once.
struct SettledTest {
  std::shared_ptr<const SelectionSteps> expression;
  std::shared_ptr<const std::set<std::pair<std::uint32_t, std::uint32_t>>> atoms;  ///< by Atom::copy and Atom::index
  bool copied;  ///< by both; else by Atom::index alone, for there were no copies
};

using SelectionStep = std::variant<FlagTest, TextTest, NumberTest, ResidueTest, CompareTest, NotStep, AndStep, OrStep,
                                   WithinStep, WholeStep, SettledTest>;

/// Evaluated one after another on a stack of sets, they leave one.
struct SelectionSteps {
  std::vector<SelectionStep> steps;

  /// Is one of these fields compared with numbers?
  bool compare(std::initializer_list<AtomField> fields) const;
};

/// Does the text match the pattern? Time is linear in practice and at worst the product of the lengths.
bool matches(const TextPattern& pattern, const std::string& text);

}  // namespace meniscus
