// SPDX-License-Identifier: BSD-3-Clause
// Parses and writes records of PDB files: atoms, models, bonds and periodic boxes.
#include "core/structure/formats/pdb_records.h"

#include <cctype>
#include <charconv>
#include <unordered_map>

#include "core/math/ball.h"
#include "core/structure/assembly.h"
#include "core/structure/atom_classes.h"
#include "core/structure/element_tables.h"
#include "core/structure/residue_names.h"

namespace meniscus {
namespace {

/// Returns the columns from..to, counted from 1 as in the description of the format.
std::string_view columns(std::string_view line, std::size_t from, std::size_t to) {
  return line.size() < from ? std::string_view() : line.substr(from - 1, to + 1 - from);
}

char column(std::string_view line, std::size_t at) {
  const std::string_view text = columns(line, at, at);
  return text.empty() || text[0] == '\t' ? ' ' : text[0];
}

bool all_digits(std::string_view text) { return text.find_first_not_of("0123456789") == std::string_view::npos; }

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::optional<std::int64_t> in_base(std::string_view text, int base) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (error != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

/// Parses a hybrid-36 number of four characters: A000 to ZZZZ follow 9999, then a000 to zzzz.
std::optional<std::int64_t> hybrid_36(std::string_view field) {
  constexpr std::int64_t kCube = 36 * 36 * 36;
  if (field.size() != 4) return std::nullopt;
  const bool upper = field[0] >= 'A' && field[0] <= 'Z';
  const bool lower = field[0] >= 'a' && field[0] <= 'z';
  if (!upper && !lower) return std::nullopt;
  const auto other_case = [&](unsigned char c) { return upper ? std::islower(c) != 0 : std::isupper(c) != 0; };
  if (std::any_of(field.begin(), field.end(), other_case)) return std::nullopt;
  const std::optional<std::int64_t> number = in_base(field, 36);
  if (!number) return std::nullopt;
  return *number - 10 * kCube + 10000 + (lower ? 26 * kCube : 0);
}

/// True if column 21 belongs to a residue name of four letters (TIP3, POPC) and not to a chain name of two letters.
bool has_name_of_four(std::string_view line, char column_21, char column_22, const std::string& segment) {
  if (column_21 == ' ') return false;
  if (column_22 == ' ' || !segment.empty()) return true;
  const std::string three(trimmed(columns(line, 18, 20)));
  return three.size() == 3 && (is_water_name(std::string(columns(line, 18, 21))) || !is_tabulated_residue(three));
}

}  // namespace

bool is_pdb_record(std::string_view line, std::string_view record) {
  if (line.size() < record.size() || (line.size() > record.size() && record.size() < 6 && line[record.size()] != ' '))
    return false;
  return std::equal(record.begin(), record.end(), line.begin(),
                    [](char r, char c) { return r == std::toupper(static_cast<unsigned char>(c)); });
}

bool is_pdb_atom(std::string_view line) { return is_pdb_record(line, "ATOM") || is_pdb_record(line, "HETATM"); }

void read_pdb_names(std::string_view line, Atom& atom) {
  atom.name = trimmed(columns(line, 13, 16));
  atom.altloc = column(line, 17);
  atom.segment = trimmed(columns(line, 73, 76));
  const bool four = has_name_of_four(line, column(line, 21), column(line, 22), atom.segment);
  atom.residue_name = trimmed(columns(line, 18, four ? 21 : 20));
  atom.chain = trimmed(columns(line, four ? 22 : 21, 22));
  if (atom.chain.empty()) atom.chain = atom.segment;
  atom.subchain = atom.chain;
  atom.insertion_code = column(line, 27);
}

bool parse_residue_number(std::string_view field, std::int32_t& number, char& insertion_code) {
  if (!field.empty() && std::isalpha(static_cast<unsigned char>(field.back()))) {
    insertion_code = field.back();
    field.remove_suffix(1);
  }
  std::int64_t parsed = 0;
  if (!parse_whole_number(field, parsed) || parsed < -1'000'000'000 || parsed > 1'000'000'000) return false;
  number = static_cast<std::int32_t>(parsed);
  return true;
}

bool PdbResidueNumbers::read(std::string_view line, Atom& atom) {
  const std::string_view field = trimmed(columns(line, 23, 26));
  std::int64_t number = 0;
  const bool decimal = parse_whole_number(field, number);
  const std::optional<std::int64_t> hybrid = hybrid_36(field);
  const std::optional<std::int64_t> hexadecimal = in_base(field, 16);
  const auto continues_count = [&](std::int64_t n) { return last_ >= 9999 && (n == last_ || n == last_ + 1); };
  if (decimal && field.size() == 4 && all_digits(field) && is_digit(atom.insertion_code)) {
    number = number * 10 + (atom.insertion_code - '0');
    atom.insertion_code = ' ';
  } else if (hexadecimal && *hexadecimal > 9999 && (continues_count(*hexadecimal) || !(decimal || hybrid))) {
    number = *hexadecimal;
  } else if (hybrid) {
    number = *hybrid;
  } else if (!decimal) {
    atom.residue_number = static_cast<std::int32_t>(field.empty() ? 0 : count_on(atom));
    return false;
  }
  atom.residue_number = static_cast<std::int32_t>(last_ = number);
  counted_names_.clear();
  counted_residue_.clear();
  return true;
}

std::int64_t PdbResidueNumbers::count_on(const Atom& atom) {
  const std::string name = atom.name + atom.altloc;
  const bool again = std::find(counted_names_.begin(), counted_names_.end(), name) != counted_names_.end();
  const std::string residue = atom.chain + '\n' + atom.residue_name;
  if (again || residue != counted_residue_) {
    ++last_;
    counted_names_.clear();
    counted_residue_ = residue;
  }
  counted_names_.push_back(name);
  return last_;
}

namespace {

constexpr std::size_t kFirstColumn = 6, kWidth = 5, kMostPartners = 4;
constexpr std::uint32_t kSeveral = 0xffffffff;

std::string_view serial_at(std::string_view line, std::size_t field) {
  return trimmed(line.substr(std::min(line.size(), kFirstColumn + field * kWidth), kWidth));
}

}  // namespace

void PdbBonds::add_atom(std::string_view line) { serials_.push_back(serial_at(line, 0)); }

std::vector<Bond> PdbBonds::bonds() const {
  std::vector<Bond> bonds;
  if (records_.empty() && pairs_.empty()) return bonds;
  std::unordered_map<std::string_view, std::uint32_t> atom_of;
  for (std::size_t n = 0; n < serials_.size(); ++n) {
    const auto [found, added] = atom_of.try_emplace(serials_[n], static_cast<std::uint32_t>(n));
    if (!added) found->second = kSeveral;
  }
  const auto find = [&](std::string_view serial) -> std::optional<std::uint32_t> {
    const auto found = atom_of.find(serial);
    if (serial.empty() || found == atom_of.end() || found->second == kSeveral) return std::nullopt;
    return found->second;
  };
  const auto join = [&](std::string_view one, std::string_view other) {
    const auto first = find(one), partner = find(other);
    if (first && partner && *partner != *first)
      bonds.push_back({std::min(*first, *partner), std::max(*first, *partner)});
  };
  for (const std::string_view record : records_)
    for (std::size_t field = 1; field <= kMostPartners; ++field) join(serial_at(record, 0), serial_at(record, field));
  for (const auto& [first, second] : pairs_) join(first, second);
  std::sort(bonds.begin(), bonds.end());
  bonds.erase(std::unique(bonds.begin(), bonds.end()), bonds.end());
  return bonds;
}

namespace {

class Remark350 {
 public:
  explicit Remark350(const TextFile& file) : file_(file), lines_(file) {}

