// SPDX-License-Identifier: BSD-3-Clause
// A selection inside: its tokens, the tests and set operations that the parser makes of them, and the classes of atoms
// that the tests name.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace meniscus {

/// Classes of atoms that are tested without a value.
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

/// The property of an atom that is compared with values.
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

/// A value of a text field. With wildcards, `*` stands for any characters and `?` for one.
struct TextPattern {
  std::string text;
  bool has_wildcards = false;
};

struct FlagTest {
  AtomFlag flag;
};
struct TextTest {
  AtomField field;
  std::vector<TextPattern> values;
};
/// Tests whether a number is in one of these closed ranges. Elements are compared by atomic number.
struct NumberTest {
  AtomField field;
  std::vector<std::array<double, 2>> ranges;
};
/// Tests whether residue number and insertion code are in one of these closed ranges. They are ordered as in 52, 52A,
/// 52B, 53.
struct ResidueTest {
  using Id = std::pair<std::int32_t, char>;
  std::vector<std::array<Id, 2>> ranges;
};
struct CompareTest {
  AtomField field;
  Comparison comparison;
  double value;
};
/// Operations on sets, which take their operands from the top of the stack.
struct NotStep {};
struct AndStep {};
struct OrStep {};
struct WithinStep {
  double distance;    ///< Å
  bool includes_set;  ///< true if the atoms of the set itself are in the result
};
struct WholeStep {
  bool whole_chains;  ///< true for whole chains, false for whole residues
};
/// Keeps the first place of a set (first_place).
struct FirstStep {};

struct SelectionSteps;

/// Selects the atoms that an expression selected once.
struct FixedTest {
  std::shared_ptr<const SelectionSteps> expression;
  std::shared_ptr<const std::set<std::pair<std::uint32_t, std::uint32_t>>> atoms;  ///< by Atom::copy and Atom::index
  bool compares_copies;  ///< true to compare both; false for Atom::index alone, if there were no copies
};

using SelectionStep = std::variant<FlagTest, TextTest, NumberTest, ResidueTest, CompareTest, NotStep, AndStep, OrStep,
                                   WithinStep, WholeStep, FirstStep, FixedTest>;

/// The steps of an expression. They are evaluated in order on a stack of sets, and leave one set.
struct SelectionSteps {
  std::vector<SelectionStep> steps;

  /// True if one of these fields is compared with numbers.
  bool compare(std::initializer_list<AtomField> fields) const;
};

/// True if the text matches the pattern. Time is linear in practice, and at worst the product of the lengths.
bool matches(const TextPattern& pattern, const std::string& text);

struct Atom;

/// Returns for each atom whether it belongs to the class. Protein and nucleic are residues with a known name. Other
/// residues of polymers are classified by their atoms: N, CA and C make an amino acid, C4' or C4* a nucleotide.
std::vector<bool> atoms_with(AtomFlag flag, std::span<const Atom> atoms);

enum class TokenKind : std::uint8_t { end, word, quoted, open, close, comma, compare, both, either, negate };

struct Token {
  TokenKind kind = TokenKind::end;
  std::string text;          ///< without quotes
  std::size_t position = 0;  ///< byte in the expression
};

/// Returns the tokens. The last one has the kind `end`. Words may contain everything except blanks, brackets,
/// commas, double quotes and the signs < > = ! & |. A single quote opens a quoted text only at the beginning of a word,
/// so that O5' is a word. Throws SelectionError for a quote that is not closed and for control characters.
std::vector<Token> tokens_of(std::string_view text);

/// A value of a list, with its position for messages.
struct SelectionValue {
  std::string text;
  std::size_t position = 0;
  bool is_quoted = false;
};

/// Splits a word at plus signs. "CA+CB" has two values; "NA+" has one, because nothing follows the sign. A quoted text
/// is one value.
std::vector<SelectionValue> split_at_plus(const Token& token);

/// These functions parse values. They throw SelectionError with the position in `text`. whole: only integers are
/// allowed.
std::vector<TextPattern> read_patterns(const std::vector<SelectionValue>& values);
std::vector<std::array<double, 2>> read_elements(std::string_view text, const std::vector<SelectionValue>& values);
std::vector<std::array<ResidueTest::Id, 2>> read_residue_ranges(std::string_view text,
                                                                const std::vector<SelectionValue>& values);
std::vector<std::array<double, 2>> read_number_ranges(std::string_view text, const std::vector<SelectionValue>& values,
                                                      bool whole);
double read_number(std::string_view text, const SelectionValue& value, bool whole);

}  // namespace meniscus
