// SPDX-License-Identifier: BSD-3-Clause
// The selection language: every word on a small molecule, messages with carets, laws of sets, and hostile text.
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/selection/selection.h"
#include "core/structure/selection/selection_steps.h"
#include "core/structure/selection/selection_words.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

struct AtomSketch {
  const char* name;
  const char* residue;
  const char* chain;
  int number;
  int element;
  AtomClass kind = AtomClass::polymer;
  char insertion = ' ';
};

/// Returns a peptide with an insertion, a nucleotide, a ligand, water and ions; atom n is at x = n.
std::vector<Atom> small_molecule() {
  const AtomSketch sketches[] = {
      {"N", "ALA", "A", -1, 7},
      {"CA", "ALA", "A", -1, 6},
      {"C", "ALA", "A", -1, 6},
      {"O", "ALA", "A", -1, 8},
      {"CB", "ALA", "A", -1, 6},
      {"HA", "ALA", "A", -1, 1},
      {"CA", "GLY", "A", 52, 6},
      {"CA", "GLY", "A", 52, 6, AtomClass::polymer, 'A'},
      {"CA", "SER", "A", 53, 6},
      {"P", "DA", "B", 1, 15},
      {"O5'", "DA", "B", 1, 8},
      {"C1'", "DA", "B", 1, 6},
      {"N9", "DA", "B", 1, 7},
      {"C1", "ATP", "B", 2, 6, AtomClass::ligand},
      {"O", "HOH", "W", 3, 8, AtomClass::water},
      {"CA", "CA", "B", 4, 20, AtomClass::ion},
      {"ZN", "ZN", "B", 5, 30, AtomClass::ion},
  };
  std::vector<Atom> atoms;
  for (const AtomSketch& sketch : sketches) {
    Atom& atom = atoms.emplace_back();
    atom.index = static_cast<std::uint32_t>(atoms.size() - 1);
    const bool continues = atoms.size() > 1 && atoms[atoms.size() - 2].residue_number == sketch.number &&
                           atoms[atoms.size() - 2].chain == sketch.chain &&
                           atoms[atoms.size() - 2].insertion_code == sketch.insertion;
    atom.residue = atoms.size() == 1 ? 0 : atoms[atoms.size() - 2].residue + (continues ? 0 : 1);
    atom.position = {static_cast<double>(atom.index), 0.0, 0.0};
    atom.name = sketch.name;
    atom.residue_name = sketch.residue;
    atom.chain = sketch.chain;
    atom.residue_number = sketch.number;
    atom.insertion_code = sketch.insertion;
    atom.element = static_cast<std::uint8_t>(sketch.element);
    atom.kind = sketch.kind;
    atom.b_factor = 10.0f + 0.1f * static_cast<float>(atom.index);
    atom.occupancy = 1.0f;
  }
  atoms[13].b_factor = std::numeric_limits<float>::quiet_NaN();
  atoms[8].altloc = 'B';
  return atoms;
}

/// Returns the selected places in the form "0 1 5".
std::string selected(const std::string& expression, const std::vector<Atom>& atoms = small_molecule()) {
  const std::vector<bool> set = parse_selection(expression).evaluate(atoms);
  EXPECT_EQ(set.size(), atoms.size());
  std::string places;
  for (std::size_t n = 0; n < set.size(); ++n) {
    if (set[n]) places += (places.empty() ? "" : " ") + std::to_string(n);
  }
  return places;
}

