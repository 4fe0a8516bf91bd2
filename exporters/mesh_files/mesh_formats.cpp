// SPDX-License-Identifier: BSD-3-Clause
// Lists the formats of mesh files, finds one by name or ending, writes files, and fills their columns of numbers.
#include "exporters/mesh_files/mesh_formats.h"

#include "core/base/error.h"
#include "core/base/system_file.h"
#include "core/mesh/mesh_colors.h"
#include "core/queries/surface_parts.h"
#include "core/structure/element_tables.h"
#include "core/surface/measure.h"

namespace meniscus {
namespace {

using Values = std::vector<float>;

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// Returns value(vertex) for each vertex.
template <typename Value>
Values of_vertices(const NumberSource& source, const Value& value) {
  Values values;
  values.reserve(source.mesh.mesh.positions.size());
  for (std::uint32_t v = 0; v < source.mesh.mesh.positions.size(); ++v) values.push_back(static_cast<float>(value(v)));
  return values;
}

/// Returns value(atom) for the atom of each vertex.
template <typename Value>
Values of_atoms(const NumberSource& source, const Value& value) {
  return of_vertices(
      source, [&](std::uint32_t v) { return value(source.atoms[source.object.atom[source.mesh.vertex_atom[v]]]); });
}

/// Returns value(face, vertex) for the face of each vertex, and NaN for vertices without a face.
template <typename Value>
Values of_faces(const NumberSource& source, const Value& value) {
  return of_vertices(source, [&](std::uint32_t v) -> float {
    const std::uint32_t face = source.mesh.vertex_face[v];
    return face == kNone ? kMissing : static_cast<float>(value(face, v));
  });
}

Values curvatures(const NumberSource& source, double Curvature::*which) {
  return of_faces(source, [&](std::uint32_t face, std::uint32_t v) {
    return curvature(source.object.surface, face, source.mesh.mesh.positions[v]).*which;
  });
}

Values smoothed(const NumberSource& source, double Curvature::*which) {
  const std::vector<Curvature> curvatures = smoothed_curvatures(source.mesh.mesh);
  return of_faces(source, [&](std::uint32_t, std::uint32_t v) { return curvatures[v].*which; });
}

Values atom_areas_of(const NumberSource& source, std::vector<double> AtomAreas::*which) {
  const std::vector<double> areas = atom_areas(source.object.surface).*which;
  return of_vertices(source, [&](std::uint32_t v) { return areas[source.mesh.vertex_atom[v]]; });
}

Values buried_of(const NumberSource& source) {
  return of_vertices(source, [&](std::uint32_t v) -> double {
    const std::uint32_t atom = source.object.atom[source.mesh.vertex_atom[v]];
    return atom < source.buried.size() ? source.buried[atom] : double(kMissing);
  });
}

Values component_of(const NumberSource& source) {
  Values values(source.mesh.mesh.positions.size(), 0.0f);
  for (std::size_t t = 0; t < source.mesh.mesh.triangles.size(); ++t)
    for (const std::uint32_t v : source.mesh.mesh.triangles[t])
      values[v] = static_cast<float>(source.first_component + source.mesh.mesh.component[t]);
  return values;
}

/// Returns the open sky at each vertex, and NaN for vertices of shapes.
Values open_skies(const NumberSource& source) {
  const std::vector<float> seen = vertex_open_sky(source.object.surface, source.mesh.mesh);
  return of_faces(source, [&](std::uint32_t, std::uint32_t v) { return seen[v]; });
}

Values atom_open_skies(const NumberSource& source) {
  const std::vector<double> means = atom_open_sky(source.object.surface, source.mesh.mesh);
  return of_faces(source, [&](std::uint32_t, std::uint32_t v) { return means[source.mesh.vertex_atom[v]]; });
}

struct Column {
  VertexNumberKind kind;
  Values (*values)(const NumberSource&);
};

const auto kColumns = std::to_array<Column>({
    {{"b_factor", "B-factor of the atom, Å²; 0: none", true, true},
     [](const NumberSource& s) {
       return of_atoms(s, [](const Atom& a) { return std::isfinite(a.b_factor) ? a.b_factor : 0.0f; });
     }},
    {{"atomic_number", "of its element; 0: unknown", true, true},
     [](const NumberSource& s) { return of_atoms(s, [](const Atom& a) { return a.element; }); }},
    {{"res_id", "number of its residue", true, true},
     [](const NumberSource& s) { return of_atoms(s, [](const Atom& a) { return a.residue_number; }); }},
    {{"vdw_radii", "its radius, Å", true, false},
     [](const NumberSource& s) { return of_atoms(s, [](const Atom& a) { return a.radius; }); }},
    {{"atom_index", "its place in the file, from 0", true, false},
     [](const NumberSource& s) { return of_atoms(s, [](const Atom& a) { return a.index; }); }},
    {{"ses_kind", "of the patch: 0 convex, 1 toroidal, 2 concave", true, false},
     [](const NumberSource& s) {
       return of_vertices(s, [&](std::uint32_t v) {
         const std::uint32_t face = s.mesh.vertex_face[v];
         return face == kNone ? 0 : static_cast<int>(s.object.surface.faces[face].kind);
       });
     }},
    {{"ses_component", "of the closed part, from 0", true, false}, component_of},
    {{"mean_curvature", "exact, 1/Å; positive where the solid bulges", false, false},
     [](const NumberSource& s) { return curvatures(s, &Curvature::mean); }},
    {{"gaussian_curvature", "exact, 1/Å²", false, false},
     [](const NumberSource& s) { return curvatures(s, &Curvature::gaussian); }},
    {{"smooth_mean_curvature", "averaged over 2 Å around, 1/Å", false, false},
     [](const NumberSource& s) { return smoothed(s, &Curvature::mean); }},
    {{"smooth_gaussian_curvature", "the same, 1/Å²", false, false},
     [](const NumberSource& s) { return smoothed(s, &Curvature::gaussian); }},
    {{"atom_area", "all of the surface that is the atom's, Å²", false, false},
     [](const NumberSource& s) { return atom_areas_of(s, &AtomAreas::surface); }},
    {{"accessible_area", "of the atom, where a probe's centre can be, Å²", false, false},
     [](const NumberSource& s) { return atom_areas_of(s, &AtomAreas::accessible); }},
    {{"patch_area", "of the patch's connected piece, Å²", false, false},
     [](const NumberSource& s) {
       return of_faces(s, [&](std::uint32_t face, std::uint32_t) { return s.object.surface.faces[face].area; });
     }},
    {{"open_sky", "share of the sky it sees past the surface, by cosine, 0 to 1", false, false, true}, open_skies},
    {{"atom_open_sky", "its mean over the atom's surface", false, false, true}, atom_open_skies},
    {{"charge", "partial charge of the atom, e", false, true},
     [](const NumberSource& s) { return of_atoms(s, [](const Atom& a) { return a.charge; }); }},
    {{"hydrophobicity", "of its residue (Kyte & Doolittle 1982)", false, true},
     [](const NumberSource& s) { return of_atoms(s, [](const Atom& a) { return hydropathy(a.residue_name); }); }},
    {{"entity", "of the atom: 0 polymer, 1 ligand, 2 water, 3 ion, 4 unclassified", false, true},
     [](const NumberSource& s) { return of_atoms(s, [](const Atom& a) { return static_cast<int>(a.kind); }); }},
    {{"buried_area", "accessible area of the atom that other chains bury, Å²", false, true}, buried_of},
});

const auto kKinds = [] {
  std::array<VertexNumberKind, kColumns.size()> kinds{};
  std::ranges::transform(kColumns, kinds.begin(), &Column::kind);
  return kinds;
}();

bool is_requested(const VertexNumberKind& kind, std::span<const std::string> words, AtomSource atoms) {
  return (atoms == AtomSource::molecule || !kind.of_molecule) &&
         std::ranges::any_of(words, [&](const std::string& word) {
           return word == kind.name || (word == "all" && !kind.slow) || (word == "usual" && kind.usual);
         });
}

void check_word(const std::string& word, AtomSource atoms) {
  if (word == "all" || word == "usual" || word == "none") return;
  const auto* const kind = std::ranges::find(kKinds, word, &VertexNumberKind::name);
  if (kind == kKinds.end()) {
    std::string known;
    for (const VertexNumberKind& k : kKinds) known.append(k.name).append(", ");
    throw RequestError("{} is not an attribute; choose from {}usual, all and none", in_quotes(word), known);
  }
  if (atoms == AtomSource::bare && kind->of_molecule)
    throw RequestError("{} is known only for molecules read from a file, not for bare atoms", word);
}

}  // namespace

std::span<const VertexNumberKind> vertex_number_kinds() { return kKinds; }

std::vector<std::string> parse_vertex_numbers(std::string_view text, AtomSource atoms) {
  std::vector<std::string> words;
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t past = std::min(text.find(',', first), text.size());
    words.emplace_back(text.substr(first, past - first));
    first = past + 1;
  }
  for (const std::string& word : words) check_word(word, atoms);
  std::vector<std::string> names;
  for (const VertexNumberKind& kind : kKinds)
    if (is_requested(kind, words, atoms)) names.emplace_back(kind.name);
  return names;
}

