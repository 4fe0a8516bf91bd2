// SPDX-License-Identifier: BSD-3-Clause
// Writes mesh formats without structure of their own: OBJ, OFF, smesh, DMS and scripts for PyMOL as text, PLY as text
// and binary, STL, and VTP, whose XML gives the offset of each array.

#include <cctype>

#include <fmt/compile.h>

#include "core/base/error.h"
#include "core/surface/primitives.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {
namespace {

/// Replaces characters other than letters, digits, '-' and '.' by '_'. Names end at blanks, and programs give some
/// characters a meaning of their own.
std::string plain_name(const std::string& name) {
  std::string plain = name;
  std::ranges::replace_if(
      plain, [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '.'; }, '_');
  return plain;
}

/// Writes the rows of triangles that OFF and PLY have: "3 a b c".
void write_corners(OutputFile& file, const FileObject& object) {
  file.write(text_of_rows("", object.triangles.size(), [&](std::size_t t, auto out) {
    const auto& [a, b, c] = object.triangles[t];
    fmt::format_to(out, FMT_COMPILE("3 {} {} {}\n"), a, b, c);
  }));
}

}  // namespace

void write_obj(OutputFile& file, const MeshFile& mesh) {
  file.write(fmt::format("# {}\n", mesh.about));
  std::size_t first = 1;
  for (const FileObject& object : mesh.objects) {
    file.write(text_of_rows(fmt::format("o {}\n", plain_name(object.name)), object.positions.size(),
                            [&](std::size_t v, auto out) {
                              const glm::vec3& x = object.positions[v];
                              const auto& [red, green, blue] = object.colors[v];
                              fmt::format_to(out, FMT_COMPILE("v {} {} {} {:.4f} {:.4f} {:.4f}\n"), x.x, x.y, x.z,
                                             red / 255.0, green / 255.0, blue / 255.0);
                            }));
    file.write(text_of_rows("", object.normals.size(), [&](std::size_t v, auto out) {
      const glm::vec3& n = object.normals[v];
      fmt::format_to(out, FMT_COMPILE("vn {:.6g} {:.6g} {:.6g}\n"), n.x, n.y, n.z);
    }));
    file.write(text_of_rows("s 1\n", object.triangles.size(), [&](std::size_t t, auto out) {
      const auto& [a, b, c] = object.triangles[t];
      fmt::format_to(out, FMT_COMPILE("f {0}//{0} {1}//{1} {2}//{2}\n"), first + a, first + b, first + c);
    }));
    first += object.positions.size();
  }
}

void write_off(OutputFile& file, const MeshFile& mesh) {
  const FileObject& object = mesh.objects.front();
  file.write(
      text_of_rows(fmt::format("OFF\n# {}\n{} {} 0\n", mesh.about, object.positions.size(), object.triangles.size()),
                   object.positions.size(), [&](std::size_t v, auto out) {
                     const glm::vec3& x = object.positions[v];
                     fmt::format_to(out, FMT_COMPILE("{} {} {}\n"), x.x, x.y, x.z);
                   }));
  write_corners(file, object);
}

void write_ascii_ply(OutputFile& file, const MeshFile& mesh) {
  const FileObject& object = mesh.objects.front();
  file.write(text_of_rows(ply_header("ascii", mesh), object.positions.size(), [&](std::size_t v, auto out) {
    const glm::vec3 &x = object.positions[v], &n = object.normals[v];
    const auto& [red, green, blue] = object.colors[v];
    fmt::format_to(out, FMT_COMPILE("{} {} {} {} {} {} {} {} {}"), x.x, x.y, x.z, n.x, n.y, n.z, red, green, blue);
    for (const VertexNumbers& column : object.numbers) fmt::format_to(out, FMT_COMPILE(" {}"), column.values[v]);
    *out = '\n';
  }));
  write_corners(file, object);
}

namespace {

// The beginning of a script. A call for each object follows, whose arguments are numbers in quotes.
constexpr std::string_view kPymolScript = R"(from pymol import cmd
from pymol.cgo import BEGIN, COLOR, END, NORMAL, TRIANGLES, VERTEX

def show_of_meniscus(name, vertices, triangles):
    """Loads an object from rows: position, normal and color of vertices; vertices and, if any, color of triangles."""
    corners = [list(map(float, line.split())) for line in vertices.strip().splitlines()]
    shape = [BEGIN, TRIANGLES]
    for line in triangles.strip().splitlines():
        numbers = list(map(int, line.split()))
        for corner in (corners[n] for n in numbers[:3]):
            shape += [COLOR, *(c / 255 for c in numbers[3:] or corner[6:]), NORMAL, *corner[3:6], VERTEX, *corner[:3]]
    cmd.load_cgo(shape + [END], name, 1)

)";

}  // namespace

void write_pymol_script(OutputFile& file, const MeshFile& mesh) {
  file.write(fmt::format("# {}\n{}", mesh.about, kPymolScript));
  std::size_t place = 0;
  for (const FileObject& object : mesh.objects) {
    const std::string beginning = fmt::format("show_of_meniscus(\"meniscus_{}\", \"\"\"\n", ++place);
    file.write(text_of_rows(beginning, object.positions.size(), [&](std::size_t v, auto out) {
      const glm::vec3 &x = object.positions[v], &n = object.normals[v];
      const auto& [red, green, blue] = object.colors[v];
      fmt::format_to(out, FMT_COMPILE("{} {} {} {:.6g} {:.6g} {:.6g} {} {} {}\n"), x.x, x.y, x.z, n.x, n.y, n.z, red,
                     green, blue);
    }));
    file.write(text_of_rows("\"\"\", \"\"\"\n", object.triangles.size(), [&](std::size_t t, auto out) {
      fmt::format_to(out, FMT_COMPILE("{} {} {}"), object.triangles[t][0], object.triangles[t][1],
                     object.triangles[t][2]);
      if (!object.triangle_colors.empty()) {
        const auto& [red, green, blue] = object.triangle_colors[t];
        fmt::format_to(out, FMT_COMPILE(" {} {} {}"), red, green, blue);
      }
      *out = '\n';
    }));
    file.write("\"\"\")\n");
  }
}