TEST(Selection, WordsMeanWhatTheHelpSays) {
  const std::pair<const char*, const char*> cases[] = {
      {"all", "0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16"},
      {"none", ""},
      {"chain W", "14"},
      {"segid W B", "9 10 11 12 13 14 15 16"},
      {"chain W+B", "9 10 11 12 13 14 15 16"},
      {"chain w", ""},
      {"CHAIN W", "14"},
      {"resid 52", "6"},
      {"resid 52A", "7"},
      {"resid 52-53", "6 7 8"},
      {"resid 52-52A", "6 7"},
      {"resid 52A-53", "7 8"},
      {"resi -1", "0 1 2 3 4 5"},
      {"resi -5--1", "0 1 2 3 4 5"},
      {"resi -5:-1", "0 1 2 3 4 5"},
      {"resid -5 to -1 53", "0 1 2 3 4 5 8"},
      {"resid 1 2,3", "9 10 11 12 13 14"},
      {"resid 1+2", "9 10 11 12 13"},
      {"resid >= 53", "8"},
      {"resid != -1 and protein", "6 7 8"},
      {"resname ALA", "0 1 2 3 4 5"},
      {"resname A*", "0 1 2 3 4 5 13"},
      {"resn ?A", "9 10 11 12 15"},
      {"resname \"A*\"", ""},
      {"name CA", "1 6 7 8 15"},
      {"name O5'", "10"},
      {"name 'O5*'", ""},
      {"name O5* C1?", "10 11"},
      {"element C", "1 2 4 6 7 8 11 13"},
      {"elem zn CA", "15 16"},
      {"altloc B", "8"},
      {"altloc '' and resid 52-53", "6 7"},
      {"index 0 to 2", "0 1 2"},
      {"serial 1:2", "0 1"},
      {"index < 2", "0 1"},
      {"model 1 and resid 53", "8"},
      {"b > 11.5", "16"},
      {"bfactor = 10.1", "1"},
      {"beta 10.1 to 10.3", "1 2 3"},
      {"occupancy == 1 and resid 53", "8"},
      {"charge = 0 or charge != 0", ""},
      {"x > 14.5", "15 16"},
      {"x>=-5&x<2", "0 1"},
      {"protein", "0 1 2 3 4 5 6 7 8"},
      {"nucleic", "9 10 11 12"},
      {"polymer and not protein", "9 10 11 12"},
      {"ligand", "13"},
      {"water", "14"},
      {"solvent|ion", "14 15 16"},
      {"hydrogen", "5"},
      {"backbone", "0 1 2 3 6 7 8 9 10"},
      {"sidechain", "4 12"},
      {"within 1 of index 3", "2 3 4"},
      {"exwithin 1 of index 3", "2 4"},
      {"around 1 (index 3)", "2 4"},
      {"within 0 of index 3", "3"},
      {"within 2.5 of not index 0 to 15", "14 15 16"},
      {"byres name CB", "0 1 2 3 4 5"},
      {"bychain resname HOH", "14"},
      {"same residue as name P", "9 10 11 12"},
      {"same chain as (name P)", "9 10 11 12 13 15 16"},
      {"byres within 1 of name CB", "0 1 2 3 4 5"},
      {"not not water", "14"},
      {"! water & chain W", ""},
      {"water or chain B and ion", "14 15 16"},
      {"(water or chain B) and ion", "15 16"},
      {"not chain A and not chain B", "14"},
      {"polymer.protein", "0 1 2 3 4 5 6 7 8"},
      {"polymer.nucleic and name P", "9"},
      {"organic", "13"},
      {"inorganic", "15 16"},
      {"hetatm", "13 14 15 16"},
      {"noh and resid -1", "0 1 2 3 4"},
      {"protein within 1 of index 3", "2 3 4"},
      {"name CA within 1.5 of name CB", ""},
      {"name CA C within 2.5 of name CB", "2 6"},
      {"(resid -1 within 1 of index 3) and name C", "2"},
      {"chain A exwithin 1 of index 3", "2 4"},
      {"byres all within 1 of name CB", "0 1 2 3 4 5"},
      {"not (all within 14 of index 0)", "15 16"},
      {"index 3 around 1", "2 4"},
      {"(index 3) expand 1", "2 3 4"},
      {"index 3 around 1 expand 1", "1 2 3 4 5"},
      {"first (index 0 4 9 16)", "0 4 9 16"},  // gaps of at most 10 A
      {"first (index 5 16)", "5"},
      {"first index 9 16", "9 16"},
      {"first none", ""},
  };
  for (const auto& [expression, expected] : cases) EXPECT_EQ(selected(expression), expected) << expression;
}

/// Returns a residue of the ligand class by its name and names of atoms, which are carbon unless they say O or P.
std::vector<Atom> residue_of(const char* residue, const std::vector<const char*>& names) {
  std::vector<Atom> atoms;
  for (const char* name : names) {
    Atom& atom = atoms.emplace_back();
    atom.name = name;
    atom.residue_name = residue;
    atom.kind = AtomClass::ligand;
    atom.element = name[0] == 'O' ? 8 : name[0] == 'P' ? 15 : 6;
    const double angle = static_cast<double>(atoms.size()) * 3.14159265358979 / 3.0;
    atom.position = {1.4 * std::cos(angle), 1.4 * std::sin(angle), 0.0};
  }
  return atoms;
}

