// SPDX-License-Identifier: BSD-3-Clause
// Lists the words of the selection language, makes its help, and recognizes selections of PyMOL and ChimeraX.
#include "core/structure/selection/selection_words.h"

#include <algorithm>
#include <cctype>
#include <iterator>

#include "core/base/text.h"
#include "core/structure/selection/selection_steps.h"

namespace meniscus {
namespace {

constexpr std::uint8_t of(AtomFlag flag) { return static_cast<std::uint8_t>(flag); }
constexpr std::uint8_t of(AtomField field) { return static_cast<std::uint8_t>(field); }

constexpr SelectionWord kWords[] = {
    {"chain chainid segid", WordKind::text, of(AtomField::chain), "chain A B-2",
     "chains by name, with all copies; B-2: the second"},
    {"resid resi resnum", WordKind::residue, of(AtomField::residue_number), "resid 5 10-20 52A",
     "residues by number; ranges 5-10, 5:10, 5 to 10"},
    {"resname resn", WordKind::text, of(AtomField::residue_name), "resname ALA G*", "residues by name"},
    {"name", WordKind::text, of(AtomField::name), "name CA C?", "atoms by name"},
    {"element elem", WordKind::element, of(AtomField::element), "element C Zn", "atoms by element"},
    {"altloc alt", WordKind::text, of(AtomField::altloc), "altloc A", "alternate location; '' for none"},
    {"index", WordKind::whole, of(AtomField::index), "index 0 to 99", "place in the file, from 0"},
    {"serial bynum", WordKind::whole, of(AtomField::serial), "serial 1 to 100",
     "position in the file, from 1; not the file's own serial numbers"},
    {"model", WordKind::whole, of(AtomField::model), "model 1", "model of the file, from 1; files of @add@ count on"},

    {"bfactor b beta tempfactor", WordKind::number, of(AtomField::b_factor), "bfactor > 40",
     "B-factor in Å²; < <= > >= = !="},
    {"occupancy q", WordKind::number, of(AtomField::occupancy), "occupancy < 1", "occupancy"},
    {"charge", WordKind::number, of(AtomField::charge), "charge > 0.5", "partial charge in e, where the file has it"},
    {"radius", WordKind::number, of(AtomField::radius), "radius >= 1.8",
     "radius in Å; not in @select@ unless from file"},
    {"hydrophobicity", WordKind::number, of(AtomField::hydrophobicity), "hydrophobicity > 1.5",
     "hydropathy of the amino acid, -4.5 to 4.5 (Kyte & Doolittle 1982)"},
    {"x", WordKind::number, of(AtomField::x), "x > 0", "coordinate in Å"},
    {"y", WordKind::number, of(AtomField::y), "y < -5.5", "coordinate in Å"},
    {"z", WordKind::number, of(AtomField::z), "z 0 to 10", "coordinate in Å"},

    {"all", WordKind::flag, of(AtomFlag::all), "all", "every atom"},
    {"none", WordKind::flag, of(AtomFlag::none), "none", "no atom"},
    {"protein polymer.protein", WordKind::flag, of(AtomFlag::protein), "protein", "amino acids and their caps"},
    {"nucleic polymer.nucleic", WordKind::flag, of(AtomFlag::nucleic), "nucleic", "DNA and RNA"},
    {"polymer", WordKind::flag, of(AtomFlag::polymer), "polymer", "all chains of residues"},
    {"ligand", WordKind::flag, of(AtomFlag::ligand), "ligand", "everything that is not polymer, water or ion"},
    {"water waters solvent", WordKind::flag, of(AtomFlag::water), "water", "water molecules"},
    {"ion ions", WordKind::flag, of(AtomFlag::ion), "ion", "free ions: lone metal and halogen atoms"},
    {"organic", WordKind::flag, of(AtomFlag::organic), "organic", "ligands that have carbon"},
    {"inorganic", WordKind::flag, of(AtomFlag::inorganic), "inorganic", "ligands without carbon, and free ions"},
    {"glycan glycans", WordKind::flag, of(AtomFlag::glycan), "glycan",
     "sugars that have a symbol (SNFG): NAG, MAN, SIA, ..."},
    {"lipid lipids", WordKind::flag, of(AtomFlag::lipid), "lipid",
     "lipids, fatty acids and sterols, also of force fields"},
    {"hetatm hetero", WordKind::flag, of(AtomFlag::heteroatom), "hetatm",
     "all but standard residues of chains, by the wwPDB's rule"},
    {"hydrogen hydrogens hydro", WordKind::flag, of(AtomFlag::hydrogen), "hydrogen", "hydrogen and deuterium"},
    {"noh heavy", WordKind::flag, of(AtomFlag::heavy), "noh", "all but hydrogen and deuterium"},
    {"backbone bb", WordKind::flag, of(AtomFlag::backbone), "backbone",
     "N CA C O of protein; phosphate and sugar chain P to O3' of nucleic"},
    {"sidechain", WordKind::flag, of(AtomFlag::sidechain), "sidechain",
     "protein without its main chain (with its hydrogens and ends); bases of nucleic"},
    {"helix", WordKind::flag, of(AtomFlag::helix), "helix", "residues in helices: as the file says, else by DSSP"},
    {"sheet strand", WordKind::flag, of(AtomFlag::strand), "sheet",
     "residues in strands of sheets, found the same way"},
    {"coil loop", WordKind::flag, of(AtomFlag::coil), "coil", "protein residues in neither"},

    {"within expand", WordKind::distance, 1, "within 5 of (EXPR)", "at most 5 Å from an atom of EXPR; EXPR itself too"},
    {"exwithin around", WordKind::distance, 0, "exwithin 5 of (EXPR)", "the same without EXPR itself"},
    {"byres byresidue", WordKind::group, 0, "byres (EXPR)", "whole residues that have an atom in EXPR"},
    {"bychain", WordKind::group, 1, "bychain (EXPR)", "whole chains that have an atom in EXPR"},
    {"first", WordKind::group, 2, "first (EXPR)",
     "its first residue, and those of EXPR with gaps of at most 10 Å to it"},
    {"same", WordKind::same, 0, "same residue as (EXPR)", "the same as byres; 'same chain as' is bychain"},

    {"not", WordKind::operation, 0, "not EXPR", "or !; binds most tightly"},
    {"and", WordKind::operation, 0, "EXPR and EXPR", "or &"},
    {"or", WordKind::operation, 0, "EXPR or EXPR", "or |; binds least"},
};

/// Calls visit(entry, word) for each word of each entry.
template <typename Visit>
void for_each_word(Visit&& visit) {
  for (const SelectionWord& entry : kWords) {
    std::string_view rest = entry.words;
    while (!rest.empty()) {
      const std::string_view word = rest.substr(0, rest.find(' '));
      visit(entry, word);
      rest.remove_prefix(std::min(rest.size(), word.size() + 1));
    }
  }
}

constexpr std::string_view kExamples = R"(Examples:
  chain A and resid 10-50
  protein and not hydrogen
  byres (within 5 of resname ATP)
  byres all within 5 of organic
  (chain A or chain B) and bfactor < 40
  name CA CB "C1*" and not resname GLY
)";

constexpr std::string_view kRules = R"(
Rules:
  Keywords and elements may be in any case; chains and names are case-sensitive.
  Lists of values: A B C, A,B,C or A+B+C. * stands for any letters and ? for one. Quotes ("..." or
  '...') take a value literally; they are needed for a value that is also a keyword.
  Ranges of residues are ordered by number and insertion code: 52 < 52A < 53.
  After within, around, byres, bychain, first or same ... as, put EXPR in parentheses if and/or follows.
  SET within 5 of (EXPR): atoms of SET near EXPR. (EXPR) around 5 and (EXPR) expand 5 work as in PyMOL.
  Distances are exact, between the atoms of the file, without periodic images. In a run of frames
  within, first, x, y, z, helix, strand and coil are evaluated in each frame; with @select-once@
  in the first frame only.
  An atom without a value (B-factor, charge) never matches a comparison.

Water and free ions:
  Expressions see them (within 5 of water works), but the surface leaves them out even if chain A or all
  selects them, unless @keep-water@ or @keep-ions@ is given or the expression names them: water by the
  keyword or its residue name; ions by the keyword, residue name, element or atom name (a name that other
  atoms of the file also have, such as CA, does not name an ion). Then the expression decides.

Without @select@:
  The surface is that of the polymers of the file, with modified residues and bound sugars. Files without
  a polymer are taken whole. @select all@ takes ligands and lipids, too.
)";

}  // namespace