std::vector<VertexNumbers> vertex_numbers(std::span<const std::string> names, const NumberSource& source) {
  std::vector<VertexNumbers> numbers;
  for (const std::string& name : names) {
    const auto* const column =
        std::ranges::find(kColumns, std::string_view(name), [](const Column& c) { return c.kind.name; });
    numbers.push_back({name, column->values(source)});
  }
  if (const auto& volume = source.object.coloring.volume)
    numbers.push_back({"map_value", vertex_map_values(source.mesh.mesh, *volume)});
  return numbers;
}

namespace {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

/// Joins objects into one that has the name of the first.
FileObject joined(std::vector<FileObject> objects) {
  FileObject whole = std::move(objects.front());
  whole.triangle_colors.clear();  // colours of vertices remain, which all formats with colours support
  for (std::size_t n = 1; n < objects.size(); ++n) {
    FileObject& next = objects[n];
    const auto first = static_cast<std::uint32_t>(whole.positions.size());
    append(whole.positions, next.positions);
    append(whole.normals, next.normals);
    append(whole.colors, next.colors);
    append(whole.atom, next.atom);
    append(whole.kind, next.kind);
    append(whole.component, next.component);
    for (const auto& [a, b, c] : next.triangles) whole.triangles.push_back({first + a, first + b, first + c});
    for (std::size_t k = 0; k < whole.numbers.size(); ++k) append(whole.numbers[k].values, next.numbers[k].values);
    whole.is_cavity = whole.is_cavity && next.is_cavity;
    next = {};
  }
  return whole;
}

constexpr auto kFormats = std::to_array<MeshFormat>({
    // word, title, unit, objects, colors, numbers, solid, atoms, places, opacity
    {"stl", "STL, binary", "", false, false, false, false, false, false, false, write_stl},
    {"3mf", "3MF", "mm", true, true, false, false, false, true, false, write_3mf},
    {"obj", "Wavefront OBJ", "", true, true, false, false, false, false, false, write_obj},
    {"off", "OFF", "", false, false, false, false, false, false, false, write_off},
    {"glb", "glTF, binary", "m", true, true, true, false, false, true, true, write_glb},
    {"vtp", "VTK polygons", "", false, true, true, false, true, false, false, write_vtp},
    {"smesh", "TetGen's facets", "", false, false, false, true, false, false, false, write_smesh},
    {"dms", "dots of dms", "Å", false, false, false, false, true, false, false, write_dms},
    {"ply", "PLY, binary", "", false, true, true, false, false, false, false, write_ply},
    {"ply-ascii", "PLY, text", "", false, true, true, false, false, false, false, write_ascii_ply},
    {"py", "script for PyMOL", "", true, true, false, false, false, false, false, write_pymol_script},
    {"usda", "USD, text", "m", true, true, true, false, false, true, true, write_usda, write_usda_run},
    {"usdz", "USD, archive", "m", true, true, true, false, false, true, true, write_usdz, write_usdz_run},
});

}  // namespace