  std::vector<Assembly> run() {
    std::string_view line;
    while (lines_.next(line)) {
      if (line.starts_with("REMARK 350")) take(trimmed(line.substr(10)), line);
      if (line.starts_with("ATOM") || line.starts_with("HETATM") || line.starts_with("MODEL")) break;
    }
    finish_matrix();
    return std::move(assemblies_);
  }

 private:
  void take(std::string_view text, std::string_view line) {
    constexpr std::string_view kId = "BIOMOLECULE:", kUnit = "AUTHOR DETERMINED BIOLOGICAL UNIT:";
    if (text.starts_with(kId)) {
      finish_matrix();
      assemblies_.push_back({std::string(trimmed(text.substr(kId.size()))), {}, {}});
    } else if (text.starts_with(kUnit)) {
      if (!assemblies_.empty()) assemblies_.back().description = trimmed(text.substr(kUnit.size()));
    } else if (text.find("APPLY THE FOLLOWING TO CHAIN") != std::string_view::npos) {
      finish_matrix();
      if (assemblies_.empty()) assemblies_.push_back({"1", {}, {}});
      assemblies_.back().parts.emplace_back();
      take_chains(text);
    } else if (text.starts_with("AND CHAIN")) {
      take_chains(text);
    } else if (text.starts_with("BIOMT")) {
      take_row(text, line);
    }
  }

  void take_chains(std::string_view text) {
    if (assemblies_.empty() || assemblies_.back().parts.empty()) return;
    const std::size_t colon = text.find(':');
    std::string_view list = colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1);
    while (!list.empty()) {
      const std::size_t comma = std::min(list.find(','), list.size());
      const std::string_view chain = trimmed(list.substr(0, comma));
      if (!chain.empty() && chain != "NULL") assemblies_.back().parts.back().chains.emplace_back(chain);
      list.remove_prefix(std::min(list.size(), comma + 1));
    }
  }