std::span<const SelectionWord> selection_words() { return kWords; }

const SelectionWord* find_selection_word(std::string_view word) {
  const std::string lower = lower_case(word);
  const SelectionWord* found = nullptr;
  for_each_word([&](const SelectionWord& entry, std::string_view known) {
    if (known == lower) found = &entry;
  });
  return found;
}

std::string_view nearest_selection_word(std::string_view word) {
  std::vector<std::string_view> known;
  for_each_word([&](const SelectionWord&, std::string_view other) { known.push_back(other); });
  return nearest_word(lower_case(word), known);
}

std::string selection_help() {
  std::string help(kExamples);
  help += "\nWords:\n";
  for (const SelectionWord& entry : kWords) {
    const std::size_t blank = entry.words.find(' ');
    std::string others;
    if (blank != std::string_view::npos) {
      others = fmt::format(" (also: {})", entry.words.substr(blank + 1));
    }
    help += fmt::format("  {:<24}{}{}\n", entry.usage, entry.help, others);
  }
  return with_options(help += kRules);
}

namespace {

/// Short words of PyMOL and the keywords of Meniscus for them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 18> kShortWords{{{"c.", "chain"},
                                                                                     {"i.", "resid"},
                                                                                     {"r.", "resname"},
                                                                                     {"n.", "name"},
                                                                                     {"e.", "element"},
                                                                                     {"s.", "chain"},
                                                                                     {"w.", "within"},
                                                                                     {"a.", "around"},
                                                                                     {"x.", "expand"},
                                                                                     {"br.", "byres"},
                                                                                     {"bc.", "bychain"},
                                                                                     {"h.", "hydrogen"},
                                                                                     {"bb.", "backbone"},
                                                                                     {"sc.", "sidechain"},
                                                                                     {"sol.", "water"},
                                                                                     {"org.", "organic"},
                                                                                     {"ino.", "inorganic"},
                                                                                     {"pol.", "polymer"}}};

