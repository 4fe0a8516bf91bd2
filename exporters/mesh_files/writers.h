// SPDX-License-Identifier: BSD-3-Clause
// The content of a mesh file in any format, the writers of the formats, and their shared tools: rows of bytes, rows of
// text, text in XML, zip archives.
//
// Each writer writes its whole file but does not commit it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <type_traits>
#include <utility>

#include <tbb/parallel_for.h>

#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/math/rigid_motion.h"

namespace meniscus {

enum class PatchKind : std::uint8_t;

/// A number for each vertex. The name consists of letters, digits and underscores.
struct VertexNumbers {
  std::string name;
  std::vector<float> values;  ///< NaN for a vertex without a value
};

/// The properties of an atom that files may contain. The texts come from a molecule file.
struct FileAtom {
  std::string name, residue_name, chain;
  std::int32_t residue_number = 0;
  char insertion_code = ' ';
  glm::dvec3 position{0.0};  ///< Å
};

/// An object of a file. Its arrays have one entry per vertex unless they say otherwise.
struct FileObject {
  std::string name;                                     ///< may contain text from a molecule file
  std::vector<glm::vec3> positions;                     ///< in the unit of the file
  std::vector<glm::vec3> normals;                       ///< unit vectors towards the solvent
  std::vector<std::array<std::uint8_t, 3>> colors;      ///< sRGB
  std::vector<float> opacities;                         ///< in (0, 1]; empty if the object is opaque
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from the solvent
  /// sRGB per triangle, which changes exactly at borders of patches. Empty for colours of a map and joined objects.
  std::vector<std::array<std::uint8_t, 3>> triangle_colors;
  std::vector<VertexNumbers> numbers;    ///< the same names in all objects of a file
  std::vector<std::uint32_t> atom;       ///< index into MeshFile::atoms
  std::vector<PatchKind> kind;           ///< kind of the patch
  std::vector<glm::vec3> velocities;     ///< in the unit of the file per frame of the run; empty if unknown
  std::vector<std::uint32_t> component;  ///< per triangle: number of the closed part, unique in the file
  bool is_cavity = false;                ///< true if all parts of the object bound cavities
  /// The motions to each place of the object, in the unit of the file; at least one. Only formats with
  /// MeshFormat::places have several, or one that is not the identity.
  std::vector<RigidMotion> places{RigidMotion{}};

  /// Returns true if the object is in one place and is not moved.
  bool is_placed_once() const {
    return places.size() == 1 && places[0].rotation == glm::dmat3(1.0) && places[0].translation == glm::dvec3(0.0);
  }
};

/// The material of a file's objects, in terms of microfacet models.
struct FileMaterial {
  float roughness = 0.5f;  ///< in [0, 1]
  float ior = 1.5f;        ///< index of refraction, at least 1; there are no highlights at 1
};

/// The whole content of a file.
struct MeshFile {
  std::vector<FileObject> objects;  ///< at least one
  std::vector<FileAtom> atoms;
  double scale = 1.0;  ///< the length of 1 Å in the unit of the file
  FileMaterial material;
  std::string about;  ///< one line with the program, the content and the scale
  /// A point inside a cavity or a solid, with the number of its component.
  struct InnerPoint {
    glm::dvec3 position{0.0};  ///< in the unit of the file
    std::uint32_t component = 0;
  };
  std::vector<InnerPoint> cavities, solids;
};

/// The times of the frames of one file.
struct RunTimes {
  std::vector<std::uint64_t> places;  ///< number of each frame in the run, from 1
  double per_second = 25.0;           ///< frames per second
};

/// Binary STL (3D Systems, "StereoLithography Interface Specification", 1989): triangles with their normals alone.
void write_stl(OutputFile& file, const MeshFile& mesh);
/// 3MF core specification 1.3 with the materials extension's colour groups: a zip archive.
void write_3mf(OutputFile& file, const MeshFile& mesh);
/// Wavefront OBJ: vertices with colours after their coordinates, normals, and an `o` for each object.
void write_obj(OutputFile& file, const MeshFile& mesh);
/// Object File Format of Geomview, as text: positions and triangles alone.
void write_off(OutputFile& file, const MeshFile& mesh);
/// glTF 2.0 in one binary file (ISO/IEC 12113:2022, 4.4); numbers are attributes that begin with an underscore.
void write_glb(OutputFile& file, const MeshFile& mesh);
/// VTK's XML polygons with raw appended arrays (W. Schroeder et al., "The VTK user's guide", 2010, section 19.3).
void write_vtp(OutputFile& file, const MeshFile& mesh);
/// TetGen's facets with a marker for each component, points in cavities as holes, points in solids as regions (H. Si,
/// "TetGen user's manual", 2013, section 5.2.3).
void write_smesh(OutputFile& file, const MeshFile& mesh);
/// Dots of the program dms (C. Huang, UCSF; its manual page): each atom is followed by its vertices with kind, area and
/// normal. Coordinates are in Å for any scale of the file.
void write_dms(OutputFile& file, const MeshFile& mesh);
/// Binary little-endian PLY (G. Turk 1994).
void write_ply(OutputFile& file, const MeshFile& mesh);
/// PLY as text, with the same content as write_ply().
void write_ascii_ply(OutputFile& file, const MeshFile& mesh);
/// A Python script for PyMOL, with a compiled graphics object for each object. All arguments in it are numbers.
void write_pymol_script(OutputFile& file, const MeshFile& mesh);
/// USD as text (Universal Scene Description 1.0, OpenUSD's .usda): an Xform with a Mesh for each object, in metres,
/// y upwards; numbers are primvars. A run has samples of the whole mesh at each frame, because vertices do not
/// correspond from frame to frame; velocities allow motion blur.
void write_usda(OutputFile& file, const MeshFile& mesh);
void write_usda_run(OutputFile& file, std::span<const MeshFile> frames, const RunTimes& times);
/// USD as text in an archive (OpenUSD's specification of USDZ): stored without compression at a multiple of 64 bytes.
void write_usdz(OutputFile& file, const MeshFile& mesh);
void write_usdz_run(OutputFile& file, std::span<const MeshFile> frames, const RunTimes& times);
/// Returns the text that write_usda() writes, or write_usda_run() if `times` is not nullptr.
std::string usd_text(std::span<const MeshFile> frames, const RunTimes* times);
/// Returns the header of a PLY file. form: "binary_little_endian" or "ascii".
std::string ply_header(std::string_view form, const MeshFile& mesh);

static_assert(std::endian::native == std::endian::little);

/// Collects bytes of values as they are in memory, in little-endian order.
class BinaryRows {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  template <class T>
  void put_all(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto more = std::as_bytes(values);
    bytes_.insert(bytes_.end(), more.begin(), more.end());
  }
  void put_text(std::string_view text) { put_all(std::span<const char>(text)); }
  /// Appends `with` until the size is a multiple of `size`.
  void pad(std::size_t size, char with) {
    while (bytes_.size() % size != 0) put(with);
  }

