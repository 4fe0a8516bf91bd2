// SPDX-License-Identifier: BSD-3-Clause
// The table of structure formats and their readers, and the choice of a reader for a file.
#pragma once

#include "core/base/text_file.h"
#include "core/structure/structure.h"

namespace meniscus {

/// The description of a format for users.
struct FormatMetadata {
  std::string_view name;
  std::string_view extensions;  ///< ".pdb .ent", separated by blanks, in lower case
  std::string_view description;
  std::string_view reference;
  std::string_view reads;  ///< records or columns that are used

  /// True if the path ends as files of this format do, in upper or lower case.
  bool names(std::string_view path) const;
};

/// The models (frames) to read from a file. They count from 1 in the order of the file, whatever numbers the file has.
struct ModelChoice {
  std::int32_t number = 1;  ///< number of the only model to read, from 1
  bool all = false;         ///< true: all models are read
  bool takes(std::int32_t model) const { return all || model == number; }
};

/// All atoms of the models that were read, in the order of the file. Positions are finite. Atoms of other models are
/// counted but not checked.
struct FileContents {
  std::vector<Atom> atoms;  ///< Atom::model has the number of the model
  std::vector<Bond> bonds;  ///< bonds that the file lists, either for the first of these models or for all
  std::vector<std::int32_t> fully_bonded;  ///< models whose bonds are all listed by the file
  std::vector<bool> sites;                 ///< true for virtual sites and Drude particles; empty if there are none
  std::string unknown_elements;            ///< why the file has no elements, and what to do; empty if it has them
  bool without_positions = false;          ///< true for a topology (PSF, prmtop), in which all positions are the origin
  std::size_t models = 0;                  ///< number of models in the whole file
  bool of_molecules = false;               ///< true if models are molecules or poses, not states of one molecule
  std::size_t other_model_atoms = 0;       ///< number of atoms in models that were not read
  FileRadii radii = FileRadii::none;
  std::string experiment;  ///< see Structure::experiment
  std::vector<Warning> warnings;
};

/// A format and its functions. `recognizes` looks at the content only, and may be true for files of another format,
/// too. `read` throws InputError with file and line. `assemblies` is null for formats without assemblies. `positions`
/// is a faster `read` for the positions (Å) of a text of one model, or null. If it returns false, `read` has to be
/// called, which may report an error.
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

/// Returns the three or nine numbers of the box line of GRO, in nm. The result is empty if it is no such line. Numbers
/// that fill their columns touch each other. They are separated by their decimals, which are equally many in each.
std::vector<double> gro_box(std::string_view line);

/// Returns all formats in the order in which they are listed for users.
std::span<const Reader* const> readers();

/// Returns "PDB, mmCIF, BinaryCIF, SDF, MOL2, PDBQT, PQR, GRO, XYZ, XYZR, CRD, PSF, prmtop".
std::string format_names();

/// Reads a file as read_text_file does. For BinaryCIF the text is the bytes of the file.
TextFile read_molecule_file(const std::string& path);

/// Returns the reader for a file: that of the format of its name if the content may have this format, else that of the
/// content. Throws InputError if the content clearly has another format than the name, or if it has none.
const Reader& choose_reader(const TextFile& file);

}  // namespace meniscus
