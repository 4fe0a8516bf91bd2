// SPDX-License-Identifier: BSD-3-Clause
// Strict reading of the fixed columns of PDB (wwPDB format 3.3), lenient about everything a surface does not need.
#include "core/molecule/pdb_text.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/molecule/reader.h"

namespace meniscus {
namespace {

constexpr std::size_t kCoordinatesEnd = 54;

bool is_record(std::string_view line, std::string_view record) {
  if (line.size() < record.size() || (line.size() > record.size() && record.size() < 6 && line[record.size()] != ' '))
    return false;
  return std::equal(record.begin(), record.end(), line.begin(),
                    [](char r, char c) { return r == std::toupper(static_cast<unsigned char>(c)); });
}

bool is_atom(std::string_view line) { return is_record(line, "ATOM") || is_record(line, "HETATM"); }

/// Counts one kind of oddity and remembers where it was first met.
struct Oddity {
  std::size_t count = 0;
  std::size_t first_line = 0;
  void add(std::size_t line) {
    if (count++ == 0) first_line = line;
  }
};

class Checker {
 public:
  explicit Checker(const TextFile& file) : file_(file) { result_.text.reserve(file.text.size()); }

  CheckedPdb run() {
    std::string_view rest = file_.text;
    while (!rest.empty()) {
      const std::size_t end = rest.find('\n');
      take(rest.substr(0, end), ++line_);
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    }
    if (atoms_ == 0) throw InputError(file_.path, 0, "has no ATOM or HETATM records: no atoms");
    warn(occupancy_, "occupancies are missing or no numbers; taken as 1");
    warn(b_factor_, "B-factors are missing or no numbers; treated as missing");
    warn(element_, "atoms have no element column; elements were guessed from their names");
    warn(unnamed_model_, "times atoms follow END or a further MODEL without ENDMDL; taken as further models");
    return std::move(result_);
  }

 private:
  void take(std::string_view line, std::size_t number) {
    if (is_atom(line)) {
      take_atom(line, number);
    } else if (is_record(line, "TER")) {
      if (open_ && result_.models == 1) result_.text += "TER\n";
    } else if (is_record(line, "MODEL")) {
      if (open_) unnamed_model_.add(number);
      close_model();
      in_model_record_ = true;
    } else if (is_record(line, "ENDMDL")) {
      close_model();
      in_model_record_ = false;
    } else if (is_record(line, "END")) {
      end_line_ = number;
    }
  }

  /// Atoms after END belong to a further model, as molecular dynamics programs write them.
  void open_model() {
    if (open_ && end_line_ != 0 && !in_model_record_) {
      unnamed_model_.add(end_line_);
      close_model();
    }
    end_line_ = 0;
    if (open_) return;
    ++result_.models;
    open_ = true;
  }

  void close_model() {
    open_ = false;
    end_line_ = 0;
  }

  void take_atom(std::string_view line, std::size_t number) {
    open_model();
    if (result_.models > 1) {
      ++result_.other_model_atoms;
      return;
    }
    if (line.size() < kCoordinatesEnd) {
      throw InputError(file_.path, number,
                       fmt::format("atom record {} is cut short at column {}; coordinates need 54 columns",
                                   in_quotes(line), line.size()));
    }
    ++atoms_;
    for (int axis = 0; axis < 3; ++axis) {
      parse_coordinate(file_, number, "xyz"[axis], line.substr(30 + 8 * static_cast<std::size_t>(axis), 8));
    }
    std::array<char, 81> columns;
    columns.fill(' ');
    std::copy_n(line.begin(), std::min<std::size_t>(line.size(), 78), columns.begin());
    columns[80] = '\n';
    std::replace(columns.begin(), columns.begin() + 80, '\t', ' ');
    std::fill_n(columns.begin() + 6, 5, ' ');  // serial numbers: hybrid-36, hexadecimal or stars, never identity
    clean_number(columns.data() + 54, "  1.00", occupancy_, number);
    clean_number(columns.data() + 60, "   nan", b_factor_, number);
    if (!std::isalpha(static_cast<unsigned char>(columns[76])) &&
        !std::isalpha(static_cast<unsigned char>(columns[77]))) {
      element_.add(number);
      columns[76] = columns[77] = ' ';
    }
    result_.text.append(columns.data(), columns.size());
  }

  void clean_number(char* field, const char* missing, Oddity& oddity, std::size_t line) {
    double number = 0.0;
    if (parse_number({field, 6}, number)) return;
    oddity.add(line);
    std::copy_n(missing, 6, field);
  }

  void warn(const Oddity& oddity, const char* words) {
    if (oddity.count == 0) return;
    result_.warnings.push_back(
        fmt::format("{} {} (first at line {})", with_thousands(oddity.count), words, oddity.first_line));
  }

  const TextFile& file_;
  CheckedPdb result_;
  std::size_t line_ = 0;
  std::size_t atoms_ = 0;
  std::size_t end_line_ = 0;
  bool open_ = false;
  bool in_model_record_ = false;
  Oddity occupancy_, b_factor_, element_, unnamed_model_;
};

}  // namespace

bool looks_like_pdb(std::string_view text) {
  constexpr std::array<std::string_view, 16> kRecords{"ATOM",   "HETATM", "HEADER", "TITLE ", "COMPND", "SOURCE",
                                                      "REMARK", "CRYST1", "MODEL ", "SEQRES", "EXPDTA", "AUTHOR",
                                                      "KEYWDS", "CONECT", "ENDMDL", "DBREF "};
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    if (std::any_of(kRecords.begin(), kRecords.end(), [&](std::string_view record) { return is_record(line, record); }))
      return true;
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return false;
}

CheckedPdb check_pdb(const TextFile& file) { return Checker(file).run(); }

}  // namespace meniscus
