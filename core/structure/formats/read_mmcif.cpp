// SPDX-License-Identifier: BSD-3-Clause
// Reads the atom table of mmCIF, as text or as BinaryCIF.

#include <algorithm>
#include <charconv>
#include <cmath>

#include <gemmi/elem.hpp>
#include <gemmi/numb.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/atom_classes.h"
#include "core/structure/assembly.h"
#include "core/structure/formats/cif_document.h"
#include "core/structure/formats/structure_formats.h"
#include "core/structure/plausibility.h"
#include "core/structure/residues.h"
#include "core/structure/secondary_structure.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

namespace cif = gemmi::cif;

/// The columns of _atom_site in the order of kColumns, where '?' marks columns that may be missing.
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
  kEntityId,
  kGroup,
  kCharge,
  kSegment
};
std::vector<std::string> column_names(std::string_view text) {
  const std::vector<std::string_view> names = fields_of(text);
  return {names.begin(), names.end()};
}

const std::vector<std::string> kColumns = column_names(
    "Cartn_x Cartn_y Cartn_z ?type_symbol ?auth_atom_id ?label_atom_id ?auth_comp_id ?label_comp_id ?auth_asym_id "
    "?label_asym_id ?auth_seq_id ?label_seq_id ?pdbx_PDB_ins_code ?label_alt_id ?occupancy ?B_iso_or_equiv "
    "?pdbx_PDB_model_num ?label_entity_id ?group_PDB ?charge ?auth_segid");

/// Returns the line of a row of _atom_site. In nearly all files a row is one line; otherwise the first line of the loop
/// is returned.
std::size_t line_of_row(const TextFile& file, const cif::Table& table, std::size_t row, const std::string& value) {
  if (!table.loop_item || table.loop_item->line_number < 0) return 0;  // BinaryCIF has no lines
  const auto loop_line = static_cast<std::size_t>(table.loop_item->line_number);
  std::size_t begin = 0;
  std::size_t line = 1;
  std::size_t rows_seen = 0;
  while (begin < file.text.size()) {
    const std::size_t end = std::min(file.text.find('\n', begin), file.text.size());
    const std::string_view text(file.text.data() + begin, end - begin);
    const bool value_line =
        line > loop_line && !text.empty() && text[0] != '_' && text[0] != '#' && !text.starts_with("loop_");
    if (value_line && rows_seen++ == row) return text.find(value) != std::string_view::npos ? line : loop_line;
    begin = end + 1;
    ++line;
  }
  return loop_line;
}

/// Returns a number such as "1.234(5)" without its standard uncertainty.
std::string_view without_uncertainty(const std::string& value) {
  return std::string_view(value).substr(0, value.find('('));
}

/// Throws InputError with the reason why a file has no atoms.
[[noreturn]] void refuse_without_atoms(const TextFile& file, const cif::Document& document) {
  for (const cif::Block& block : document.blocks) {
    for (const char* tag : {"_atom_site_fract_x", "_atom_site.fract_x"}) {
      if (block.has_tag(tag))
        throw InputError(
            file.path, 0,
            "is a small-molecule CIF with fractional coordinates; convert it to Cartesian coordinates first");
    }
  }
  throw InputError(file.path, 0, "has no table _atom_site with Cartn_x, Cartn_y, Cartn_z: no atoms");
}

/// Returns the first letter of a value. gemmi's as_char() is not used, because it throws a bare runtime_error for
/// longer texts, which the dictionary allows.
char first_letter(const std::string& value) {
  const std::string text = cif::as_string(value);
  return text.empty() ? ' ' : text.front();
}

/// Returns the number at the beginning of the text; 0 if there is none.
std::int32_t residue_number(const TextFile& file, const cif::Table& table, std::size_t number_of_row,
                            const cif::Table::Row& row) {
  const std::string& value = row.one_of(kAuthSeq, kLabelSeq);
  std::string_view digits = trimmed(value);
  if (digits.starts_with('+')) digits.remove_prefix(1);
  std::int32_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error == std::errc::result_out_of_range)
    throw InputError(file.path, line_of_row(file, table, number_of_row, value),
                     "the residue number {} is too large; correct it", in_quotes(value));
  return number;
}

