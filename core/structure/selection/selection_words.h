// SPDX-License-Identifier: BSD-3-Clause
// The words of the selection language in one table, from which the parser and the help are made, and advice on
// selections in the languages of PyMOL and ChimeraX.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace meniscus {

/// The kind of argument that follows a word.
enum class WordKind : std::uint8_t {
  flag,      ///< nothing; `which` is an AtomFlag
  text,      ///< names; `which` is an AtomField
  element,   ///< symbols of elements
  residue,   ///< residue numbers with insertion codes, ranges, or a comparison
  whole,     ///< whole numbers, ranges, or a comparison; `which` is an AtomField
  number,    ///< numbers, ranges, or a comparison; `which` is an AtomField
  distance,  ///< a distance and a set; `which` is 1 if the set itself belongs to the result
  group,     ///< a set; `which` is 0 for whole residues, 1 for whole chains, 2 for the first place
  same,      ///< "residue as" or "chain as" and a set
  operation  ///< and, or, not
};

struct SelectionWord {
  std::string_view words;  ///< separated by blanks; the first is preferred, the others mean the same
  WordKind kind;
  std::uint8_t which;
  std::string_view usage;  ///< the word with its argument, as the help shows it
  std::string_view help;
};

/// Returns all words in the order of the help.
std::span<const SelectionWord> selection_words();

/// Returns the entry of a word in upper or lower case; null if there is none.
const SelectionWord* find_selection_word(std::string_view word);

/// Returns the known word that is nearest to this one, if at most two letters differ; otherwise an empty text.
std::string_view nearest_selection_word(std::string_view word);

/// Returns the description of the whole language as text of at most 100 columns: examples, words, rules.
std::string selection_help();

/// Returns the message "'/a//A/10' is written in PyMOL's way; write 'chain A and resid 10'". The result is empty if the
/// word does not look like a selection of either program.
std::string advice_on_foreign_selection(std::string_view word);

}  // namespace meniscus
