// SPDX-License-Identifier: BSD-3-Clause
// The parts of a selection: its tokens, the tests and set operations that the parser makes of them, the classes of
// atoms that the tests name, and a tree of points that finds exactly, for many places, whether any point is near.
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

#include <glm/vec3.hpp>

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
/// Tests whether residue number and insertion code are in one of these closed ranges. Their order is 52, 52A, 52B, 53.
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
  std::shared_ptr<const std::set<std::pair<std::uint32_t, std::uint32_t>>> atoms;  ///< copy and index of each
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

/// A balanced tree of tight boxes (J. L. Bentley, Comm. ACM 18, 509 (1975)). Unlike with a grid, the time does not grow
/// with the distance, because boxes that are entirely within or beyond it are decided at once.
class PointTree {
 public:
  /// Builds the tree in O(n log n). Points must be finite.
  explicit PointTree(std::vector<glm::dvec3> points);

  /// True if there is a point with squared distance <= reach squared, both rounded to double. It takes O(log n) for
  /// usual sets of points.
  bool any_within(const glm::dvec3& place, double reach) const;

 private:
  struct Node {
    glm::dvec3 low, high;
    std::uint32_t first, last;    ///< range in points_
    std::uint32_t far_child = 0;  ///< 0 for a leaf; the other child follows its parent in nodes_
  };
  void build(std::uint32_t first, std::uint32_t last);

  std::vector<glm::dvec3> points_;
  std::vector<Node> nodes_;
};

}  // namespace meniscus
