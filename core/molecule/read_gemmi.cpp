// SPDX-License-Identifier: BSD-3-Clause
// Reads PDB and mmCIF through gemmi; the only file that includes its readers, which take long to compile.
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <gemmi/cif.hpp>
#include <gemmi/numb.hpp>
#include <gemmi/pdb.hpp>
#include <gemmi/resinfo.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/molecule/pdb_text.h"
#include "core/molecule/reader.h"

namespace meniscus {
namespace {

/// Water by the names of the wwPDB and of molecular dynamics programs.
bool is_water_name(const std::string& name) {
  static const std::set<std::string> kWaters{"HOH", "DOD",  "WAT",  "H2O",  "OH2",  "SOL",   "TIP",
                                             "TP3", "TIP2", "TIP3", "TIP4", "TIP5", "T3P",   "T4P",
                                             "T5P", "SPC",  "SPCE", "HHO",  "OHH",  "TIP3P", "TIP4P"};
  return kWaters.contains(name);
}

/// Amino acids and nucleotides; names of force fields (HSD, CYX, DA5, ...) are found by their backbone instead.
bool is_polymer_name(const std::string& name) {
  const gemmi::ResidueInfo residue = gemmi::find_tabulated_residue(name);
  return residue.is_amino_acid() || residue.is_nucleic_acid();
}

/// Elements that stand alone in a file as ions: metals and halogens.
bool is_ion_element(gemmi::Element element) {
  switch (element.elem) {
    case gemmi::El::F:
    case gemmi::El::Cl:
    case gemmi::El::Br:
    case gemmi::El::I:
      return true;
    default:
      return element.elem != gemmi::El::X && gemmi::is_metal(element.elem);
  }
}

/// What the file itself says about a residue.
enum class Entity { unknown, polymer, other };

/// The class of one residue from its name, its file's statement, and its atoms (`names`: distinct atom names).
AtomClass classify(const std::string& residue_name, Entity entity, gemmi::Element first_element,
                   const std::set<std::string>& names) {
  if (is_water_name(residue_name)) return AtomClass::water;
  const bool polymer_name = is_polymer_name(residue_name);
  if (names.size() == 1 && !polymer_name && is_ion_element(first_element)) return AtomClass::ion;
  if (entity == Entity::polymer) return AtomClass::polymer;
  if (entity == Entity::other) return AtomClass::ligand;
  const bool peptide = names.contains("N") && names.contains("CA") && names.contains("C");
  const bool nucleotide = names.contains("C4'") || names.contains("C4*");
  return polymer_name || peptide || nucleotide ? AtomClass::polymer : AtomClass::ligand;
}

bool is_of_organic_residues(gemmi::Element element) {
  switch (element.elem) {
    case gemmi::El::C:
    case gemmi::El::N:
    case gemmi::El::O:
    case gemmi::El::S:
    case gemmi::El::P:
    case gemmi::El::Se:
      return true;
    default:
      return element.is_hydrogen();
  }
}

/// CA, CB, CG, CD, CE, CZ, NE1, OG, SG, HG21, ...: an element and a Greek letter, as in amino acids only.
bool is_amino_acid_atom_name(std::string_view name) {
  return name.size() >= 2 && std::string_view("CNOSH").find(name[0]) != std::string_view::npos &&
         std::string_view("ABGDEZH").find(name[1]) != std::string_view::npos &&
         name.find_first_not_of("0123456789", 2) == std::string_view::npos;
}

/// Where the element column is missing or shifted, names are ambiguous: CA is carbon and HG hydrogen in residues that
/// hold only H C N O S P (Se), force-field variants of amino acids (HIE, CYX) included. Elsewhere an unknown element is
/// guessed from the first letter of the name, except D, which is more often a dummy than deuterium.
gemmi::Element element_of(gemmi::Element given, const std::string& atom_name, const std::string& residue_name,
                          AtomClass kind) {
  const std::size_t letter = atom_name.find_first_not_of("0123456789");
  if (letter == std::string::npos || is_of_organic_residues(given)) return given;
  const gemmi::Element guess(atom_name.substr(letter, 1));
  const gemmi::ResidueInfo residue = gemmi::find_tabulated_residue(residue_name);
  const bool standard =
      residue.found() && residue.is_standard() && (residue.is_amino_acid() || residue.is_nucleic_acid());
  const bool variant = !residue.found() && kind == AtomClass::polymer && is_amino_acid_atom_name(atom_name);
  if (standard || variant) return guess;
  return given == gemmi::El::X && guess != gemmi::El::D ? guess : given;
}

FileContents read_pdb(const TextFile& file) {
  CheckedPdb checked = check_pdb(file);
  gemmi::Structure structure;
  try {
    structure = gemmi::read_pdb_from_memory(checked.text.data(), checked.text.size(), file.path);
  } catch (const std::exception& error) {
    throw InputError(file.path, 0, std::string("is no readable PDB file: ") + escaped(error.what()));
  }
  FileContents contents;
  contents.models = checked.models;
  contents.other_model_atoms = checked.other_model_atoms;
  contents.warnings = std::move(checked.warnings);
  std::uint32_t residue_index = 0;
  for (const gemmi::Chain& chain : structure.models.at(0).chains) {
    const gemmi::Residue* previous = nullptr;
    for (const gemmi::Residue& residue : chain.residues) {
      // Residues of one number but several names are alternatives at one place (microheterogeneity).
      if (previous && previous->seqid != residue.seqid) ++residue_index;
      previous = &residue;
      std::set<std::string> names;
      for (const gemmi::Atom& atom : residue.atoms) names.insert(atom.name);
      // TER marks what precedes it as polymer, yet some programs write one TER at the very end; so only HETATM behind
      // a TER is a statement.
      const Entity entity = residue.entity_type == gemmi::EntityType::NonPolymer && residue.het_flag == 'H'
                                ? Entity::other
                                : Entity::unknown;
      const AtomClass kind = classify(residue.name, entity, residue.atoms.front().element, names);
      for (const gemmi::Atom& atom : residue.atoms) {
        Atom& out = contents.atoms.emplace_back();
        out.index = static_cast<std::uint32_t>(contents.atoms.size() - 1);
        out.residue = residue_index;
        out.altloc = atom.altloc == '\0' ? ' ' : atom.altloc;
        out.position = {atom.pos.x, atom.pos.y, atom.pos.z};
        out.element =
            static_cast<std::uint8_t>(element_of(atom.element, atom.name, residue.name, kind).atomic_number());
        out.kind = kind;
        out.residue_number = residue.seqid.num.value;
        out.insertion_code = residue.seqid.icode;
        out.occupancy = atom.occ;
        out.b_factor = atom.b_iso;
        out.name = atom.name;
        out.residue_name = residue.name;
        out.chain = chain.name.empty() ? residue.segment : chain.name;
      }
    }
    ++residue_index;
  }
  return contents;
}

namespace cif = gemmi::cif;

/// Columns of _atom_site, in the order AtomTable asks for them; '?' marks what may be missing.
enum Column {
  kX,
  kY,
  kZ,
  kSymbol,
  kAuthAtom,
  kLabelAtom,
  kAuthComp,
  kLabelComp,
  kAuthAsym,
  kLabelAsym,
  kAuthSeq,
  kLabelSeq,
  kInsertion,
  kAlt,
  kOccupancy,
  kB,
  kModel,
  kEntityId
};
const std::vector<std::string> kColumns{"Cartn_x",
                                        "Cartn_y",
                                        "Cartn_z",
                                        "?type_symbol",
                                        "?auth_atom_id",
                                        "?label_atom_id",
                                        "?auth_comp_id",
                                        "?label_comp_id",
                                        "?auth_asym_id",
                                        "?label_asym_id",
                                        "?auth_seq_id",
                                        "?label_seq_id",
                                        "?pdbx_PDB_ins_code",
                                        "?label_alt_id",
                                        "?occupancy",
                                        "?B_iso_or_equiv",
                                        "?pdbx_PDB_model_num",
                                        "?label_entity_id"};

/// gemmi's parser says "name:line:column(byte): what"; we pass "cif" as the name.
[[noreturn]] void rethrow_parse_error(const TextFile& file, const std::string& message) {
  std::size_t line = 0;
  std::string what = message;
  if (message.starts_with("cif:")) {
    line = std::strtoul(message.c_str() + 4, nullptr, 10);
    what = message.substr(std::min(message.size(), message.find(": ") + 2));
  }
  throw InputError(file.path, line, "is no readable mmCIF file: " + escaped(what));
}

/// The line of a row of _atom_site; rows are one line each in all but hand-made files, otherwise the loop's first line.
std::size_t line_of_row(const TextFile& file, const cif::Table& table, int row, const std::string& value) {
  if (!table.loop_item) return 0;
  const auto loop_line = static_cast<std::size_t>(table.loop_item->line_number);
  std::size_t begin = 0;
  std::size_t line = 1;
  int rows_seen = -1;
  while (begin < file.text.size()) {
    const std::size_t end = std::min(file.text.find('\n', begin), file.text.size());
    const std::string_view text(file.text.data() + begin, end - begin);
    const bool value_line =
        line > loop_line && !text.empty() && text[0] != '_' && text[0] != '#' && !text.starts_with("loop_");
    if (value_line && ++rows_seen == row) return text.find(value) != std::string_view::npos ? line : loop_line;
    begin = end + 1;
    ++line;
  }
  return loop_line;
}

/// Strips the standard uncertainty of "1.234(5)".
std::string_view without_uncertainty(const std::string& value) {
  return std::string_view(value).substr(0, value.find('('));
}

cif::Table atom_table(const TextFile& file, cif::Document& document, std::vector<std::string>& warnings) {
  std::vector<cif::Table> tables;
  for (cif::Block& block : document.blocks) {
    cif::Table table = block.find("_atom_site.", kColumns);
    if (table.ok() && table.length() > 0) tables.push_back(table);
  }
  if (tables.size() > 1) warnings.push_back(fmt::format("{} data blocks hold atoms; the first is used", tables.size()));
  if (!tables.empty()) return tables.front();
  for (cif::Block& block : document.blocks) {
    for (const char* tag : {"_atom_site_fract_x", "_atom_site.fract_x"}) {
      if (block.has_tag(tag)) {
        throw InputError(
            file.path, 0,
            "is a small-molecule CIF with fractional coordinates; convert it to Cartesian coordinates first");
      }
    }
  }
  throw InputError(file.path, 0, "has no table _atom_site with Cartn_x, Cartn_y, Cartn_z: no atoms");
}

/// Gives residues of (chain, number, insertion code) running numbers and brings their atoms together.
class ResidueNumbers {
 public:
  std::uint32_t of(const Atom& atom) {
    auto [found, added] =
        numbers_.try_emplace(fmt::format("{}\n{}\n{}", atom.chain, atom.residue_number, atom.insertion_code),
                             static_cast<std::uint32_t>(numbers_.size()));
    return found->second;
  }

