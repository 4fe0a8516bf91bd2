// SPDX-License-Identifier: BSD-3-Clause
// Tells files of radii apart and reads those of one line an atom or pattern.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parse_number.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/radii/charmm_radii.h"
#include "core/structure/radii/radii_file.h"

namespace meniscus {
namespace {

enum class RadiiFormat { atom_types, freesasa, charmm, force_field, plain };

using Fields = std::vector<std::string_view>;

/// Fields of a line without its comment.
Fields fields_before_comment(std::string_view line, std::string_view comments = "#") {
  return fields_of(line.substr(0, line.find_first_of(comments)));
}

double radius_field(const TextFile& file, std::size_t line, std::string_view field) {
  return parse_radius(file, line, field, "a name and a radius");
}

RadiiFormat format_of(const TextFile& file) {
  LineReader lines(file.text);
  std::size_t most_fields = 0;
  for (std::string_view line; lines.next(line);) {
    const Fields fields = fields_before_comment(line, "#!");
    if (fields.empty()) continue;
    if (fields[0] == "types:" || fields[0] == "atoms:") return RadiiFormat::freesasa;
    if (fields[0] == "radius" && fields.size() >= 4) return RadiiFormat::atom_types;
    if (is_charmm_line(fields)) return RadiiFormat::charmm;
    most_fields = std::max(most_fields, fields.size());
  }
  if (most_fields >= 4) return RadiiFormat::force_field;
  if (most_fields == 3) return RadiiFormat::plain;
  throw InputError(file.path, 0,
                   "is no table of radii that is read: atmtypenumbers, FreeSASA .config, CHARMM topology and "
                   "parameters, PDB2PQR .DAT, or lines RESIDUE ATOM RADIUS");
}

/// "radius KEY DISTANCE EXPLICIT [UNITED]", then "RESIDUES ATOMS KEY" with patterns, underscores for blanks.
RadiiTable read_atom_types(const TextFile& file) {
  RadiiTable table(file.path, "atom types");
  std::map<std::string, RadiiTable::Entry, std::less<>> radii;
  LineReader lines(file.text);
  for (std::string_view line; lines.next(line);) {
    const Fields fields = fields_before_comment(line);
    if (fields.empty()) continue;
    if (fields.size() < 3 || (fields[0] == "radius" && fields.size() < 4)) {
      throw InputError(file.path, lines.number(), "is neither 'radius KEY DISTANCE RADIUS' nor 'RESIDUE ATOM KEY'");
    }
    if (fields[0] == "radius") {
      const double explicit_radius = radius_field(file, lines.number(), fields[3]);
      const double united = fields.size() > 4 ? radius_field(file, lines.number(), fields[4]) : explicit_radius;
      radii[std::string(fields[1])] = {explicit_radius, united, fmt::format("type {}", fields[1])};
      continue;
    }
    const auto radius = radii.find(fields[2]);
    if (radius == radii.end()) {
      throw InputError(file.path, lines.number(),
                       fmt::format("type {} has no radius line above", in_quotes(fields[2])));
    }
    std::string atom(fields[1]);
    std::erase(atom, '_');
    try {
      table.add(NamePattern(fields[0]), NamePattern(atom), radius->second);
    } catch (const InputError&) {
      throw;
    } catch (const Error& error) {
      throw InputError(file.path, lines.number(), error.what());
    }
  }
  return table;
}

/// Sections "types:" with NAME RADIUS [CLASS] and "atoms:" with RESIDUE ATOM TYPE.
RadiiTable read_freesasa(const TextFile& file) {
  RadiiTable table(file.path, "FreeSASA");
  std::map<std::string, double, std::less<>> types;
  LineReader lines(file.text);
  std::string section;
  for (std::string_view line; lines.next(line);) {
    const Fields fields = fields_before_comment(line);
    if (fields.empty()) continue;
    if (fields[0].ends_with(':')) {
      section = fields[0];
    } else if (section == "types:" && fields.size() >= 2) {
      types[std::string(fields[0])] = radius_field(file, lines.number(), fields[1]);
    } else if (section == "atoms:" && fields.size() >= 3) {
      const auto type = types.find(fields[2]);
      if (type == types.end()) {
        throw InputError(file.path, lines.number(), fmt::format("{} is none of its types", in_quotes(fields[2])));
      }
      table.add(fields[0] == "ANY" ? "*" : std::string(fields[0]), std::string(fields[1]),
                {type->second, type->second, std::string(fields[2])});
    } else if (section != "name:") {
      throw InputError(file.path, lines.number(), "belongs to no section types: or atoms:, or is too short");
    }
  }
  return table;
}

/// RESIDUE ATOM [CHARGE] RADIUS.
RadiiTable read_lines(const TextFile& file, bool with_charge) {
  RadiiTable table(file.path, with_charge ? "force field" : "list");
  const std::size_t place = with_charge ? 3 : 2;
  LineReader lines(file.text);
  for (std::string_view line; lines.next(line);) {
    const Fields fields = fields_before_comment(line, "#!");
    if (fields.empty()) continue;
    if (fields.size() <= place) {
      throw InputError(
          file.path, lines.number(),
          fmt::format("has {} fields; RESIDUE ATOM {}RADIUS are needed", fields.size(), with_charge ? "CHARGE " : ""));
    }
    const double radius = radius_field(file, lines.number(), fields[place]);
    const bool any = fields[0] == "ANY" || fields[0] == "*";
    const bool typed = with_charge && fields.size() > 4;
    table.add(any ? "*" : std::string(fields[0]), std::string(fields[1]),
              {radius, radius, typed ? std::string(fields[4]) : fmt::format("{} {}", fields[0], fields[1])});
  }
  return table;
}

}  // namespace

std::vector<RadiiTable> read_radii_files(const std::vector<std::string>& paths) {
  std::vector<RadiiTable> tables;
  CharmmRadii charmm;
  std::size_t charmm_place = 0;
  for (const std::string& path : paths) {
    const TextFile file = read_text_file(path);
    switch (format_of(file)) {
      case RadiiFormat::atom_types:
        tables.push_back(read_atom_types(file));
        break;
      case RadiiFormat::freesasa:
        tables.push_back(read_freesasa(file));
        break;
      case RadiiFormat::charmm:
        charmm.read(file);
        charmm_place = tables.size();
        continue;
      case RadiiFormat::force_field:
        tables.push_back(read_lines(file, true));
        break;
      case RadiiFormat::plain:
        tables.push_back(read_lines(file, false));
        break;
    }
    if (tables.back().empty()) throw InputError(path, 0, "gives no atom a radius");
  }
  if (!charmm.empty()) tables.insert(tables.begin() + static_cast<std::ptrdiff_t>(charmm_place), charmm.table());
  return tables;
}

}  // namespace meniscus
