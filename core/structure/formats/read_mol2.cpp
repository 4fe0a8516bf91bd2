// SPDX-License-Identifier: BSD-3-Clause
// Reads MOL2 of Tripos (SYBYL): molecules with bonds, partial charges, and substructures, which become residues.
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iterator>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/atom_classes.h"
#include "core/structure/element_tables.h"
#include "core/structure/formats/structure_formats.h"
#include "core/structure/plausibility.h"
#include "core/structure/residues.h"

namespace meniscus {
namespace {

constexpr std::string_view kMolecule = "@<TRIPOS>MOLECULE", kAtoms = "@<TRIPOS>ATOM", kBonds = "@<TRIPOS>BOND",
                           kSubstructures = "@<TRIPOS>SUBSTRUCTURE";

bool is_lower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }

/// Types of GAFF 1.81 and 2.2.20 and of Lipid21, separated by blanks. The first letter is the element, except in cl and
/// br (docs/reference/input.md).
constexpr std::string_view kSmallTypes =
    " c c1 c2 c3 c5 c6 ca cc cd ce cf cg ch cp cq cs cu cv cx cy cz h1 h2 h3 h4 h5 ha hc hn ho hp hs hw hx f cl br i n "
    "n+ n1 n2 n3 n4 n5 n6 n7 n8 n9 na nb nc nd ne nf nh ni nj nk nl nm nn no np nq ns nt nu nv nx ny nz o oh op oq os "
    "ow p2 p3 p4 p5 pb pc pd pe pf px py s s2 s4 s6 sh sp sq ss sx sy cA cB cC cD hA hB hE hL hN hO hX nA nN oC oH oO "
    "oP oS oT pA ";
/// Types of GLYCAM06 that look like symbols of other elements. The first letter is the element.
constexpr std::string_view kGlycamTypes = " Ck Cj Cp Cy Ha Hc Ho Hp Ng Oh Os Oy Sm ", kGlycamCarbon = "Cg";

bool is_in(std::string_view types, std::string_view type) {
  return types.find(fmt::format(" {} ", type)) != std::string_view::npos;
}

/// Returns the element of a type. SYBYL's types are the symbol or begin with it: C.ar, N.am, Cl, Zn, Co.oh. Returns 0
/// for dummies (Du, LP, Any, Hal, Het, Hev) and for types of other force fields (CT, HW, CA, opls_135), which do not
/// give the element. glycam: true if the molecule has types of GLYCAM.
std::uint8_t element_of_type(std::string_view type, bool glycam) {
  if (type == "cl" || type == "br") return element_of_symbol(type);
  if (is_in(kSmallTypes, type) || (glycam && (is_in(kGlycamTypes, type) || type == kGlycamCarbon)))
    return element_of_symbol(type.substr(0, 1));
  const std::string_view stem = type.substr(0, type.find('.'));
  if (stem.empty() || stem == "Du" || (is_lower(stem[0]) && stem == type)) return 0;
  return stem.size() == 1 || (stem.size() == 2 && is_lower(stem[1])) ? element_of_symbol(stem) : std::uint8_t{0};
}

/// Data of an atom that is needed when its molecule is complete.
struct Row {
  std::size_t line = 0;
  std::int64_t substructure = 1;
  std::string substructure_name, type;
};

struct Substructure {
  std::string kind, chain;  ///< sub_type ("ALA") and chain
};

/// Returns a field, or an empty text if it is missing or consists of asterisks, which mean a blank field.
std::string text_of(const std::vector<std::string_view>& fields, std::size_t n) {
  return n < fields.size() && fields[n].find_first_not_of('*') != std::string_view::npos ? std::string(fields[n])
                                                                                         : std::string();
}

/// Sets the residue's name and number. "ALA12" is residue 12, an ALA, if the substructure is known to be an ALA or
/// number 12, or if the name begins with three letters. But "G39" is a ligand of this name.
void name_residue(Atom& atom, const std::string& name, std::int64_t substructure, const std::string& kind) {
  const std::size_t digits = name.find_last_not_of("0123456789") + 1;
  const std::string stem = name.substr(0, digits);
  std::int64_t number = 0;
  const bool ends_in_number = parse_whole_number(std::string_view(name).substr(digits), number) && number < 100'000'000;
  const bool three_letters =
      stem.size() >= 3 && std::ranges::all_of(stem, [](unsigned char c) { return std::isalpha(c) != 0; });
  const bool divided = ends_in_number && !stem.empty() && (stem == kind || three_letters || number == substructure);
  atom.residue_name = divided ? stem : name;
  // Names beginning with '<' are written by SYBYL for substructures without a name.
  if (atom.residue_name.empty() || atom.residue_name.starts_with('<')) atom.residue_name = "UNL";
  atom.residue_number = static_cast<std::int32_t>(divided ? number : substructure);
}

class Mol2Reader {
 public:
  Mol2Reader(const TextFile& file, const ModelChoice& models) : file_(file), choice_(models), lines_(file) {}

