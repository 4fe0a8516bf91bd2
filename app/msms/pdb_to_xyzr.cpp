// SPDX-License-Identifier: BSD-3-Clause
// The programs `meniscus-pdb_to_xyzr` and, by that name, `meniscus-pdb_to_xyzrn`: spheres of a molecule for MSMS.
#include <iostream>
#include <iterator>

#include "app/process/program_main.h"
#include "app/process/system_process.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/structure/formats/read_structure.h"

namespace meniscus::msms {
namespace {

constexpr std::string_view kHelp = R"([-h] [-c] [FILE]

Writes the atoms of a molecule (PDB, mmCIF, SDF, MOL2, ...; - or nothing: standard input) as spheres, in their order:
  pdb_to_xyzr   x y z radius
  pdb_to_xyzrn  x y z radius 1 ATOM_RESIDUE_NUMBER

  -h      with hydrogens: radii of Bondi (1964); else united atoms, radii of Chothia (1976), hydrogens left out
  -c      pdb_to_xyzrn: the chain after the number, ATOM_RESIDUE_NUMBER_CHAIN
  --help  this help

Water and ions are written too. Of several models the first is read, of alternate locations the most occupied.
)";

struct Request {
  bool hydrogens = false, chains = false, help = false;
  std::string file = "-";
};

Request parse(std::span<const char* const> words, bool named) {
  Request request;
  bool has_file = false;
  for (const std::string_view word : words) {
    if (word == "-h") {
      request.hydrogens = true;
    } else if (word == "-c" && named) {
      request.chains = true;
    } else if (word == "--help") {
      request.help = true;
    } else if (has_file || (word.size() > 1 && word.front() == '-')) {
      throw UsageError("{} is not understood; see --help", in_quotes(word));
    } else {
      request.file = word;
      has_file = true;
    }
  }
  return request;
}

/// Returns a name without blanks, which would end the column.
std::string without_blanks(std::string_view name) {
  std::string text;
  for (const char c : name)
    if (c != ' ' && c != '\t') text += c;
  return text;
}

std::string name_of(const Atom& atom, bool chains) {
  std::string name =
      without_blanks(atom.name) + "_" + without_blanks(atom.residue_name) + "_" + std::to_string(atom.residue_number);
  if (atom.insertion_code != ' ') name += atom.insertion_code;
  return chains ? name + "_" + without_blanks(atom.chain) : name;
}

std::string rows_of(const Structure& structure, const Request& request, bool named) {
  std::string text;
  for (const Atom& atom : structure.atoms) {
    const glm::dvec3& x = atom.position;
    if (named)
      fmt::format_to(std::back_inserter(text), "{:f} {:f} {:f} {:f} 1 {}\n", x.x, x.y, x.z, atom.radius,
                     name_of(atom, request.chains));
    else
      fmt::format_to(std::back_inserter(text), "{:8.3f} {:8.3f} {:8.3f} {:.2f}\n", x.x, x.y, x.z, atom.radius);
  }
  return text;
}

void run(std::span<const char* const> words, bool named) {
  const Request request = parse(words, named);
  if (request.help) {
    std::cout << (named ? "pdb_to_xyzrn " : "pdb_to_xyzr ") << kHelp;
    return finish_standard_output();
  }
  ReadOptions options;
  options.keep_water = options.keep_ions = options.takes_ligands = true;
  options.radii.set = request.hydrogens ? "bondi" : "united";
  options.radii.may_cover_none = true;  // ligands get the radii of their elements
  options.hydrogens = request.hydrogens ? Hydrogens::keep : Hydrogens::drop;
  const Structure structure = read_structure(request.file, options);
  for (const Warning& warning : structure.report.warnings) std::cerr << escaped(warning.text) << "\n";
  std::cout << rows_of(structure, request, named);
  finish_standard_output();
}

}  // namespace
}  // namespace meniscus::msms

int main(int argc, char** argv) {
  using namespace meniscus;
  const std::span<const char* const> words = system_process::words(argc, argv);
  const bool named = !words.empty() && text_of_path(path_of_text(words[0]).stem()).ends_with("xyzrn");
  return program_main(named ? "pdb_to_xyzrn" : "pdb_to_xyzr", [=] {
    msms::run(words.subspan(1), named);
    return kExitOk;
  });
}
