// SPDX-License-Identifier: BSD-3-Clause
// Declares the options that say which radii atoms get, and what becomes of hydrogens.
#include <map>

#include "app/options/molecule_options.h"
#include "app/options/value_words.h"
#include "core/base/error.h"

namespace meniscus {
namespace {

RadiusOverride radius_override_of(const std::string& text) {
  try {
    return parse_radius_override(text);
  } catch (const SelectionError& error) {
    throw SelectionError("--radius: " + error.sentence(), error.picture());
  }
}

}  // namespace

void add_radii_options(CLI::App& command, ReadOptions& reading) {
  const Heading heading(command, "Radii");
  const std::map<std::string, Hydrogens> words{
      {"keep", Hydrogens::keep}, {"drop", Hydrogens::drop}, {"auto", Hydrogens::automatic}};
  command
      .add_option("--hydrogens", reading.hydrogens,
                  "Hydrogens: keep, drop, or auto (default: dropped where the radii contain them)")
      ->transform(one_of(words))
      ->type_name("WORD");
  std::vector<std::string> sets{"file"};
  for (const RadiiSet* set : radii_sets()) sets.emplace_back(set->name);
  command
      .add_option("--radii", reading.radii.set,
                  "Van der Waals radii: bondi (by element), united (Chothia 1976) and protor (Tsai et al. 1999) for "
                  "atoms that contain their hydrogens, file (the molecule file's own). Default: file if it has "
                  "radii, else bondi")
      ->check(one_of(sets))
      ->type_name("SET");
  command
      .add_option("--radii-file", reading.radii.files,
                  "Radii by residue and atom from a table, before those of the set: atmtypenumbers of MSMS, FreeSASA "
                  ".config, CHARMM .rtf with .prm (or .str), PDB2PQR .DAT, or lines RESIDUE ATOM RADIUS. Repeatable; "
                  "the last file that has the atom counts")
      ->type_size(1)
      ->expected(1, 100)
      ->allow_extra_args(false)
      ->type_name("FILE");
  command
      .add_option_function<std::vector<std::string>>(
          "--radius",
          [&reading](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) reading.radii.overrides.push_back(radius_override_of(text));
          },
          "The radius R in Å of the atoms that EXPR selects, whatever else says; repeatable, the last counts")
      ->allow_extra_args(false)
      ->type_name("EXPR=R");
}

}  // namespace meniscus