TEST(Selection, CopiesOfAChainAreNamedTogetherOrByTheirNumber) {
  std::vector<Atom> atoms(6);
  const char* const chains[] = {"A", "B", "A-2", "B-2", "A-3", "AB-3"};
  for (std::uint32_t n = 0; n < atoms.size(); ++n) {
    atoms[n].chain = chains[n];
    atoms[n].index = n % 2;
    atoms[n].copy = n / 2;
  }
  const std::pair<const char*, const char*> cases[] = {
      {"chain A", "0 2 4"}, {"chain A-1", "0"},       {"chain A-2", "2"},      {"chain A-1 B-2", "0 3"},
      {"chain B", "1 3"},   {"not chain A", "1 3 5"}, {"chain A*", "0 2 4 5"}, {"chain A-*", "0 2 4"},
      {"chain ?-2", "2 3"}, {"chain A-4", ""}};
  for (const auto& [expression, places] : cases) EXPECT_EQ(selected(expression, atoms), places) << expression;
  for (const char* const names_some : {"chain A-2", "name CA and chain A B-1", "chain *-2"})
    EXPECT_TRUE(parse_selection(names_some).names_copies()) << names_some;
  for (const char* const names_none : {"chain A", "resid 1-2", "chain -", "name A-2"})
    EXPECT_FALSE(parse_selection(names_none).names_copies()) << names_none;
  EXPECT_EQ(parse_selection("chain C").why_none(atoms), "there is no chain 'C', only A, B, AB");
  const std::vector<Atom> of_file(atoms.begin(), atoms.begin() + 2);
  EXPECT_EQ(selected("chain A-1", of_file), "") << "there are no copies";
  EXPECT_NE(parse_selection("chain A-2").why_none(of_file).find("copies that share one surface have no names"),
            std::string::npos);
  // A selection counts in the file for all copies, and in the assembly for the named ones.
  const Selection within = parse_selection("chain A-2");
  const auto places = [&](const Selection& settled) {
    std::string text;
    const std::vector<bool> set = settled.evaluate(atoms);
    for (std::size_t n = 0; n < set.size(); ++n) text += set[n] ? std::to_string(n) : "";
    return text;
  };
  EXPECT_EQ(places(within.fixed(atoms, within.evaluate(atoms))), "2");
  EXPECT_EQ(places(within.fixed(of_file, {true, false})), "024");
}

TEST(Selection, KnowsGlycansAndLipids) {
  const std::vector<const char*> ring{"C1", "C2", "C3", "C4", "C5", "O5"};
  const std::vector<const char*> tail(12, "C1");
  const auto is = [](const char* word, const std::vector<Atom>& atoms) -> bool {
    return parse_selection(word).evaluate(atoms).front();
  };
  for (const char* name : {"NAG", "BMA", "SIA", "BGLC", "4YB", "0fA"})
    EXPECT_TRUE(is("glycan", residue_of(name, ring))) << name;
  EXPECT_FALSE(
      is("glycan", residue_of("2MA", {"C1'", "C2'", "N1", "C2", "N3", "C4"})));  // a letter of GLYCAM, no sugar
  for (const char* name : {"HEM", "ATP", "POPC"}) EXPECT_FALSE(is("glycan", residue_of(name, ring))) << name;
  for (const char* name : {"POPC", "DPPE", "CHL1", "CLR", "OLA", "PA"})
    EXPECT_TRUE(is("lipid", residue_of(name, tail))) << name;
  for (const char* name : {"NAG", "ATP", "LMT", "POPX"}) EXPECT_FALSE(is("lipid", residue_of(name, tail))) << name;
  EXPECT_FALSE(is("lipid", residue_of("PA", {"C1", "O2"})));  // The chain is too short for a tail.
  EXPECT_TRUE(is("lipids", residue_of("POPC", tail)));
}

TEST(Selection, ResiduesAreCountedByTheirRunningNumber) {
  EXPECT_EQ(selected("byres index 7"), "7");
  EXPECT_EQ(selected("byres index 6"), "6");
}

TEST(Selection, MissingValuesMeetNoComparison) {
  EXPECT_EQ(selected("index 13 and b < 100"), "");
  EXPECT_EQ(selected("index 13 and b != 100"), "");
  EXPECT_EQ(selected("index 13 and not b < 100"), "13");
}

struct Mistake {
  const char* expression;
  const char* sentence;
  std::size_t caret;
};