  std::size_t size() const { return bytes_.size(); }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

/// Returns `beginning` and the texts that put_row(n, out) writes for n below `count`, in order but in parallel.
template <typename PutRow>
std::string text_of_rows(std::string beginning, std::size_t count, const PutRow& put_row) {
  constexpr std::size_t kChunk = 4096;
  std::vector<fmt::memory_buffer> parts((count + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
    const std::size_t past = std::min(count, (part + 1) * kChunk);
    for (std::size_t n = part * kChunk; n < past; ++n) put_row(n, std::back_inserter(parts[part]));
  });
  std::size_t size = beginning.size();
  for (const auto& part : parts) size += part.size();
  beginning.reserve(size);
  for (const auto& part : parts) beginning.append(part.data(), part.size());
  return beginning;
}

/// Returns the values with 0 in place of those that are not finite, for formats that cannot express missing numbers.
inline std::vector<float> zero_for_missing(std::vector<float> values) {
  std::ranges::replace_if(
      values, [](float x) { return !std::isfinite(x); }, 0.0f);
  return values;
}

/// Returns text for XML: markup characters become entities, and bytes outside of printable ASCII become '_'.
inline std::string xml_text(std::string_view text) {
  std::string safe(text);
  std::ranges::replace_if(
      safe, [](char c) { return c < ' ' || c > '~'; }, '_');
  return markup_text(safe);
}

/// Builds an archive according to PKWARE's APPNOTE 6.3.3: local headers with their content, the central directory, and
/// its end record. All times are the earliest of the format, so that equal content gives equal bytes.
class ZipArchive {
 public:
  /// Adds a file in compressed form. Throws CapacityError for content of 4 GiB or more.
  void add_deflated(const std::string& name, std::string_view content);
  /// Adds a file uncompressed at a multiple of 64 bytes, as in USDZ. Throws CapacityError for 4 GiB or more.
  void add_stored(const std::string& name, std::string_view content);
  /// Returns the bytes of the archive. It must be called once, after all files were added.
  std::vector<std::byte> finish();

 private:
  struct Entry {
    std::string name;
    std::uint16_t method = 0;
    std::uint32_t checksum = 0, packed = 0, size = 0, place = 0;
  };
  void add(Entry entry, const void* content, std::size_t alignment);

  std::vector<std::byte> bytes_;
  std::vector<Entry> entries_;
};

}  // namespace meniscus