/// A selection of Meniscus that is put together part by part.
class Translation {
 public:
  void add(std::string_view keyword, std::string_view value) {
    if (value.empty() || value == "*") return;
    text_ += fmt::format("{}{} {}", text_.empty() ? "" : " and ", keyword, value);
  }
  /// Adds residues by number or by name.
  void add_residues(std::string_view value) {
    const bool number = !value.empty() && (std::isdigit(static_cast<unsigned char>(value[0])) || value[0] == '-');
    add(number ? "resid" : "resname", value);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::vector<std::string_view> fields_between_slashes(std::string_view word) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t slash = word.find('/');
    fields.push_back(word.substr(0, slash));
    if (slash == std::string_view::npos) return fields;
    word.remove_prefix(slash + 1);
  }
}

/// Translates /object/segment/chain/residue/name. The first slash and parts at the left may be missing: A/10/CA.
std::string from_pymol(std::string_view word) {
  std::vector<std::string_view> fields = fields_between_slashes(word);
  if (fields.front().empty())
    fields.erase(fields.begin());
  else
    while (fields.size() < 5) fields.insert(fields.begin(), "");
  fields.resize(5);
  Translation translation;
  translation.add("chain", fields[2]);
  const std::size_t tick = fields[3].find('`');  // LYS`10 has a tick
  translation.add_residues(fields[3].substr(0, tick));
  if (tick != std::string_view::npos) translation.add_residues(fields[3].substr(tick + 1));
  translation.add("name", fields[4].substr(0, fields[4].find('`')));
  return translation.text();
}

/// Translates #structure.model/chain:residue@name, in which each part may be missing. In Chimera's :10.A the chain
/// follows the residue. The number of the structure is ignored, because it numbers the files that were opened there.
std::string from_chimerax(std::string_view word) {
  constexpr std::string_view kSigns = "#/:@";
  Translation translation;
  while (!word.empty()) {
    const char sign = word[0];
    const std::size_t end = std::min(word.find_first_of(kSigns, 1), word.size());
    const std::string_view value = word.substr(1, end - 1);
    const std::size_t dot = value.find('.');
    if (sign == '#' && dot != std::string_view::npos) translation.add("model", value.substr(dot + 1));
    if (sign == '/') translation.add("chain", value);
    if (sign == ':') {
      translation.add_residues(value.substr(0, dot));
      if (dot != std::string_view::npos) translation.add("chain", value.substr(dot + 1));
    }
    if (sign == '@') translation.add("name", value);
    word.remove_prefix(end);
  }
  return translation.text();
}

}  // namespace

std::string advice_on_foreign_selection(std::string_view word) {
  const auto found = std::ranges::find(kShortWords, word, &std::pair<std::string_view, std::string_view>::first);
  if (found != kShortWords.end()) return fmt::format("{} is PyMOL's; write {}", in_quotes(word), found->second);
  const auto slashes = std::ranges::count(word, '/');
  const bool pymol = slashes > 1 || (slashes == 1 && word[0] != '/' && word[0] != '#');
  const bool chimerax = !pymol && !word.empty() && std::string_view("#/:@").find(word[0]) != std::string_view::npos;
  if (!pymol && !chimerax) return "";
  const std::string translation = pymol ? from_pymol(word) : from_chimerax(word);
  if (translation.empty()) return "";
  return fmt::format("{} is written in {}'s way; write '{}'", in_quotes(word), pymol ? "PyMOL" : "ChimeraX",
                     shortened(translation, 200));
}

}  // namespace meniscus