TEST(Selection, MistakesArePointedAt) {
  const Mistake mistakes[] = {
      {"", "the selection is empty", 0},
      {"   ", "the selection is empty", 3},
      {"chain A and protien", "did you mean 'protein'", 12},
      {"chain A protein", "is a keyword", 8},
      {"chain A (water)", "'and' or 'or' is missing", 8},
      {"chain", "a value is missing after 'chain'", 5},
      {"chain and water", "a value is missing after 'chain'", 6},
      {"chain A,", "a value is missing", 8},
      {"(chain A", "this bracket is not closed", 0},
      {"chain A)", "this bracket has no opening bracket", 7},
      {"()", "a selection is missing before ')'", 1},
      {"water and", "a selection is missing at the end", 9},
      {"water and or ion", "a selection is missing before 'or'", 10},
      {"not", "a selection is missing at the end", 3},
      {"name 'CA", "this quote is not closed", 5},
      {"resid 5x-", "is not a residue number", 9},
      {"resid 5-4", "runs backwards", 6},
      {"resid abc", "is not a residue number", 6},
      {"resid 99999999999", "is not a residue number", 6},
      {"resid 5 to", "'to' goes between", 8},
      {"index 1.5", "is not a whole number", 6},
      {"c. A", "'c.' is PyMOL's; write chain", 0},
      {"water and i. 5", "'i.' is PyMOL's; write resid", 10},
      {"/a//A/10", "'/a//A/10' is written in PyMOL's way; write 'chain A and resid 10'", 0},
      {"///A/LYS`10/CA", "write 'chain A and resname LYS and resid 10 and name CA'", 0},
      {"A/10/", "'A/10/' is written in PyMOL's way; write 'chain A and resid 10'", 0},
      {"not 10/CA", "write 'resid 10 and name CA'", 4},
      {":10-20", "':10-20' is written in ChimeraX's way; write 'resid 10-20'", 0},
      {":LIG", "write 'resname LIG'", 0},
      {":10-20.A", "write 'resid 10-20 and chain A'", 0},
      {"/A", "'/A' is written in ChimeraX's way; write 'chain A'", 0},
      {"#1/A:10@CA", "write 'chain A and resid 10 and name CA'", 0},
      {"#1.2/A", "write 'model 2 and chain A'", 0},
      {"#1", "'#1' is not a selection keyword", 0},
      {"/", "'/' is not a selection keyword", 0},
      {"index < 1.5", "is not a whole number", 8},
      {"b < nan", "is not a finite number", 4},
      {"b < inf", "is not a finite number", 4},
      {"b < 1e999", "is not a finite number", 4},
      {"b <", "a number is missing", 3},
      {"b", "a value is missing", 1},
      {"element Q", "is not an element", 8},
      {"within chain A", "is not a finite number", 7},
      {"within -1 of water", "cannot be negative", 7},
      {"within 5 of", "a selection is missing at the end", 11},
      {"same colour as water", "'residue as' or 'chain as'", 5},
      {"same residue water", "'as' is expected here", 13},
      {"byres name CA and chain A", "it is unclear where the selection of 'byres' ends", 6},
      {"within 5 of water or ion", "it is unclear where the selection of 'within' ends", 12},
      {"water\x01", "is not a selection keyword", 0},
  };
  for (const Mistake& mistake : mistakes) {
    try {
      parse_selection(mistake.expression);
      ADD_FAILURE() << "understood: " << mistake.expression;
    } catch (const SelectionError& error) {
      EXPECT_NE(error.sentence().find(mistake.sentence), std::string::npos)
          << mistake.expression << ": " << error.sentence();
      // The proposal for another program's words is understood.
      const std::string sentence = error.sentence();
      if (const std::size_t ours = sentence.find("write '"); ours != std::string::npos) {
        EXPECT_NO_THROW(parse_selection(sentence.substr(ours + 7, sentence.rfind('\'') - ours - 7))) << sentence;
      }
      const std::string picture = error.picture();
      EXPECT_EQ(picture, pointed_at(mistake.expression, mistake.caret)) << mistake.expression;
    }
  }
}

