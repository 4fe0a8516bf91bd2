// SPDX-License-Identifier: BSD-3-Clause
// Lists the structure formats and chooses the one that fits the content of a file.
#include "core/structure/formats/structure_formats.h"

#include <algorithm>

#include "core/structure/formats/cif_document.h"

namespace meniscus {
namespace {

/// A new format has a file read_<name>.cpp, a declaration in structure_formats.h and an entry in both lists.
constexpr std::array<const Reader*, 13> kReaders{
    &kPdbReader, &kMmcifReader, &kBinaryCifReader, &kSdfReader,       &kMol2Reader, &kPdbqtReader, &kPqrReader,
    &kGroReader, &kXyzReader,   &kXyzrReader,      &kCharmmCrdReader, &kPsfReader,  &kPrmtopReader};

/// Strict tests come first. PDB accepts any text with one of its records in it, including PQR and PDBQT.
constexpr std::array<const Reader*, 13> kOrderOfTrial{
    &kBinaryCifReader, &kPsfReader, &kPrmtopReader, &kCharmmCrdReader, &kMmcifReader, &kMol2Reader, &kSdfReader,
    &kGroReader,       &kXyzReader, &kPdbqtReader,  &kPdbReader,       &kPqrReader,   &kXyzrReader};
static_assert(kReaders.size() == kOrderOfTrial.size());

const Reader* reader_by_name(std::string path) {
  if (path.ends_with(".gz")) path.resize(path.size() - 3);
  const auto found = std::ranges::find_if(kReaders, [&](const Reader* reader) { return reader->metadata.names(path); });
  return found == kReaders.end() ? nullptr : *found;
}

/// Throws InputError for formats that are recognized but not read, so that they are not misread as PDB.
void refuse_known_foreign(const TextFile& file) {
  const std::size_t first = file.text.find_first_not_of(" \t\n");
  if (file.text[first] == '<')
    throw InputError(file.path, 0, "looks like HTML or XML, not like a molecule; was the download refused?");
  if (file.text[first] == '{') throw InputError(file.path, 0, "looks like JSON; {} are read", format_names());
}

}  // namespace

std::span<const Reader* const> readers() { return kReaders; }

bool FormatMetadata::names(std::string_view path) const {
  const std::string lower = lower_case(path);
  return std::ranges::any_of(fields_of(extensions), [&](std::string_view end) { return lower.ends_with(end); });
}

std::string format_names() {
  std::string names;
  for (const Reader* reader : kReaders) {
    if (!names.empty()) names += ", ";
    names += reader->metadata.name;
  }
  return names;
}

TextFile read_molecule_file(const std::string& path) {
  std::string bytes = read_file_bytes(path);
  const std::string name = path == "-" ? "standard input" : path;
  return is_binary_cif(bytes) ? TextFile{name, std::move(bytes)} : text_of_bytes(name, std::move(bytes));
}

const Reader& choose_reader(const TextFile& file) {
  const Reader* by_name = reader_by_name(file.path);
  if (by_name && by_name->recognizes(file.text)) return *by_name;
  refuse_known_foreign(file);
  for (const Reader* reader : kOrderOfTrial) {
    if (!reader->recognizes(file.text)) continue;
    if (!by_name) return *reader;
    throw InputError(file.path, 0,
                     "the name says {}, but the content is {}; rename the file, or check that it is the "
                     "right one",
                     by_name->metadata.name, reader->metadata.name);
  }
  if (by_name) return *by_name;  // this reader reports what is missing, and where
  throw InputError(file.path, 0, "is in none of the formats that are read ({})", format_names());
}

}  // namespace meniscus
