// SPDX-License-Identifier: BSD-3-Clause
// Reads the assemblies of a PDB file: REMARK 350 with its BIOMT matrices (wwPDB format 3.3).
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/assembly.h"
#include "core/text/parse_number.h"
#include "core/text/text_lines.h"
#include "core/math/ball.h"
#include "core/structure/structure.h"
#include "core/math/rigid_motion.h"

namespace meniscus {
namespace {

class Remark350 {
 public:
  explicit Remark350(const TextFile& file) : file_(file), lines_(file.text) {}

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
    if (row != static_cast<char>('1' + rows_)) {
      throw InputError(file_.path, lines_.number(),
                       fmt::format("BIOMT{} stands where BIOMT{} is missing; a matrix has three rows",
                                   escaped({&row, 1}), rows_ + 1));
    }
    if (row == '1') {
      first_line_ = lines_.number();
      serial_ = trimmed(line.substr(std::min<std::size_t>(line.size(), 19), 4));
    }
    // Columns 24-33, 34-43, 44-53 and 54-68 hold the row.
    constexpr std::size_t kBegin[] = {23, 33, 43, 53}, kLength[] = {10, 10, 10, 15};
    for (std::size_t n = 0; n < 4; ++n) {
      const std::string_view field = line.size() > kBegin[n] ? line.substr(kBegin[n], kLength[n]) : std::string_view();
      if (!parse_number(field, matrix_[rows_][n]) || std::abs(matrix_[rows_][n]) > kLargestCoordinate) {
        throw InputError(file_.path, lines_.number(),
                         fmt::format("BIOMT{} has {} where a number of at most {} is expected; correct the matrix", row,
                                     in_quotes(field), kLargestCoordinate));
      }
    }
    if (++rows_ == 3) finish_matrix();
  }

  void finish_matrix() {
    if (rows_ == 0) return;
    if (rows_ < 3) {
      throw InputError(file_.path, first_line_,
                       fmt::format("matrix {} of REMARK 350 has {} of three rows", in_quotes(serial_), rows_));
    }
    rows_ = 0;
    if (assemblies_.empty()) assemblies_.push_back({"1", {}, {}});
    if (assemblies_.back().parts.empty()) assemblies_.back().parts.emplace_back();
    auto& motions = assemblies_.back().parts.back().motions;
    if (motions.size() >= kMostOperators)
      throw CapacityError(fmt::format("{}: more than {} BIOMT matrices", file_.path, with_thousands(kMostOperators)));
    motions.push_back(rigid_motion(matrix_, file_.path, first_line_));
  }

  const TextFile& file_;
  LineReader lines_;
  std::vector<Assembly> assemblies_;
  std::array<std::array<double, 4>, 3> matrix_{};
  std::size_t rows_ = 0, first_line_ = 0;
  std::string serial_;
};

}  // namespace

std::vector<Assembly> read_pdb_assemblies(const TextFile& file) {
  std::vector<Assembly> assemblies = Remark350(file).run();
  for (Assembly& assembly : assemblies)
    std::erase_if(assembly.parts, [](const AssemblyPart& part) { return part.motions.empty(); });
  std::erase_if(assemblies, [](const Assembly& assembly) { return assembly.parts.empty(); });
  return assemblies;
}

}  // namespace meniscus