TEST(Selection, CaretsStandUnderThePlace) {
  EXPECT_EQ(pointed_at("chain A", 6), "chain A\n      ^");
  EXPECT_EQ(pointed_at("", 0), "\n^");
  EXPECT_EQ(pointed_at("ab", 2), "ab\n  ^");
  EXPECT_EQ(pointed_at("é é x", 6), "é é x\n    ^");
  EXPECT_EQ(pointed_at("a\x1b[2Jb", 5), "a\\x1b[2Jb\n        ^");
  const std::string picture = pointed_at(std::string(1000, 'a') + "B" + std::string(1000, 'c'), 1000);
  const std::size_t line_end = picture.find('\n');
  EXPECT_LT(line_end, 100u);
  EXPECT_EQ(picture[picture.size() - 1 - line_end - 1], 'B');
}

TEST(Selection, WildcardsMatchLikeGlobs) {
  const auto glob = [](const char* pattern, const char* text) { return matches({pattern, true}, text); };
  EXPECT_TRUE(glob("*", ""));
  EXPECT_TRUE(glob("a*b*c", "aXXbYc"));
  EXPECT_FALSE(glob("a*b*c", "aXXbY"));
  EXPECT_TRUE(glob("?", "x"));
  EXPECT_FALSE(glob("?", ""));
  EXPECT_FALSE(glob("?", "xy"));
  EXPECT_TRUE(glob("*x", "xxxx"));
  EXPECT_TRUE(glob("***", "abc"));
  EXPECT_FALSE(glob("abc*", "ab"));
  std::string stars;
  for (int n = 0; n < 2000; ++n) stars += "*a";
  EXPECT_FALSE(matches({stars + "b", true}, std::string(4000, 'a')));  // The match returns soon.
}

TEST(Selection, NamesWaterAndIons) {
  const auto named = [](const std::string& expression) {
    const std::vector<bool> set = parse_selection(expression).names(small_molecule());
    return std::string(set[14] ? "W" : "-") + (set[15] ? "C" : "-") + (set[16] ? "Z" : "-");
  };
  EXPECT_EQ(named("all"), "---");
  EXPECT_EQ(named("chain W B"), "---");
  EXPECT_EQ(named("water"), "W--");
  EXPECT_EQ(named("within 5 of (water or ion)"), "WCZ");
  EXPECT_EQ(named("resname HOH ZN"), "W-Z");
  EXPECT_EQ(named("resname H*"), "---");
  EXPECT_EQ(named("element Ca"), "-C-");
  EXPECT_EQ(named("element O"), "---");
  EXPECT_EQ(named("name CA ZN"), "--Z");  // The molecule has alpha carbons.
  EXPECT_EQ(named("resname CA"), "-C-");
}

TEST(Selection, KnowsWhetherItAsksForRadii) {
  EXPECT_TRUE(parse_selection("chain A and radius > 1.5").uses_radius());
  EXPECT_TRUE(parse_selection("not (radius 1 to 2)").uses_radius());
  EXPECT_FALSE(parse_selection("b > 1.5 and index 1").uses_radius());
}

TEST(Selection, HelpHasEveryWordAndItsExamplesAreUnderstood) {
  const std::string help = selection_help();
  for (const SelectionWord& entry : selection_words()) {
    EXPECT_NE(help.find(std::string(entry.usage)), std::string::npos) << entry.usage;
    EXPECT_EQ(find_selection_word(entry.words.substr(0, entry.words.find(' '))), &entry);
    std::string example(entry.usage);
    for (std::size_t place; (place = example.find("EXPR")) != std::string::npos;) example.replace(place, 4, "all");
    EXPECT_NO_THROW(parse_selection(example)) << example;
  }
  std::size_t begin = help.find('\n') + 1;  // behind "Examples:"
  for (int n = 0; n < 5; ++n) {
    const std::size_t end = help.find('\n', begin);
    EXPECT_NO_THROW(parse_selection(help.substr(begin, end - begin))) << help.substr(begin, end - begin);
    begin = end + 1;
  }
  for (std::size_t first = 0; first < help.size();) {
    const std::size_t end = help.find('\n', first);
    EXPECT_LE(end - first, 106u) << help.substr(first, end - first);
    first = end + 1;
  }
}