/// Returns a number in single precision; NaN if the text is not a number or beyond the range.
float kept_number(const std::string& value) {
  const double number = cif::as_number(value);
  const bool fits = std::abs(number) <= std::numeric_limits<float>::max();
  return fits ? static_cast<float>(number) : std::numeric_limits<float>::quiet_NaN();
}

Atom read_row(const TextFile& file, const cif::Table& table, std::size_t number_of_row, const cif::Table::Row& row) {
  Atom atom;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string& value = row[static_cast<std::size_t>(axis)];
    double number = 0.0;
    if (parse_number(without_uncertainty(value), number) && std::abs(number) <= kLargestCoordinate) {
      atom.position[axis] = number;
    } else {
      parse_coordinate(file, line_of_row(file, table, number_of_row, value), "xyz"[axis], value);
    }
  }
  const auto text = [&](Column first, Column second) { return cif::as_string(row.one_of(first, second)); };
  atom.name = text(kAuthAtom, kLabelAtom);
  atom.residue_name = text(kAuthComp, kLabelComp);
  atom.chain = text(kAuthAsym, kLabelAsym);
  atom.subchain = text(kLabelAsym, kAuthAsym);
  atom.residue_number = residue_number(file, table, number_of_row, row);
  if (row.has2(kInsertion)) atom.insertion_code = first_letter(row[kInsertion]);
  if (row.has2(kAlt)) atom.altloc = first_letter(row[kAlt]);
  if (row.has2(kOccupancy)) atom.occupancy = kept_number(row[kOccupancy]);
  if (row.has2(kB)) atom.b_factor = kept_number(row[kB]);
  if (row.has2(kCharge)) atom.charge = kept_number(row[kCharge]);
  if (row.has2(kSegment)) atom.segment = cif::as_string(row[kSegment]);
  const gemmi::Element symbol(row.has2(kSymbol) ? cif::as_string(row[kSymbol]) : std::string());
  atom.element = static_cast<std::uint8_t>(symbol.atomic_number());
  return atom;
}

/// Returns the type of each entity from _entity or, if it is missing there, from _entity_poly.
std::map<std::string, ResidueStatement> entities_of(cif::Document& document) {
  std::map<std::string, ResidueStatement> entities;
  for (cif::Block& block : document.blocks) {
    for (const auto row : block.find("_entity.", {"id", "type"})) {
      entities[row.str(0)] = row.str(1) == "polymer" ? ResidueStatement::polymer : ResidueStatement::other;
    }
    for (const auto row : block.find("_entity_poly.", {"entity_id"}))
      entities.try_emplace(row.str(0), ResidueStatement::polymer);
  }
  return entities;
}

/// Returns the helices of _struct_conf and the strands of _struct_sheet_range, by the author's names.
std::vector<SecondaryRange> secondary_ranges(cif::Document& document) {
  std::vector<SecondaryRange> ranges;
  const std::vector<std::string> columns{"beg_auth_asym_id",       "beg_auth_seq_id",        "end_auth_seq_id",
                                         "?pdbx_beg_PDB_ins_code", "?pdbx_end_PDB_ins_code", "?conf_type_id"};
  const auto take = [&](cif::Table table, bool helices) {
    for (const cif::Table::Row row : table) {
      if (helices && !(row.has2(5) && cif::as_string(row[5]).starts_with("HELX"))) continue;
      const auto residue = [&](std::size_t number, std::size_t insertion, SecondaryRange::Residue& end) {
        const std::string& digits = row[number];
        end.second = row.has2(insertion) ? first_letter(row[insertion]) : ' ';
        const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), end.first);
        return error == std::errc() && rest == digits.data() + digits.size();
      };
      SecondaryRange range{
          cif::as_string(row[0]), {}, {}, helices ? SecondaryStructure::helix : SecondaryStructure::strand};
      if (residue(1, 3, range.first) && residue(2, 4, range.last)) ranges.push_back(std::move(range));
    }
  };
  for (cif::Block& block : document.blocks) {
    take(block.find("_struct_conf.", columns), true);
    take(block.find("_struct_sheet_range.", columns), false);
  }
  return ranges;
}