std::span<const MeshFormat> mesh_formats() { return kFormats; }

const MeshFormat* mesh_format(std::string_view word) {
  const auto* const at = std::ranges::find(kFormats, word, &MeshFormat::word);
  return at == kFormats.end() ? nullptr : &*at;
}

const MeshFormat* mesh_format_of_path(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  if (dot == std::string_view::npos) return nullptr;
  const std::string ending = lower_case(path.substr(dot + 1));
  return mesh_format(ending == "usd" ? "usda" : ending);  // a .usd file may be text; readers inspect its content
}

std::string mesh_format_words() {
  std::string words;
  for (const MeshFormat& format : kFormats) words.append(words.empty() ? "" : ", ").append(format.word);
  return words;
}

void write_mesh_file(const MeshFormat& format, const std::string& path, Existing existing, MeshFile mesh) {
  if (!format.objects && mesh.objects.size() > 1) {
    FileObject whole = joined(std::move(mesh.objects));
    mesh.objects.clear();
    mesh.objects.push_back(std::move(whole));
  }
  OutputFile file(path_of_text(path), existing);
  format.write(file, mesh);
  file.commit();
}

void write_mesh_run(const MeshFormat& format, const std::string& path, Existing existing,
                    std::span<const MeshFile> frames, const RunTimes& times) {
  OutputFile file(path_of_text(path), existing);
  format.write_run(file, frames, times);
  file.commit();
}

}  // namespace meniscus