  FileContents run() {
    for (std::string_view line; lines_.next(line);) {
      const std::string_view section = trimmed(line);
      if (section == kMolecule) {
        finish_molecule();
        begin_molecule();
      } else if (contents_.models == 0) {
        continue;
      } else if (section == kAtoms) {
        read_atoms();
      } else if (section == kBonds) {
        read_bonds();
      } else if (section == kSubstructures) {
        read_substructures();
      }
    }
    finish_molecule();
    if (contents_.atoms.empty() && contents_.other_model_atoms == 0)
      throw InputError(file_.path, 0, "has no atoms after @<TRIPOS>ATOM");
    contents_.sites = classify_atoms(contents_.atoms, contents_.warnings, hints_);
    force_field_.warn(contents_.warnings, "a type that names no element; elements were guessed from the names");
    columns_.warn(contents_.warnings,
                  "a number where the name of the substructure or status bits should be; do charges have columns of "
                  "their own?");
    contents_.of_molecules = true;
    return std::move(contents_);
  }

 private:
  /// Reads the fields of the next line of this section; false at its end. Comments and blank lines are skipped.
  bool next(std::vector<std::string_view>& fields) {
    const LineReader before = lines_;
    std::string_view line;
    while (lines_.next(line)) {
      if (line.starts_with('@')) break;
      line = trimmed(line);
      if (line.empty() || line.starts_with('#')) continue;
      line_.clear();
      while (line.ends_with('\\')) {
        line_ += line.substr(0, line.size() - 1);
        if (!lines_.next(line)) line = {};
        line = trimmed(line);
      }
      line_ += line;
      fields = fields_of(line_);
      return true;
    }
    lines_ = before;
    return false;
  }

  /// Reads the header of a molecule, with one line each for name, counts, kind and charges.
  void begin_molecule() {
    std::string_view line;
    ++contents_.models;
    is_wanted_ = choice_.takes(static_cast<std::int32_t>(contents_.models));
    first_ = contents_.atoms.size();
    seen_ = counted_ = 0;
    places_.clear();
    molecule_line_ = lines_.number();
    std::vector<std::string_view> fields;
    if (!lines_.next(line) || !next(fields) || !parse_whole_number(fields[0], counted_) || counted_ < 0)
      throw lines_.error("the molecule of line {} has no name and number of atoms in the two lines after it",
                         molecule_line_);
    counted_bonds_ = -1;
    if (fields.size() > 1) parse_whole_number(fields[1], counted_bonds_);
    const bool kind = next(fields);
    has_no_charges_ = kind && next(fields) && fields[0] == "NO_CHARGES";
  }

  void read_atoms() {
    std::vector<std::string_view> fields;
    while (next(fields)) {
      ++seen_;
      if (static_cast<std::int64_t>(seen_) > counted_)
        throw lines_.error("{} is one atom more than line {} says; correct the count", in_quotes(line_),
                           molecule_line_ + 2);
      if (!is_wanted_) {
        ++contents_.other_model_atoms;
      } else {
        take_atom(fields);
      }
    }
  }

  /// Reads "id name x y z type [substructure its_name charge status]".
  void take_atom(const std::vector<std::string_view>& fields) {
    std::int64_t id = 0, substructure = 1;
    if (fields.size() < 6 || !parse_whole_number(fields[0], id))
      throw lines_.error("{} is not an atom: id name x y z type [substructure its_name charge]", in_quotes(line_));
    if (!places_.try_emplace(id, static_cast<std::uint32_t>(contents_.atoms.size())).second)
      throw lines_.error("atom {} appears twice; give each atom its own number", id);
    if (fields.size() > 6 && (!parse_whole_number(fields[6], substructure) || std::abs(substructure) > 99'999'999))
      throw lines_.error("substructure {} is not a number; columns may have run together", in_quotes(fields[6]));
    Atom atom;
    atom.model = static_cast<std::int32_t>(contents_.models);
    atom.name = fields[1];
    for (int axis = 0; axis < 3; ++axis)
      atom.position[axis] =
          parse_coordinate(file_, lines_.number(), "xyz"[axis], fields[2 + static_cast<std::size_t>(axis)]);
    double ignored = 0.0;
    if ((fields.size() == 8 && fields[7].find('.') != std::string_view::npos && parse_number(fields[7], ignored)) ||
        (fields.size() > 9 && parse_number(fields[9], ignored)))
      columns_.add(lines_.number(), line_);
    if (fields.size() > 8 && !parse_single(fields[8], atom.charge))
      throw lines_.error("charge is {}, not a finite number", in_quotes(fields[8]));
    contents_.atoms.push_back(std::move(atom));
    rows_.push_back({lines_.number(), substructure, text_of(fields, 7), std::string(fields[5])});
  }