/// A residue of _ma_qa_metric_local by model, label_asym_id and label_seq_id.
using LabelledResidue = std::array<std::string, 3>;

/// Returns pLDDT from 0 to 100 of ModelCIF, from the first metric of that type. The result is empty if there is none.
std::map<LabelledResidue, float> confidences_of(cif::Document& document) {
  std::map<LabelledResidue, float> confidences;
  for (cif::Block& block : document.blocks) {
    std::string metric;
    bool is_share = false;
    for (const auto row : block.find("_ma_qa_metric.", {"id", "type", "mode"})) {
      if (!row.str(1).starts_with("pLDDT") || row.str(2) != "local" || !metric.empty()) continue;
      metric = row.str(0);
      is_share = row.str(1).ends_with("in [0,1]");
    }
    if (metric.empty()) continue;
    for (const auto row : block.find("_ma_qa_metric_local.",
                                     {"metric_id", "metric_value", "label_asym_id", "label_seq_id", "?model_id"})) {
      if (row.str(0) != metric) continue;
      const float number = kept_number(row[1]);
      confidences[{row.has(4) ? row.str(4) : "1", row.str(2), row.str(3)}] = is_share ? 100.0f * number : number;
    }
  }
  return confidences;
}

/// Returns the experimental method of _exptl. The result is empty for a predicted model.
std::string experiment_of(cif::Document& document) {
  for (cif::Block& block : document.blocks)
    for (const auto row : block.find("_exptl.", {"method"}))
      if (const std::string method = row.str(0); method.find("MODEL") == std::string::npos) return method;
  return {};
}

/// Numbers texts, of which only a few are distinct and most are equal to the previous one.
class TextNumbers {
 public:
  std::uint32_t number(const std::string& text) {
    if (last_ == texts_.size() || texts_[last_] != text) {
      const auto [known, is_new] = numbers_.try_emplace(text, static_cast<std::uint32_t>(texts_.size()));
      if (is_new) texts_.push_back(text);
      last_ = known->second;
    }
    return static_cast<std::uint32_t>(last_);
  }

  const std::string& text(std::uint32_t number) const { return texts_[number]; }
  std::size_t count() const { return texts_.size(); }

 private:
  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::vector<std::string> texts_;
  std::size_t last_ = 0;
};

/// Returns the first of the three sets of columns with coordinates that is complete for all atoms of a component. The
/// coordinates of the model come first.
std::size_t whole_coordinates(const TextFile& file, cif::Table& table, std::size_t begin, std::size_t end,
                              std::vector<Warning>& warnings) {
  const std::string name = in_quotes(table[begin].str(0));
  std::size_t x = 3;
  for (const char* kind : {"model", "ideal", "dictionary"}) {
    bool whole = true;
    for (std::size_t n = 3 * begin; whole && n < 3 * end; ++n) whole = table[n / 3].has2(x + n % 3);
    if (whole) {
      warnings.emplace_back(fmt::format("{} coordinates of component {} are used", kind, name));
      return x;
    }
    x += 3;
  }
  throw InputError(file.path, 0, "component {} has neither model nor ideal coordinates of all of its {} atoms", name,
                   end - begin);
}