 private:
  std::unordered_map<std::string, std::uint32_t> numbers_;
};

/// gemmi's as_char() throws a bare runtime_error for longer texts, which the dictionary allows.
char first_letter(const std::string& value) {
  const std::string text = cif::as_string(value);
  return text.empty() ? ' ' : text.front();
}

Atom read_row(const TextFile& file, const cif::Table& table, const cif::Table::Row& row) {
  Atom atom;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string& value = row[static_cast<std::size_t>(axis)];
    double number = 0.0;
    if (parse_number(without_uncertainty(value), number) && std::abs(number) <= kLargestCoordinate) {
      atom.position[axis] = number;
    } else {
      parse_coordinate(file, line_of_row(file, table, row.row_index, value), "xyz"[axis], value);
    }
  }
  const auto text = [&](Column first, Column second) { return cif::as_string(row.one_of(first, second)); };
  atom.name = text(kAuthAtom, kLabelAtom);
  atom.residue_name = text(kAuthComp, kLabelComp);
  atom.chain = text(kAuthAsym, kLabelAsym);
  atom.residue_number = gemmi::string_to_int(row.one_of(kAuthSeq, kLabelSeq), false);
  if (row.has2(kInsertion)) atom.insertion_code = first_letter(row[kInsertion]);
  if (row.has2(kAlt)) atom.altloc = first_letter(row[kAlt]);
  if (row.has2(kOccupancy)) atom.occupancy = static_cast<float>(cif::as_number(row[kOccupancy]));
  if (row.has2(kB)) atom.b_factor = static_cast<float>(cif::as_number(row[kB]));
  const gemmi::Element symbol(row.has2(kSymbol) ? cif::as_string(row[kSymbol]) : std::string());
  atom.element = static_cast<std::uint8_t>(element_of(symbol, atom.name, atom.residue_name, atom.kind).atomic_number());
  return atom;
}

std::map<std::string, Entity> entities_of(cif::Document& document) {
  std::map<std::string, Entity> entities;
  for (cif::Block& block : document.blocks) {
    for (const auto row : block.find("_entity.", {"id", "type"})) {
      entities[row.str(0)] = row.str(1) == "polymer" ? Entity::polymer : Entity::other;
    }
  }
  return entities;
}

/// Classifies the atoms of each (residue, residue name), which `entity` says something about.
void classify_residues(FileContents& contents, const std::vector<Entity>& entity) {
  std::size_t first = 0;
  while (first < contents.atoms.size()) {
    std::size_t last = first;
    std::set<std::string> names;
    const Atom& head = contents.atoms[first];
    while (last < contents.atoms.size() && contents.atoms[last].residue == head.residue &&
           contents.atoms[last].residue_name == head.residue_name) {
      names.insert(contents.atoms[last++].name);
    }
    const AtomClass kind = classify(head.residue_name, entity[first], gemmi::Element(int{head.element}), names);
    for (; first < last; ++first) contents.atoms[first].kind = kind;
  }
}

FileContents read_mmcif(const TextFile& file) {
  cif::Document document;
  try {
    document = cif::read_memory(file.text.data(), file.text.size(), "cif");
  } catch (const std::exception& error) {
    rethrow_parse_error(file, error.what());
  }
  FileContents contents;
  cif::Table table = atom_table(file, document, contents.warnings);
  const std::map<std::string, Entity> entities = entities_of(document);
  ResidueNumbers residues;
  std::set<std::string> models;
  std::vector<Entity> entity;
  for (const cif::Table::Row row : table) {
    const std::string model = row.has(kModel) ? row[kModel] : "1";
    if (models.insert(model).second && models.size() > 1) ++contents.models;
    if (contents.models > 1 && model != table[0][kModel]) {
      ++contents.other_model_atoms;
      continue;
    }
    Atom atom = read_row(file, table, row);
    atom.index = static_cast<std::uint32_t>(contents.atoms.size());
    atom.residue = residues.of(atom);
    const auto statement = entities.find(row.has2(kEntityId) ? cif::as_string(row[kEntityId]) : std::string());
    entity.push_back(statement == entities.end() ? Entity::unknown : statement->second);
    contents.atoms.push_back(std::move(atom));
  }
  classify_residues(contents, entity);
  return contents;
}

bool is_mmcif(std::string_view text) {
  std::size_t first = text.find_first_not_of(" \t\n");
  while (first != std::string_view::npos && text[first] == '#') {
    first = text.find('\n', first);
    if (first != std::string_view::npos) first = text.find_first_not_of(" \t\n", first);
  }
  if (first == std::string_view::npos || text.size() < first + 5) return false;
  const std::string_view head = text.substr(first, 5);
  return head == "data_" || head == "DATA_" || head == "Data_";
}

}  // namespace

const Reader kPdbReader{{"PDB", ".pdb .ent .pdb.gz", "Protein Data Bank format, fixed columns",
                         "wwPDB file format 3.3; hybrid-36 by R. W. Grosse-Kunstleve",
                         "ATOM, HETATM, TER, MODEL, ENDMDL, END; serial numbers are ignored"},
                        looks_like_pdb,
                        read_pdb};

const Reader kMmcifReader{
    {"mmCIF", ".cif .mmcif .cif.gz", "macromolecular CIF of the wwPDB",
     "PDBx/mmCIF dictionary; Hall, Allen & Brown 1991", "_atom_site (author names where given) and _entity"},
    is_mmcif,
    read_mmcif};

}  // namespace meniscus