// All indices in smesh files count from 1.

void write_smesh(OutputFile& file, const MeshFile& mesh) {
  const FileObject& object = mesh.objects.front();
  file.write(text_of_rows(fmt::format("# {}\n{} 3 0 0\n", mesh.about, object.positions.size()), object.positions.size(),
                          [&](std::size_t v, auto out) {
                            const glm::vec3& x = object.positions[v];
                            fmt::format_to(out, FMT_COMPILE("{} {} {} {}\n"), v + 1, x.x, x.y, x.z);
                          }));
  file.write(text_of_rows(
      fmt::format("{} 1\n", object.triangles.size()), object.triangles.size(), [&](std::size_t t, auto out) {
        const auto& [a, b, c] = object.triangles[t];
        fmt::format_to(out, FMT_COMPILE("3 {} {} {} {}\n"), a + 1, b + 1, c + 1, object.component[t] + 1);
      }));
  std::string points = fmt::format("# a point in each cavity\n{}\n", mesh.cavities.size());
  std::size_t n = 0;
  for (const auto& [x, component] : mesh.cavities) points += fmt::format("{} {} {} {}\n", ++n, x.x, x.y, x.z);
  points += fmt::format("# a point in each solid, with the number of its component\n{}\n", mesh.solids.size());
  n = 0;
  for (const auto& [x, component] : mesh.solids)
    points += fmt::format("{} {} {} {} {}\n", ++n, x.x, x.y, x.z, component + 1);
  file.write(points);
}

namespace {

constexpr double kLargest = 999.9995;  // the limit of a coordinate with eight columns, three decimals and a sign, Å

/// Returns a word of at most `width` characters. Words end at blanks and must not be empty, so other characters become
/// '_', and an empty word becomes "-".
std::string column_word(const std::string& text, std::size_t width) {
  std::string word = text.substr(0, width);
  std::ranges::replace_if(
      word, [](unsigned char c) { return std::isgraph(c) == 0; }, '_');
  return word.empty() ? "-" : word;
}

/// Returns the area of each vertex in Å², which is a third of the area of its triangles.
std::vector<double> vertex_areas(const FileObject& object, double scale) {
  std::vector<double> areas(object.positions.size(), 0.0);
  for (const auto& t : object.triangles) {
    const glm::dvec3 x(object.positions[t[0]]);
    const double twice =
        glm::length(glm::cross(glm::dvec3(object.positions[t[1]]) - x, glm::dvec3(object.positions[t[2]]) - x));
    for (const std::uint32_t v : t) areas[v] += twice / (6.0 * scale * scale);
  }
  return areas;
}

char kind_letter(PatchKind kind) { return kind == PatchKind::convex ? 'C' : kind == PatchKind::toroidal ? 'S' : 'R'; }

/// Throws CapacityError for a coordinate (Å) that the columns of DMS cannot hold.
void check_range(const glm::dvec3& x) {
  for (int k = 0; k < 3; ++k)
    if (!(std::abs(x[k]) < kLargest))
      throw CapacityError(
          "DMS has room for coordinates between -1000 and 1000 Å, and one is {:.3f}; choose another format", x[k]);
}

}  // namespace

void write_dms(OutputFile& file, const MeshFile& mesh) {
  const FileObject& object = mesh.objects.front();
  const std::vector<double> areas = vertex_areas(object, mesh.scale);
  std::vector<std::vector<std::uint32_t>> dots(mesh.atoms.size());
  for (std::uint32_t v = 0; v < object.positions.size(); ++v) {
    check_range(glm::dvec3(object.positions[v]) / mesh.scale);
    dots[object.atom[v]].push_back(v);
  }
  for (const FileAtom& atom : mesh.atoms) check_range(atom.position);
  file.write(text_of_rows("", mesh.atoms.size(), [&](std::size_t a, auto out) {
    const FileAtom& atom = mesh.atoms[a];
    const std::string number =
        fmt::format("{}{}", atom.residue_number, atom.insertion_code == ' ' ? "" : std::string(1, atom.insertion_code));
    const std::string words = fmt::format("{:>3} {:>4} {:>4}", column_word(atom.residue_name, 3),
                                          column_word(number, 5), column_word(atom.name, 4));
    const glm::dvec3& x = atom.position;
    fmt::format_to(out, FMT_COMPILE("{}{:8.3f} {:8.3f} {:8.3f} A\n"), words, x.x, x.y, x.z);
    for (const std::uint32_t v : dots[a]) {
      const glm::dvec3 y = glm::dvec3(object.positions[v]) / mesh.scale;
      const glm::vec3& n = object.normals[v];
      fmt::format_to(out, FMT_COMPILE("{}{:8.3f} {:8.3f} {:8.3f} S{}0 {:6.3f} {:6.3f} {:6.3f} {:6.3f}\n"), words, y.x,
                     y.y, y.z, kind_letter(object.kind[v]), areas[v], n.x, n.y, n.z);
    }
  }));
}

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

  /// Appends words that end with a zero byte and may contain any other, because this part is not parsed as XML.
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