  void take_row(std::string_view text, std::string_view line) {
    const char row = text.size() > 5 ? text[5] : ' ';
    if (row != static_cast<char>('1' + rows_))
      throw lines_.error("BIOMT{} was found where BIOMT{} is missing; a matrix has three rows", escaped({&row, 1}),
                         rows_ + 1);
    if (row == '1') {
      first_line_ = lines_.number();
      serial_ = trimmed(line.substr(std::min<std::size_t>(line.size(), 19), 4));
    }
    // The row is in columns 24-33, 34-43, 44-53 and 54-68.
    constexpr std::size_t kBegin[] = {23, 33, 43, 53}, kLength[] = {10, 10, 10, 15};
    for (std::size_t n = 0; n < 4; ++n) {
      const std::string_view field = line.size() > kBegin[n] ? line.substr(kBegin[n], kLength[n]) : std::string_view();
      if (!parse_number(field, matrix_[rows_][n]) || std::abs(matrix_[rows_][n]) > kLargestCoordinate)
        throw lines_.error("BIOMT{} has {} where a number of at most {} is expected; correct the matrix", row,
                           in_quotes(field), kLargestCoordinate);
    }
    if (++rows_ == 3) finish_matrix();
  }

  void finish_matrix() {
    if (rows_ == 0) return;
    if (rows_ < 3)
      throw InputError(file_.path, first_line_, "matrix {} of REMARK 350 has {} of three rows", in_quotes(serial_),
                       rows_);
    rows_ = 0;
    if (assemblies_.empty()) assemblies_.push_back({"1", {}, {}});
    if (assemblies_.back().parts.empty()) assemblies_.back().parts.emplace_back();
    auto& motions = assemblies_.back().parts.back().motions;
    if (motions.size() >= kMostOperators)
      throw CapacityError("{}: more than {} BIOMT matrices", file_.path, with_thousands(kMostOperators));
    motions.push_back(rigid_motion(matrix_, file_.path, first_line_));
  }

  const TextFile& file_;
  LineReader lines_;
  std::vector<Assembly> assemblies_;
  std::array<std::array<double, 4>, 3> matrix_{};
  std::size_t rows_ = 0, first_line_ = 0;
  std::string serial_;
};

constexpr std::size_t kMostAtoms = 99999;

void check_room(const Atom& atom) {
  if (atom.residue_number < -999 || atom.residue_number > 9999)
    throw RequestError("{}: a PDB file has no room for residue number {}", atom_place(atom), atom.residue_number);
  if (atom.chain.size() > 2 || atom.name.size() > 4 || atom.residue_name.size() > 3)
    throw RequestError("{}: a PDB file has room for 2 letters of a chain, 4 of an atom and 3 of a residue",
                       escaped(atom_place(atom)));
}

/// Returns the text for columns 13 to 16, where elements of one letter begin in the second column.
std::string name_field(const Atom& atom) {
  const std::string element = atom.element ? element_symbol(atom.element) : "";
  return atom.name.size() < 4 && element.size() < 2 ? " " + atom.name : atom.name;
}

double or_zero(float number) { return std::isfinite(number) ? number : 0.0; }

}  // namespace

std::vector<Assembly> read_pdb_assemblies(const TextFile& file) {
  std::vector<Assembly> assemblies = Remark350(file).run();
  for (Assembly& assembly : assemblies)
    std::erase_if(assembly.parts, [](const AssemblyPart& part) { return part.motions.empty(); });
  std::erase_if(assemblies, [](const Assembly& assembly) { return assembly.parts.empty(); });
  return assemblies;
}

PdbModels::PdbModels(const std::filesystem::path& path, Existing existing, std::span<const Atom> atoms)
    : atoms_(atoms), file_(path, existing) {
  if (atoms.size() > kMostAtoms)
    throw RequestError("{} atoms: a PDB file numbers {} at most; select fewer", with_thousands(atoms.size()),
                       with_thousands(kMostAtoms));
  for (const Atom& atom : atoms) check_room(atom);
}

void PdbModels::add(std::span<const glm::dvec3> positions) {
  std::string text = fmt::format("MODEL     {:>4}\n", ++models_);
  for (std::size_t n = 0; n < atoms_.size(); ++n) {
    const Atom& atom = atoms_[n];
    const glm::dvec3& x = positions[n];
    for (int axis = 0; axis < 3; ++axis)
      if (!(x[axis] > -999.9995 && x[axis] < 9999.9995))
        throw RequestError("{} is at {:.3f} Å, where a PDB file cannot have it", atom_place(atom), x[axis]);
    std::string element = atom.element ? element_symbol(atom.element) : "";
    for (char& letter : element)
      if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
    text += fmt::format("{:<6}{:>5} {:<4} {:>3}{:>2}{:>4}{}   {:8.3f}{:8.3f}{:8.3f}{:6.2f}{:6.2f}          {:>2}\n",
                        atom.kind == AtomClass::polymer ? "ATOM" : "HETATM", n + 1, name_field(atom), atom.residue_name,
                        atom.chain, atom.residue_number, atom.insertion_code, x.x, x.y, x.z, or_zero(atom.occupancy),
                        glm::clamp(or_zero(atom.b_factor), -99.99, 999.99), element);
  }
  file_.write(text + "ENDMDL\n");
}

void PdbModels::commit() {
  file_.write("END\n");
  file_.commit();
}

}  // namespace meniscus
