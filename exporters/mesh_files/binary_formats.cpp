// SPDX-License-Identifier: BSD-3-Clause
// Writes the binary mesh formats: PLY, STL, and VTP, whose XML gives the offset of each array.

#include <array>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {

std::string ply_header(std::string_view form, const MeshFile& mesh) {
  const FileObject& object = mesh.objects.front();
  std::string header =
      fmt::format("ply\nformat {} 1.0\ncomment {}\nelement vertex {}\n", form, mesh.about, object.positions.size());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) header += fmt::format("property float {}\n", name);
  for (const char* name : {"red", "green", "blue"}) header += fmt::format("property uchar {}\n", name);
  for (const VertexNumbers& column : object.numbers) header += fmt::format("property float {}\n", column.name);
  header +=
      fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", object.triangles.size());
  return header;
}

void write_ply(OutputFile& file, const MeshFile& mesh) {
  const FileObject& object = mesh.objects.front();
  BinaryRows rows;
  for (std::size_t v = 0; v < object.positions.size(); ++v) {
    rows.put(object.positions[v]);
    rows.put(object.normals[v]);
    rows.put(object.colors[v]);
    for (const VertexNumbers& column : object.numbers) rows.put(column.values[v]);
  }
  for (const auto& triangle : object.triangles) {
    rows.put(std::uint8_t{3});
    rows.put(triangle);
  }
  file.write(ply_header("binary_little_endian", mesh));
  file.write(rows.bytes());
}

void write_stl(OutputFile& file, const MeshFile& mesh) {
  const FileObject& object = mesh.objects.front();
  if (object.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    throw CapacityError("STL holds 4,294,967,295 triangles at most; ask for a coarser mesh");
  std::array<char, 80> about{};  // must not begin with "solid", which marks text files
  const std::string line = mesh.about.substr(0, about.size());
  std::ranges::copy(line, about.begin());
  BinaryRows rows;
  rows.put(about);
  rows.put(static_cast<std::uint32_t>(object.triangles.size()));
  for (const auto& [a, b, c] : object.triangles) {
    const glm::vec3 &x = object.positions[a], &y = object.positions[b], &z = object.positions[c];
    const glm::dvec3 cross = glm::cross(glm::dvec3(y) - glm::dvec3(x), glm::dvec3(z) - glm::dvec3(x));
    const double size = glm::length(cross);
    rows.put(size > 0.0 ? glm::vec3(cross / size) : glm::vec3(0.0f));
    for (const glm::vec3& corner : {x, y, z}) rows.put(corner);
    rows.put(std::uint16_t{0});
  }
  file.write(rows.bytes());
}

namespace {

/// The arrays of a VTP file. Members append an array and return the XML element that refers to it.
class Arrays {
 public:
  template <class Row>
  std::string of_numbers(const char* type, const std::string& name, int columns, std::span<const Row> rows) {
    std::string line = begin(type, name, columns);
    bytes_.put(std::uint64_t{rows.size_bytes()});
    bytes_.put_all(rows);
    return line;
  }

  /// Appends words, each followed by a zero byte. They may contain all other bytes, because this part of the file is
  /// not parsed as XML.
  std::string of_words(const std::string& name, std::span<const std::string> words) {
    std::string line = begin("String", name, 1);
    std::uint64_t size = 0;
    for (const std::string& word : words) size += word.size() + 1;
    bytes_.put(size);
    for (const std::string& word : words) {
      bytes_.put_text(word);
      bytes_.put('\0');
    }
    return line;
  }

  std::span<const std::byte> bytes() const { return bytes_.bytes(); }

 private:
  std::string begin(const char* type, const std::string& name, int columns) const {
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
        name, columns, bytes_.size());
  }

  BinaryRows bytes_;
};

std::string plain(const std::string& text) { return text.substr(0, text.find('\0')); }

/// Returns the given member of the atom of each vertex.
std::vector<std::string> words_of(const MeshFile& mesh, const FileObject& object, std::string FileAtom::*word) {
  std::vector<std::string> words;
  words.reserve(object.atom.size());
  for (const std::uint32_t a : object.atom) words.push_back(plain(mesh.atoms[a].*word));
  return words;
}

template <class Row>
std::span<const Row> rows_of(const std::vector<Row>& rows) {
  return rows;
}

std::string point_arrays(const MeshFile& mesh, const FileObject& object, Arrays& arrays) {
  std::string text = arrays.of_numbers("Float32", "normal", 3, rows_of(object.normals));
  text += arrays.of_numbers("UInt8", "color", 3, rows_of(object.colors));
  for (const VertexNumbers& column : object.numbers)
    text += arrays.of_numbers("Float32", column.name, 1, rows_of(column.values));
  text += arrays.of_words("atom_name", words_of(mesh, object, &FileAtom::name));
  text += arrays.of_words("residue_name", words_of(mesh, object, &FileAtom::residue_name));
  text += arrays.of_words("chain", words_of(mesh, object, &FileAtom::chain));
  return text;
}

std::string polygon_arrays(const FileObject& object, Arrays& arrays) {
  if (3 * object.triangles.size() > std::numeric_limits<std::int32_t>::max())
    throw CapacityError("VTP is written with 32-bit indices, which these triangles exceed; ask for a coarser mesh");
  std::vector<std::int32_t> ends;
  ends.reserve(object.triangles.size());
  for (std::size_t t = 1; t <= object.triangles.size(); ++t) ends.push_back(static_cast<std::int32_t>(3 * t));
  return arrays.of_numbers("Int32", "connectivity", 1, rows_of(object.triangles)) +
         arrays.of_numbers("Int32", "offsets", 1, rows_of(ends));
}

}  // namespace

void write_vtp(OutputFile& file, const MeshFile& mesh) {
  const FileObject& object = mesh.objects.front();
  Arrays arrays;
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<!-- {} -->\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n",
      xml_text(mesh.about));
  text += fmt::format(
      "<DataArray type=\"Float64\" Name=\"units_per_angstrom\" NumberOfTuples=\"1\" format=\"ascii\">{}"
      "</DataArray>\n</FieldData>\n",
      mesh.scale);
  text += fmt::format(
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n",
      object.positions.size(), object.triangles.size());
  text += "<Points>\n" + arrays.of_numbers("Float32", "points", 3, rows_of(object.positions)) + "</Points>\n";
  text += "<Polys>\n" + polygon_arrays(object, arrays) + "</Polys>\n";
  text += "<PointData Normals=\"normal\">\n" + point_arrays(mesh, object, arrays) + "</PointData>\n";
  text += "<CellData>\n" + arrays.of_numbers("UInt32", "component", 1, rows_of(object.component)) + "</CellData>\n";
  text += "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  file.write(text);
  file.write(arrays.bytes());
  file.write("\n</AppendedData>\n</VTKFile>\n");
}

}  // namespace meniscus
