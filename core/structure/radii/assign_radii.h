// SPDX-License-Identifier: BSD-3-Clause
// Assigns a radius to each atom from tables, sets and overrides, and records the source of each radius.
#pragma once

#include "core/structure/radii/radii_set.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

enum class FileRadii : std::uint8_t;
struct Atom;
struct Structure;

/// A radius of some atoms that replaces any other.
struct RadiusOverride {
  Selection atoms;
  double radius;  ///< Å, greater than 0
};

/// The choice of radii.
struct RadiiOptions {
  /// "bondi", "united", "protor" or "file"; empty: "file" if the file has usual radii, else "bondi".
  std::string set{};
  /// Files for read_radii_files; the last one that covers an atom is used, then the set.
  std::vector<std::string> files{};
  std::vector<RadiusOverride> overrides{};  ///< the last one that selects an atom is used
  bool may_cover_none = false;  ///< if true, there is no error if neither set nor files have a radius for any atom
};

/// Parses "EXPR=R", split at the last "=". Throws SelectionError.
RadiusOverride parse_radius_override(const std::string& text);

/// The tables and sets from which radii are assigned.
class RadiiChoice {
 public:
  /// Reads the files. atoms: all atoms of the molecule file. Beads of Martini among them have the radii of their
  /// version if no set is requested. Throws InputError for an unknown set, a set without beads for a file with beads,
  /// "file" for a molecule file without radii, and a set or files that cover none of the atoms, and as read_radii_files
  /// does. `options` must outlive this object.
  RadiiChoice(const RadiiOptions& options, const std::string& molecule_file, FileRadii file_radii,
              std::span<const Atom> atoms = {});

  /// True if the radii of the molecule file are used.
  bool from_molecule_file() const { return from_file_; }
  /// True if the radii include hydrogens, so that hydrogens are left out unless the user keeps them. any_hydrogens:
  /// true if the molecule has hydrogens.
  bool united(bool any_hydrogens) const;

  /// Assigns a radius to every atom, and leaves out atoms of radius zero (which tables give to some hydrogens).
  /// Structure::radii_set and radius_classes are filled in. Warnings are added for atoms that neither files nor set
  /// cover, which get Bondi's radius of their element, for explicit hydrogens with united atoms, for elements without a
  /// published radius, and for overrides that select nothing. Returns the labels of atoms whose radius is a guess
  /// because their element is unknown.
  std::vector<std::string> assign(Structure& structure) const;

 private:
  struct Given {
    FoundRadius found;
    // False for Bondi's radius of the element, if the user chose other radii.
    bool is_covered = true;
  };
  void refuse_covering_none(const std::string& molecule_file, std::span<const Atom> atoms) const;
  Given radius_for(const Atom& atom, bool hydrogens_used) const;
  std::vector<Given> radii_for(const Structure& structure, bool hydrogens_used) const;
  void override_radii(Structure& structure, std::vector<Given>& given) const;
  void warn(Structure& structure, const std::vector<Given>& given) const;
  std::string name() const;

  const RadiiOptions& options_;
  std::vector<RadiiTable> tables_;
  const RadiiSet* set_ = &kBondiSet;
  bool from_file_ = false;
};

}  // namespace meniscus