/// Returns the atoms of chemical components (_chem_comp_atom) as a table _atom_site; each component is a model.
cif::Block component_sites(const TextFile& file, const ModelChoice& choice, cif::Document& document,
                           std::vector<Warning>& warnings) {
  cif::Block sites("components");
  cif::Loop& loop = sites.init_loop(
      "_atom_site.",
      column_names("pdbx_PDB_model_num group_PDB label_comp_id label_atom_id type_symbol Cartn_x Cartn_y Cartn_z"));
  std::int32_t model = 0;
  for (cif::Block& block : document.blocks) {
    cif::Table table = block.find(
        "_chem_comp_atom.", column_names("comp_id atom_id ?type_symbol ?model_Cartn_x ?model_Cartn_y ?model_Cartn_z "
                                         "?pdbx_model_Cartn_x_ideal ?pdbx_model_Cartn_y_ideal "
                                         "?pdbx_model_Cartn_z_ideal ?x ?y ?z"));
    for (std::size_t begin = 0, end = 0; begin < table.length(); begin = end) {
      while (end < table.length() && table[end][0] == table[begin][0]) ++end;
      const std::size_t x = choice.takes(++model) ? whole_coordinates(file, table, begin, end, warnings) : 3;
      for (std::size_t n = begin; n < end; ++n) {
        const cif::Table::Row row = table[n];
        const auto cell = [&](std::size_t column) { return row.has(column) ? row[column] : std::string("?"); };
        loop.add_row({std::to_string(model), "HETATM", row[0], row[1], cell(2), cell(x), cell(x + 1), cell(x + 2)});
      }
    }
  }
  return sites;
}

/// Collects the atoms of a file. Information in other tables may come later in the file, so it is added at the end.
class AtomRows {
 public:
  AtomRows(const TextFile& file, const ModelChoice& choice) : file_(file), choice_(choice) {}

  /// Takes rows of the first block with atoms. Further blocks with atoms are only counted.
  void take(cif::Block& block, std::size_t first) {
    cif::Table table = block.find("_atom_site.", kColumns);
    if (!table.ok()) return;
    if (first == 0) is_first_ = ++blocks_ == 1;
    if (!is_first_) return;
    for (const cif::Table::Row row : table) take(table, first + static_cast<std::size_t>(row.row_index), row);
  }

  FileContents finish(cif::Document& document) {
    if (blocks_ == 0) take_components(document);
    if (blocks_ == 0) refuse_without_atoms(file_, document);
    if (blocks_ > 1)
      contents_.warnings.emplace_back(fmt::format("{} data blocks hold atoms; the first is used", blocks_));
    contents_.experiment = experiment_of(document);
    contents_.models = models_.count();
    without_symbol_.warn(contents_.warnings, "no element symbol; elements were guessed from the names");
    add_confidences(confidences_of(document));
    contents_.sites = classify_atoms(contents_.atoms, contents_.warnings, hints(entities_of(document)));
    mark_secondary_structure(contents_.atoms, secondary_ranges(document));
    return std::move(contents_);
  }

 private:
  /// Reads each chemical component as a model, with its bonds.
  void take_components(cif::Document& document) {
    cif::Block sites = component_sites(file_, choice_, document, contents_.warnings);
    if (sites.items.front().loop.values.empty()) return;
    take(sites, 0);
    contents_.of_molecules = true;
    std::map<std::array<std::string, 2>, std::uint32_t> places;
    for (const Atom& atom : contents_.atoms) places.try_emplace({atom.residue_name, atom.name}, atom.index);
    for (cif::Block& block : document.blocks) {
      for (const auto row : block.find("_chem_comp_bond.", {"comp_id", "atom_id_1", "atom_id_2"})) {
        const auto first = places.find({row.str(0), row.str(1)}), second = places.find({row.str(0), row.str(2)});
        if (first == places.end() || second == places.end() || first == second) continue;
        contents_.bonds.push_back({std::min(first->second, second->second), std::max(first->second, second->second)});
        std::vector<std::int32_t>& models = contents_.fully_bonded;
        const std::int32_t model = contents_.atoms[first->second].model;
        if (models.empty() || models.back() != model) models.push_back(model);
      }
    }
  }

  /// The identifiers of an atom in other tables.
  struct Names {
    std::uint32_t entity, residue;
    bool is_heteroatom, is_site;
  };

