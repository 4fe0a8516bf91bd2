// SPDX-License-Identifier: BSD-3-Clause
// Reads only what radii need: RESI, PRES and ATOM lines, and the lines of NONBONDED.
#include "core/structure/radii/charmm_radii.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parse_number.h"
#include "core/base/text.h"
#include "core/base/text_file.h"

namespace meniscus {
namespace {

/// CHARMM compares the first four letters of a word, in any case.
std::string keyword(std::string_view field) {
  std::string word(field.substr(0, 4));
  for (char& c : word) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return word;
}

constexpr std::array<std::string_view, 14> kParameterSections{"BOND", "ANGL", "THET", "DIHE", "PHI",  "IMPR",  "IMPH",
                                                              "CMAP", "NBFI", "HBON", "THOL", "ATOM", "ATOMS", "END"};

bool ends_nonbonded(const std::string& word) {
  return std::find(kParameterSections.begin(), kParameterSections.end(), word) != kParameterSections.end();
}

}  // namespace

bool is_charmm_line(const std::vector<std::string_view>& fields) {
  const std::string word = keyword(fields[0]);
  double number = 0.0;
  if (word == "RESI" || word == "PRES") return fields.size() >= 3 && parse_number(fields[2], number);
  return fields[0].size() >= 6 && (word == "NONB" || word == "NBON");
}

void CharmmRadii::read(const TextFile& file) {
  files_ += (files_.empty() ? "" : ", ") + file.path;
  section_ = Section::other;
  LineReader lines(file.text);
  bool continued = false;  // a line that ends in "-" goes on in the next: the options of NONBONDED
  for (std::string_view line; lines.next(line);) {
    line = trimmed(line.substr(0, line.find('!')));
    if (line.empty() || line[0] == '*') continue;
    const bool goes_on = line.ends_with('-');
    const std::vector<std::string_view> fields = fields_of(line);
    const std::string word = keyword(fields[0]);
    if (std::exchange(continued, goes_on)) continue;
    if ((word == "RESI" || word == "PRES") && fields.size() >= 2) {
      section_ = Section::topology;
      residue_ = word == "RESI" ? std::string(fields[1]) : std::string();
    } else if (word == "NONB" || word == "NBON") {
      section_ = Section::nonbonded;
    } else if (section_ == Section::topology && word == "ATOM") {
      read_atom(file, lines.number(), fields);
    } else if (section_ == Section::nonbonded && ends_nonbonded(word)) {
      section_ = Section::other;
    } else if (section_ == Section::nonbonded) {
      read_type(file, lines.number(), fields);
    }
  }
}

void CharmmRadii::read_atom(const TextFile& file, std::size_t line, const std::vector<std::string_view>& fields) {
  if (fields.size() < 3) throw InputError(file.path, line, "an ATOM needs a name and a type");
  const std::string name(fields[1]), type(fields[2]);
  if (residue_.empty()) {
    patch_atoms_.try_emplace(name, type);
  } else {
    residues_[residue_][name] = type;
  }
}

void CharmmRadii::read_type(const TextFile& file, std::size_t line, const std::vector<std::string_view>& fields) {
  double half = 0.0;
  if (fields.size() < 4 || !parse_number(fields[3], half) || half < 0.0 || half > kLargestRadius) {
    throw InputError(
        file.path, line,
        fmt::format("a line of NONBONDED needs a type, two numbers and half of Rmin, from 0 to {} Å", kLargestRadius));
  }
  radii_[std::string(fields[0])] = half;
}

RadiiTable CharmmRadii::table() const {
  if (residues_.empty()) throw InputError(files_, 0, "lacks residues; give the CHARMM topology (.rtf) too");
  if (radii_.empty()) throw InputError(files_, 0, "lacks NONBONDED parameters; give the CHARMM parameters (.prm) too");
  // Every residue may have the atoms of all patches.
  constexpr std::size_t kMostEntries = 1'000'000;
  if (patch_atoms_.size() > kMostEntries / residues_.size()) {
    throw CapacityError(
        fmt::format("{}: {} residues with the atoms of patches, {} of them, are more than this program "
                    "reads",
                    files_, with_thousands(residues_.size()), with_thousands(patch_atoms_.size())));
  }
  RadiiTable table(files_, "CHARMM");
  const auto add = [&](const std::string& residue, const std::string& atom, const std::string& type) {
    const auto radius = radii_.find(type);
    if (radius != radii_.end()) table.add(residue, atom, {radius->second, radius->second, type});
  };
  for (const auto& [residue, atoms] : residues_) {
    for (const auto& [atom, type] : atoms) add(residue, atom, type);
    for (const auto& [atom, type] : patch_atoms_) {
      if (!atoms.contains(atom)) add(residue, atom, type);
    }
  }
  if (table.empty())
    throw InputError(files_, 0, "no type of the topology has NONBONDED parameters; do the files match?");
  return table;
}

}  // namespace meniscus
