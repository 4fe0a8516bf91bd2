// SPDX-License-Identifier: BSD-3-Clause
// Gives each atom its radius: by tables, sets and overrides in their order, with an account of where each came from.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/structure/radii/radii_file.h"
#include "core/structure/radii/radii_set.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

enum class FileRadii : std::uint8_t;
struct Atom;
struct Structure;

/// The radius of some atoms, whatever else says.
struct RadiusOverride {
  Selection atoms;
  double radius;  ///< Å, above 0
};

struct RadiiOptions {
  std::string set{};                        ///< "bondi", "united", "protor" or "file"; empty: file if it has usual ones
  std::vector<std::string> files{};         ///< read_radii_files; the last that covers an atom counts, then the set
  std::vector<RadiusOverride> overrides{};  ///< the last that selects an atom counts
  bool may_cover_none = false;              ///< no error where neither set nor files have a radius for any atom
};

/// Reads "EXPR=R", cut at the last "=". Throws SelectionError.
RadiusOverride parse_radius_override(const std::string& text);

/// Where radii come from, once files are read.
class RadiiChoice {
 public:
  /// atoms: all of the file; beads of Martini among them get the radii of their version if no set is asked for. Throws
  /// InputError: an unknown set, one that is not for beads where there are some, "file" for a molecule file without
  /// radii, a set or files that cover none of the atoms, or what read_radii_files throws.
  RadiiChoice(const RadiiOptions& options, const std::string& molecule_file, FileRadii file_radii,
              std::span<const Atom> atoms = {});

  bool from_molecule_file() const { return from_file_; }
  /// Do the radii contain hydrogens, so that these are left out unless the user keeps them? `any`: the molecule has
  /// some.
  bool united(bool any_hydrogens) const;

  /// Gives every atom its radius and leaves out those whose radius is zero (tables say so of some hydrogens). Fills in
  /// Structure::radii_set and radius_classes. Warns of atoms that neither files nor set cover, which get Bondi's radius
  /// of their element; of explicit hydrogens beside united atoms; of elements without a published radius; of overrides
  /// that select nothing. Returns the labels of atoms whose radius is a guess, because their element is unknown.
  std::vector<std::string> assign(Structure& structure) const;

 private:
  struct Given {
    FoundRadius found;
    bool covered = true;  // by what the user chose, not by the element as a last resort
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