TEST(Selection, HostileTextIsRefusedSoon) {
  const auto refused = [](const std::string& text) {
    try {
      parse_selection(text);
      return std::string("understood");
    } catch (const SelectionError& error) {
      EXPECT_LT(std::string(error.what()).size(), 400u);
      return error.sentence();
    }
  };
  EXPECT_NE(refused(std::string(100'000, '(')).find("at most"), std::string::npos);
  EXPECT_NE(refused(std::string(60'000, '(')).find("nested more than 200"), std::string::npos);
  EXPECT_NE(refused(std::string(201, '(') + "all" + std::string(201, ')')).find("nested"), std::string::npos);
  EXPECT_NE(refused(std::string(60'000, '!') + "all").find("nested"), std::string::npos);
  std::string prefixes;
  for (int n = 0; n < 5'000; ++n) prefixes += "byres ";
  EXPECT_NE(refused(prefixes + "all").find("nested"), std::string::npos);
  EXPECT_NE(refused(std::string(std::size_t{1} << 20, 'a')).find("1,048,576 bytes"), std::string::npos);
  EXPECT_NE(refused("name " + std::string(50'000, '"') + "\"").find("not closed"), std::string::npos);
  EXPECT_NE(refused(std::string("all\0", 4)).find("is not a selection keyword"), std::string::npos);
  EXPECT_NE(refused("\xff\xfe\x80").find("is not a selection keyword"), std::string::npos);
}

TEST(Selection, LongChainsAndTheDeepestNestingWork) {
  std::string chain = "water";
  while (chain.size() < 60'000) chain += " or water";
  EXPECT_EQ(selected(chain), "14");
  EXPECT_EQ(selected(std::string(198, '(') + "water" + std::string(198, ')')), "14");
  std::string numbers = "index";
  for (int n = 5; n < 9'000; ++n) numbers += ' ' + std::to_string(n);
  EXPECT_EQ(selected(numbers), "5 6 7 8 9 10 11 12 13 14 15 16");
}

TEST(Selection, RandomBytesNeverDoMoreThanThrow) {
  std::mt19937 random(7);
  const std::vector<Atom> atoms = small_molecule();
  const std::string pieces[] = {"chain",  "A",    "resid", "5-",    "(", ")",     "and",     "or",   "not",
                                "within", "5",    "of",    "byres", "b", "<",     "1e3",     "same", "as",
                                "*",      "\"x",  "'",     ",",     "+", "water", "residue", "to",   "-3",
                                "!=",     "name", "CA",    "\x80",  "x", "0.5",   "element", "C",    "all"};
  int understood = 0;
  for (int n = 0; n < 20'000; ++n) {
    std::string text;
    for (int length = static_cast<int>(random() % 9); length >= 0; --length) {
      text += pieces[random() % std::size(pieces)];
      if (random() % 4) text += ' ';
    }
    try {
      parse_selection(text).evaluate(atoms);
      ++understood;
    } catch (const SelectionError&) {
    }
  }
  EXPECT_GT(understood, 200);
}

std::vector<Atom> random_gas(std::mt19937& random, std::size_t count) {
  std::uniform_int_distribution<int> grid(0, 40);
  std::vector<Atom> atoms(count);
  for (std::size_t n = 0; n < count; ++n) {
    Atom& atom = atoms[n];
    atom.position = {0.5 * grid(random), 0.5 * grid(random), 0.5 * grid(random)};  // The grid makes many exact ties.
    atom.index = static_cast<std::uint32_t>(n);
    atom.residue = static_cast<std::uint32_t>(n / 3);
    atom.chain = n % 2 ? "A" : "B";
    atom.element = static_cast<std::uint8_t>(6 + grid(random) % 3);
    atom.b_factor = static_cast<float>(grid(random));
  }
  return atoms;
}

TEST(SelectionLaws, WithinEqualsBruteForce) {
  std::mt19937 random(11);
  for (int round = 0; round < 60; ++round) {
    const std::vector<Atom> atoms = random_gas(random, 1 + random() % 400);
    const double distance = 0.5 * static_cast<double>(random() % 20);
    const std::vector<bool> inner = parse_selection("b < 5 and chain A").evaluate(atoms);
    const auto near = parse_selection("within " + std::to_string(distance) + " of (b < 5 and chain A)").evaluate(atoms);
    const auto shell = parse_selection("around " + std::to_string(distance) + " (b < 5 and chain A)").evaluate(atoms);
    for (std::size_t n = 0; n < atoms.size(); ++n) {
      bool expected = false;
      for (std::size_t k = 0; k < atoms.size() && !expected; ++k) {
        const glm::dvec3 d = atoms[k].position - atoms[n].position;
        expected = inner[k] && d.x * d.x + d.y * d.y + d.z * d.z <= distance * distance;
      }
      ASSERT_EQ(near[n], expected) << round << " " << n << " " << distance;
      ASSERT_EQ(shell[n], expected && !inner[n]);
    }
  }
}

TEST(SelectionLaws, TreeDecidesTiesOfLastBitsAsThePointsDo) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-10.0, 10.0);
  for (int round = 0; round < 2000; ++round) {
    std::vector<glm::dvec3> points;
    for (int n = 0; n < 30; ++n) points.emplace_back(place(random), place(random), place(random));
    const glm::dvec3 from(place(random), place(random), place(random));
    const glm::dvec3 d = points[random() % points.size()] - from;
    const double exact = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    for (const double reach : {std::nextafter(exact, 0.0), exact, std::nextafter(exact, 100.0)}) {
      bool expected = false;
      for (const glm::dvec3& point : points) {
        const glm::dvec3 e = point - from;
        expected = expected || e.x * e.x + e.y * e.y + e.z * e.z <= reach * reach;
      }
      ASSERT_EQ(PointTree(points).any_within(from, reach), expected);
    }
  }
  EXPECT_FALSE(PointTree({}).any_within({0, 0, 0}, 1e9));
  EXPECT_TRUE(PointTree(std::vector<glm::dvec3>(1000, {1, 1, 1})).any_within({1, 1, 1}, 0.0));
}

TEST(SelectionLaws, SetsObeyTheirAlgebra) {
  std::mt19937 random(3);
  const std::vector<std::string> sets = {"chain A",
                                         "b > 20",
                                         "element C",
                                         "within 3 of (b < 3)",
                                         "byres (b < 4)",
                                         "index 3-90",
                                         "exwithin 2 of (chain B and b > 30)"};
  const std::vector<Atom> atoms = random_gas(random, 300);
  const auto value = [&](const std::string& text) { return parse_selection(text).evaluate(atoms); };
  const auto subset = [](const std::vector<bool>& a, const std::vector<bool>& b) {
    for (std::size_t n = 0; n < a.size(); ++n) {
      if (a[n] && !b[n]) return false;
    }
    return true;
  };
  for (const std::string& a : sets) {
    for (const std::string& b : sets) {
      const std::string A = fmt::format("({})", a), B = fmt::format("({})", b);
      EXPECT_EQ(value("not (" + A + " and " + B + ")"), value("not " + A + " or not " + B));
      EXPECT_EQ(value("not (" + A + " or " + B + ")"), value("not " + A + " and not " + B));
      EXPECT_EQ(value(A + " and " + B), value(B + " and " + A));
      EXPECT_EQ(value(A + " or (" + A + " and " + B + ")"), value(A));
      EXPECT_TRUE(subset(value("byres (" + A + " and " + B + ")"), value("byres " + A)));
      EXPECT_TRUE(subset(value("within 2 of (" + A + " and " + B + ")"), value("within 2 of " + A)));
      EXPECT_EQ(value("within 2 of (" + A + " or " + B + ")"), value("(within 2 of " + A + ") or within 2 of " + B));
    }
    EXPECT_EQ(value("byres byres (" + a + ")"), value("byres (" + a + ")"));
    EXPECT_EQ(value("not not (" + a + ")"), value(a));
    EXPECT_TRUE(subset(value(a), value("byres (" + a + ")")));
    EXPECT_TRUE(subset(value("within 1 of (" + a + ")"), value("within 4 of (" + a + ")")));
    EXPECT_EQ(value("(exwithin 2 of (" + a + ")) or " + a), value("within 2 of (" + a + ")"));
  }
}

TEST(Selection, TextBehindItBeginsWhereItEnds) {
  for (const auto& [text, atoms, behind] : {std::tuple{"resid 17=K17=A", "resid 17", "K17=A"},
                                            {"b>=50=red", "b>=50", "red"},
                                            {"b==5=a", "b==5", "a"},
                                            {"chain A or b <= 5 = x", "chain A or b <= 5 ", " x"},
                                            {"name CA=", "name CA", ""}}) {
    const auto parted = selection_and_text(text);
    ASSERT_TRUE(parted) << text;
    EXPECT_EQ(parted->atoms.text(), parse_selection(atoms).text());
    EXPECT_EQ(parted->text, behind);
  }
  for (const char* text : {"", "=", "resid 17", "chian A=x", "b>=50"}) EXPECT_FALSE(selection_and_text(text)) << text;
}

}  // namespace
}  // namespace meniscus