  void take(const cif::Table& table, std::size_t number, const cif::Table::Row& row) {
    const auto model = static_cast<std::int32_t>(models_.number(row.has(kModel) ? row[kModel] : "1")) + 1;
    if (!choice_.takes(model)) {
      ++contents_.other_model_atoms;
      return;
    }
    Atom atom = read_row(file_, table, number, row);
    atom.model = model;
    residues_.number(atom);
    const bool site = row.has2(kSymbol) && is_site_symbol(cif::as_string(row[kSymbol]));
    if (atom.element == 0 && !site) without_symbol_.add(label_of(atom));
    names_.push_back({texts_.number(row.has2(kEntityId) ? cif::as_string(row[kEntityId]) : std::string()),
                      labels_.number(row.has(kLabelSeq) ? row.str(kLabelSeq) : std::string()),
                      row.has2(kGroup) && row[kGroup] == "HETATM", site});
    contents_.atoms.push_back(std::move(atom));
  }

  void add_confidences(const std::map<LabelledResidue, float>& confidences) {
    for (std::size_t a = 0; a < contents_.atoms.size() && !confidences.empty(); ++a) {
      Atom& atom = contents_.atoms[a];
      const std::string& model = models_.text(static_cast<std::uint32_t>(atom.model - 1));
      const auto confidence = confidences.find(
          {cif::is_null(model) ? "1" : cif::as_string(model), atom.subchain, labels_.text(names_[a].residue)});
      if (confidence != confidences.end()) atom.confidence = confidence->second;
    }
  }

  std::vector<AtomHints> hints(const std::map<std::string, ResidueStatement>& entities) const {
    std::vector<AtomHints> hints;
    hints.reserve(names_.size());
    for (const Names& names : names_) {
      const auto statement = entities.find(texts_.text(names.entity));
      hints.push_back({.residue = statement == entities.end() ? ResidueStatement::none : statement->second,
                       .is_heteroatom = names.is_heteroatom,
                       .is_site = names.is_site});
    }
    return hints;
  }

  const TextFile& file_;
  const ModelChoice& choice_;
  FileContents contents_;
  ResidueCounter residues_{contents_.atoms};
  TextNumbers models_, texts_, labels_;
  std::vector<Names> names_;  // one for each atom
  WarningCollector without_symbol_;
  std::size_t blocks_ = 0;
  bool is_first_ = false;
};

FileContents read(const TextFile& file, const ModelChoice& choice) {
  AtomRows rows(file, choice);
  cif::Document document = parse_cif(file, [&](cif::Block& block, std::size_t first) { rows.take(block, first); });
  return rows.finish(document);
}

FileContents read_binary(const TextFile& file, const ModelChoice& choice) {
  if (!is_binary_cif(file.text))
    throw InputError(file.path, 0, "is not BinaryCIF: it does not begin with a map of encoder, version and dataBlocks");
  return read(file, choice);
}

bool recognizes(std::string_view text) {
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

const Reader kMmcifReader{
    {"mmCIF", ".cif .mmcif .mcif", "macromolecular CIF of the wwPDB", "PDBx/mmCIF dictionary; Hall, Allen & Brown 1991",
     "_atom_site (author's names where given, label_asym_id too; partial charges as charge, segments as auth_segid), "
     "_entity and _entity_poly, _struct_conf and _struct_sheet_range, _exptl, pLDDT of _ma_qa_metric_local; chemical "
     "components (_chem_comp_atom, _chem_comp_bond), each a model"},
    recognizes,
    read,
    read_mmcif_assemblies};

const Reader kBinaryCifReader{
    {"BinaryCIF", ".bcif", "mmCIF in packed columns of numbers",
     "Sehnal et al. 2020, PLOS Comput. Biol. 16, e1008247; github.com/molstar/BinaryCIF",
     "what is read of mmCIF; all encodings: ByteArray, FixedPoint, IntervalQuantization, RunLength, Delta, "
     "IntegerPacking, StringArray"},
    is_binary_cif,
    read_binary,
    read_mmcif_assemblies};

}  // namespace meniscus
