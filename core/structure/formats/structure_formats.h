// SPDX-License-Identifier: BSD-3-Clause
// The table of structure formats and their readers, and the choice of one for a file.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/text_file.h"
#include "core/structure/structure.h"

namespace meniscus {

/// What a format is, in words users can look up.
struct FormatMetadata {
  std::string_view name;
  std::string_view extensions;  ///< ".pdb .ent", blank-separated, in lower case
  std::string_view description;
  std::string_view reference;
  std::string_view reads;  ///< which records or columns are used

  /// Does the path, in letters of any case, end as files of the format do?
  bool names(std::string_view path) const;
};

/// Which models (frames) of a file are wanted. They count from 1 in the order of the file, whatever numbers it gives.
struct ModelChoice {
  std::int32_t number = 1;
  bool all = false;
  bool takes(std::int32_t model) const { return all || model == number; }
};

/// The atoms of the wanted models in the order of the file, nothing left out. Positions are finite. The other models
/// are counted, not checked.
struct FileContents {
  std::vector<Atom> atoms;                 ///< Atom::model says of which model
  std::vector<Bond> bonds;                 ///< those the file lists, of the first of these models or of all
  std::vector<std::int32_t> fully_bonded;  ///< models whose bonds are all listed by the file
  std::vector<bool> sites;                 ///< which atoms are virtual sites or Drude particles; empty: none is known
  std::string unknown_elements;            ///< why it names no elements, and what to do; empty: it names them
  bool without_positions = false;          ///< a topology (PSF, prmtop): all positions are the origin
  std::size_t models = 0;                  ///< in the whole file
  bool of_molecules = false;               ///< the models are molecules or poses, not states of one molecule
  std::size_t other_model_atoms = 0;
  FileRadii radii = FileRadii::none;
  std::string experiment;  ///< as Structure::experiment
  std::vector<Warning> warnings;
};

/// One format. `recognizes` looks at content only and may say yes to what another format reads too; `read` throws
/// InputError with file and line. `assemblies` is null for formats that describe none. `positions`, where there is one,
/// quickly gives the positions (Å) that `read` gives for a text of one model; false: ask `read`, which may say what is
/// wrong.
struct Reader {
  FormatMetadata metadata;
  bool (*recognizes)(std::string_view text);
  FileContents (*read)(const TextFile& file, const ModelChoice& models);
  std::vector<Assembly> (*assemblies)(const TextFile& file) = nullptr;
  bool (*positions)(std::string_view model, std::vector<glm::dvec3>& positions) = nullptr;
};

extern const Reader kPdbReader;
extern const Reader kMmcifReader;
extern const Reader kBinaryCifReader;
extern const Reader kSdfReader;
extern const Reader kMol2Reader;
extern const Reader kPdbqtReader;
extern const Reader kPqrReader;
extern const Reader kGroReader;
extern const Reader kXyzReader;
extern const Reader kXyzrReader;
extern const Reader kPsfReader;
extern const Reader kPrmtopReader;
extern const Reader kCharmmCrdReader;

/// The three or nine numbers of the box line of GRO, nm; empty if it is no such line. Numbers that fill their columns
/// touch, and are parted by their decimals, which are as many in each.
std::vector<double> gro_box(std::string_view line);

/// All formats, as people list them.
std::span<const Reader* const> readers();

/// "PDB, mmCIF, BinaryCIF, SDF, MOL2, PDBQT, PQR, GRO, XYZ, XYZR, CRD, PSF, prmtop"
std::string format_names();

/// read_text_file, or, where a file is BinaryCIF, its bytes.
TextFile read_molecule_file(const std::string& path);

/// The reader of a file: the format of its name if its content may be that, else the one its content is.
/// Throws InputError where the content is clearly another format than the name says, and where it is none.
const Reader& choose_reader(const TextFile& file);

}  // namespace meniscus