  /// Reads lines of "id from to kind". The kind "nc" means that the atoms are not connected.
  void read_bonds() {
    std::int64_t bonds = 0;
    for (std::vector<std::string_view> fields; next(fields); ++bonds) {
      if (!is_wanted_) continue;
      if (fields.size() < 4) throw lines_.error("{} is not a bond: id, two atoms and a kind", in_quotes(line_));
      Bond bond{};
      for (std::size_t end = 0; end < 2; ++end) {
        std::int64_t id = 0;
        const auto place = parse_whole_number(fields[1 + end], id) ? places_.find(id) : places_.end();
        if (place == places_.end())
          throw lines_.error("a bond names atom {}, which molecule {} does not have", in_quotes(fields[1 + end]),
                             contents_.models);
        bond[end] = place->second;
      }
      if (fields[3] != "nc") contents_.bonds.push_back({std::min(bond[0], bond[1]), std::max(bond[0], bond[1])});
    }
    if (is_wanted_ && counted_bonds_ >= 0 && bonds < counted_bonds_)
      throw InputError(file_.path, molecule_line_ + 2, "the count says {} bonds, but {} follow; is the file cut short?",
                       counted_bonds_, bonds);
  }

  /// Reads lines of "id name root [kind dictionary chain sub_type ...]".
  void read_substructures() {
    for (std::vector<std::string_view> fields; next(fields);) {
      std::int64_t id = 0;
      if (parse_whole_number(fields[0], id)) substructures_[id] = {text_of(fields, 6), text_of(fields, 5)};
    }
  }

  void finish_molecule() {
    if (contents_.models == 0) return;
    if (static_cast<std::int64_t>(seen_) < counted_)
      throw InputError(file_.path, molecule_line_ + 2, "the count says {} atoms, but {} follow; is the file cut short?",
                       counted_, seen_);
    std::vector<Atom> atoms(std::make_move_iterator(contents_.atoms.begin() + static_cast<std::ptrdiff_t>(first_)),
                            std::make_move_iterator(contents_.atoms.end()));
    contents_.atoms.resize(first_);
    residues_.end_piece();
    const bool uncharged =
        has_no_charges_ && std::ranges::all_of(atoms, [](const Atom& a) { return !(a.charge != 0.0F); });
    const bool glycam = std::ranges::any_of(rows_, [](const Row& row) { return row.type == kGlycamCarbon; });
    for (std::size_t n = 0; n < atoms.size(); ++n) {
      const auto& [line, id, name, type] = rows_[n];
      const Substructure& substructure = substructures_[id];
      name_residue(atoms[n], name, id, substructure.kind);
      atoms[n].element = element_of_type(type, glycam);
      if (atoms[n].element == 0 && type != "LP") force_field_.add(line, type);
      // UNK is more often a molecule without a name than an unknown amino acid.
      const bool unnamed = atoms[n].residue_name == "UNK";
      hints_.push_back(
          {.residue = unnamed ? ResidueStatement::other : ResidueStatement::none, .is_site = type == "LP"});
      atoms[n].chain = atoms[n].subchain = substructure.chain;
      if (uncharged) atoms[n].charge = std::numeric_limits<float>::quiet_NaN();
      residues_.number(atoms[n]);
      contents_.atoms.push_back(std::move(atoms[n]));
    }
    if (!contents_.bonds.empty() && contents_.bonds.back()[0] >= first_)
      contents_.fully_bonded.push_back(static_cast<std::int32_t>(contents_.models));
    rows_.clear();
    substructures_.clear();
  }

  const TextFile& file_;
  const ModelChoice& choice_;
  LineReader lines_;
  FileContents contents_;
  ResidueCounter residues_{contents_.atoms};
  std::string line_;  ///< the line whose fields next() returned
  bool is_wanted_ = false, has_no_charges_ = false;
  /// First atom of this molecule in the contents, number of its atoms, its line.
  std::size_t first_ = 0, seen_ = 0, molecule_line_ = 0;
  std::int64_t counted_ = 0, counted_bonds_ = -1;           ///< numbers in its header; -1: none
  std::unordered_map<std::int64_t, std::uint32_t> places_;  ///< an atom's place in the contents by its id
  std::map<std::int64_t, Substructure> substructures_;
  std::vector<Row> rows_;  ///< one for each atom of this molecule
  std::vector<AtomHints> hints_;
  WarningCollector force_field_, columns_;
};

bool recognizes(std::string_view text) {
  const std::size_t at = text.find(kMolecule);
  return at != std::string_view::npos && (at == 0 || text[at - 1] == '\n');
}

FileContents read(const TextFile& file, const ModelChoice& models) { return Mol2Reader(file, models).run(); }

}  // namespace

const Reader kMol2Reader{{"MOL2", ".mol2", "molecules with bonds and partial charges, of Tripos (SYBYL)",
                          "Tripos Mol2 File Format, SYBYL 7.1 (2005)",
                          "MOLECULE, ATOM, BOND, SUBSTRUCTURE: positions, charges, elements by the types of SYBYL, "
                          "GAFF, Lipid21 and GLYCAM, else by the names; "
                          "substructures are residues, with their chains; each molecule is a model"},
                         recognizes,
                         read};

}  // namespace meniscus
