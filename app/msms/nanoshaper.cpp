// SPDX-License-Identifier: BSD-3-Clause
// The program `meniscus-nanoshaper`: NanoShaper's configuration file and its files of triangles for exact surfaces.

#include <iostream>

#include "app/msms/drop_in.h"
#include "app/process/program_main.h"
#include "app/process/system_process.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/mesh/even_mesh.h"
#include "core/mesh/triangle_mesh.h"
#include "core/surface/compute_surface.h"
#include "exporters/msms/msms_files.h"

namespace meniscus::msms {
namespace {

struct ShaperSettings {
  std::string spheres;            ///< XYZR_FileName
  double probe_radius = 1.4;      ///< Probe_Radius, Å
  double grid_scale = 2.0;        ///< Grid_scale: points of its grid per Å
  bool fill_cavities = false;     ///< Cavity_Detection_Filling: small cavities are left out
  double smallest_cavity = 11.4;  ///< Conditional_Volume_Filling_Value, Å³: the smallest cavity that stays
  std::string root;               ///< Root_FileName: the beginning of file names
  bool msms_files = true;         ///< .vert and .face: unless Save_Mesh_MSMS_Format is false
  bool off_file = true;           ///< .off: unless Save_Mesh_MSMS_Format is true
  std::vector<std::string> unknown_keys;
};

/// Returns the density, in vertices per Å², of a mesh that meets each line of a cubic grid once. Lines of one direction
/// cross a surface at scale² |n| points per Å², where n is the normal's component along them, with a mean of 1/2 over
/// the sphere; there are three directions.
constexpr double shaper_density(double grid_scale) { return 1.5 * grid_scale * grid_scale; }

constexpr double kLargestProbe = 100.0, kLargestCavity = 1e9;   // Å, Å³
constexpr double kSmallestScale = 0.1, kLargestScale = 20.0;    // points per Å
constexpr std::size_t kLargestSettings = std::size_t{1} << 20;  // bytes

/// The value in one line, and its position.
struct Value {
  const TextFile& file;
  std::size_t line;
  std::string_view key, text;

  [[noreturn]] void refuse(const std::string& instead) const {
    throw InputError(file.path, static_cast<int>(line), "{} is {}; give {}", key, in_quotes(text), instead);
  }
  double number(double least, double most) const {
    double value = 0.0;
    if (!parse_number(text, value) || !(value >= least && value <= most))
      refuse(fmt::format("a number from {} to {}", least, most));
    return value;
  }
  bool truth() const {
    if (text != "true" && text != "false") refuse("true or false");
    return text == "true";
  }
};

using Take = void (*)(const Value&, ShaperSettings&);

struct Key {
  std::string_view name;
  Take take;
};

/// Ignores a key that changes how NanoShaper works, how good its mesh is, or surfaces that are refused here.
void pass_over(const Value&, ShaperSettings&) {}

/// Throws for a key that requests a file that is not available here, or atoms to be left out.
void must_be_false(const Value& value, ShaperSettings&) {
  if (value.truth()) value.refuse("false; meniscus-nanoshaper does not have this feature");
}

template <const char* Word, const char* Instead>
void must_be(const Value& value, ShaperSettings&) {
  if (value.text != Word) value.refuse(Instead);
}
constexpr char kSes[] = "ses", kOnlySes[] = "ses, the only surface that meniscus-nanoshaper has";
constexpr char kNormal[] = "normal", kOnlyNormal[] = "normal; `meniscus pockets` finds pockets";
constexpr char kTrue[] = "true", kAlwaysTriangles[] = "true; meniscus-nanoshaper always writes triangles";
constexpr char kFalse[] = "false", kNoPly[] = "false; the mesh is written in the form of MSMS and as OFF";

constexpr std::array kKeys{
    Key{"XYZR_FileName", [](const Value& v, ShaperSettings& s) { s.spheres = v.text; }},
    Key{"Root_FileName", [](const Value& v, ShaperSettings& s) { s.root = v.text; }},
    Key{"Probe_Radius", [](const Value& v, ShaperSettings& s) { s.probe_radius = v.number(0.0, kLargestProbe); }},
    Key{"Grid_scale",
        [](const Value& v, ShaperSettings& s) { s.grid_scale = v.number(kSmallestScale, kLargestScale); }},
    Key{"Cavity_Detection_Filling", [](const Value& v, ShaperSettings& s) { s.fill_cavities = v.truth(); }},
    Key{"Conditional_Volume_Filling_Value",
        [](const Value& v, ShaperSettings& s) { s.smallest_cavity = v.number(0.0, kLargestCavity); }},
    Key{"Save_Mesh_MSMS_Format",
        [](const Value& v, ShaperSettings& s) {
          s.msms_files = v.truth();
          s.off_file = !s.msms_files;
        }},
    Key{"Surface", must_be<kSes, kOnlySes>},
    Key{"Operative_Mode", must_be<kNormal, kOnlyNormal>},
    Key{"Triangulation", must_be<kTrue, kAlwaysTriangles>},
    Key{"Save_Mesh_PLY_Format", must_be<kFalse, kNoPly>},
    Key{"Save_Cavities", must_be_false},
    Key{"Save_Status_map", must_be_false},
    Key{"Save_eps_maps", must_be_false},
    Key{"Save_bgps", must_be_false},
    Key{"Save_PovRay", must_be_false},
    Key{"Tri2Balls", must_be_false},
    Key{"Accurate_Triangulation", pass_over},
    Key{"Analytical_Ray_Vs_Torus_Intersection", pass_over},
    Key{"Blobbyness", pass_over},
    Key{"Build_epsilon_maps", pass_over},
    Key{"Build_status_map", pass_over},
    Key{"Check_duplicated_vertices", pass_over},
    Key{"Collect_Face_Intersections", pass_over},
    Key{"Compute_Vertex_Normals", pass_over},
    Key{"Force_Serial_Build", pass_over},
    Key{"Grid_perfil", pass_over},
    Key{"Grid_perfill", pass_over},                // as VMD 1.9.3 spells it
    Key{"Keep_Water_Shaped_Cavities", pass_over},  // all cavities have room for the probe
    Key{"Link_Pockets", pass_over},
    Key{"Load_Balancing", pass_over},
    Key{"Memb_Height", pass_over},
    Key{"Memb_Shift", pass_over},
    Key{"Multi_Dielectric", pass_over},
    Key{"Num_Wat_Pocket", pass_over},
    Key{"Number_thread", pass_over},
    Key{"Optimize_Grids", pass_over},
    Key{"Parallel_Buildup_Halo_Thickness", pass_over},
    Key{"Patch_Based_Algorithm", pass_over},
    Key{"Pocket_Radius_Big", pass_over},
    Key{"Pocket_Radius_Link", pass_over},
    Key{"Pocket_Radius_Small", pass_over},
    Key{"Pockets_And_Cavities", pass_over},
    Key{"Print_Available_Surfaces", pass_over},
    Key{"Project_boundary_grid_points", pass_over},
    Key{"Seed", pass_over},
    Key{"Self_Intersections_Grid_Coefficient", pass_over},
    Key{"Skin_Fast_Projection", pass_over},
    Key{"Skin_Surface_Parameter", pass_over},
    Key{"Smooth_Mesh", pass_over},
    Key{"Surface_File_Name", pass_over},
    Key{"Sys_Name", pass_over},
    Key{"Vertex_Atom_Info", pass_over},
};

void take(const Value& value, ShaperSettings& settings) {
  if (value.key.starts_with("Max_")) return;  // sizes of NanoShaper's grids
  const auto key = std::ranges::find(kKeys, value.key, &Key::name);
  if (key != kKeys.end())
    key->take(value, settings);
  else
    settings.unknown_keys.emplace_back(value.key);
}

/// Reads lines "key = value"; blank lines and lines that begin with # or % are ignored. Each key of NanoShaper is used,
/// refused if its value would change the mesh or its files in a way that is not supported, or known to change neither;
/// other keys are listed. Throws InputError, with file and line, for another format, for an invalid or refused value,
/// and for a missing XYZR_FileName.
ShaperSettings read_shaper_settings(const std::string& path) {
  const TextFile file = read_text_file(path, kLargestSettings);
  ShaperSettings settings;
  LineReader lines(file);
  for (std::string_view line; lines.next(line);) {
    line = trimmed(line);
    if (line.empty() || line.front() == '#' || line.front() == '%') continue;
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) throw lines.error("{} is not of the form key = value", in_quotes(line));
    take({file, lines.number(), trimmed(line.substr(0, equals)), trimmed(line.substr(equals + 1))}, settings);
  }
  if (settings.spheres.empty()) throw InputError(file.path, 0, "has no XYZR_FileName, the file of spheres; add it");
  return settings;
}

constexpr const char* kHelp = R"(meniscus-nanoshaper [FILE]: exact solvent-excluded surfaces where NanoShaper is called

Reads FILE (surfaceConfiguration.prm) and writes even triangles of the whole surface into the current folder, or where
Root_FileName says: triangulatedSurf.vert and triangulatedSurf.face where Save_Mesh_MSMS_Format is true,
triangulatedSurf.off where it is false, all three where it is not given. Keys: XYZR_FileName, Probe_Radius (1.4),
Grid_scale (2: 1.5 times its square are the vertices per square Angstrom), Cavity_Detection_Filling (false) and
Conditional_Volume_Filling_Value (11.4). Refused is what asks for another result: a Surface but ses, an Operative_Mode
but normal, PLY, maps. Other keys change nothing; unknown ones are named on standard error.
Exit codes: 0 done, 1 internal error, 2 wrong usage, 3 bad input, 5 too large, 6 output not written, 7 not closed.
)";

/// Returns false for cavities to be filled, which get no triangles.
std::vector<bool> components_that_stay(const Surface& surface, const ShaperSettings& settings) {
  std::vector<bool> stays;
  for (const Component& component : surface.components)
    stays.push_back(!settings.fill_cavities || component.kind == ComponentKind::outer ||
                    -component.volume >= settings.smallest_cavity);
  return stays;
}

MsmsMesh rows_of(const FineMesh& even, const std::vector<bool>& stays) {
  constexpr std::uint32_t kUnused = ~std::uint32_t{0};
  std::vector<std::uint32_t> row(even.mesh.positions.size(), kUnused);
  MsmsMesh rows;
  for (std::size_t t = 0; t < even.mesh.triangles.size(); ++t) {
    if (!stays[even.mesh.component[t]]) continue;
    MsmsTriangle triangle;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t vertex = even.mesh.triangles[t][c];
      if (row[vertex] == kUnused) {
        row[vertex] = static_cast<std::uint32_t>(rows.vertices.size());
        rows.vertices.push_back(
            {even.mesh.positions[vertex], even.mesh.normals[vertex], 0, even.vertex_atom[vertex], 0});
      }
      triangle.corner[c] = row[vertex];
    }
    triangle.face = 1;  // the kind is contact: NanoShaper distinguishes neither faces nor kinds
    rows.triangles.push_back(triangle);
  }
  weld_for_files(rows);
  return rows;
}

ExitCode run(std::span<const char* const> words) {
  std::string path = "surfaceConfiguration.prm";
  if (words.size() == 1) path = words.front();
  if (words.size() == 1 && (path == "-h" || path == "--help")) {
    std::cout << kHelp;
    finish_standard_output();
    return kExitOk;
  }
  if (words.size() > 1 || path.starts_with('-')) throw UsageError("give one configuration file, or none; see --help");
  const ShaperSettings settings = read_shaper_settings(path);
  for (const std::string& key : settings.unknown_keys)
    std::cerr << fmt::format("meniscus-nanoshaper: warning: {}: {} is not a key of NanoShaper and changes nothing\n",
                             escaped(path), in_quotes(key));
  const std::string vert = settings.root + "triangulatedSurf.vert", face = settings.root + "triangulatedSurf.face",
                    off = settings.root + "triangulatedSurf.off";
  OutputFiles files;
  for (const std::string& input : {path, settings.spheres}) protect_input(path_of_text(input));
  if (settings.msms_files)
    for (const std::string& name : {vert, face}) files.begin(name);
  if (settings.off_file) files.begin(off);
  Spheres spheres = read_spheres(settings.spheres);
  spheres.rows.names.clear();  // the files always have nine columns
  const Surface surface = compute_surface_cpu(spheres.balls, settings.probe_radius);
  require_closed(surface);
  EvenMeshOptions fineness;
  fineness.density = shaper_density(settings.grid_scale);
  const MsmsMesh mesh = rows_of(even_mesh(surface, fineness), components_that_stay(surface, settings));
  const MsmsHeader header{true, fineness.density, settings.probe_radius, true};
  if (settings.msms_files) {
    files.write(vert, vert_text(mesh, spheres.rows, header));
    files.write(face, face_text(mesh, spheres.rows, header));
  }
  if (settings.off_file) files.write(off, off_text(mesh));
  std::cout << fmt::format("{}: {} spheres, {} vertices, {} triangles\n", escaped(settings.spheres), spheres.rows.count,
                           mesh.vertices.size(), mesh.triangles.size());
  finish_standard_output();
  files.commit();
  return kExitOk;
}

}  // namespace

}  // namespace meniscus::msms

int main(int argc, char** argv) {
  using namespace meniscus;
  return program_main("meniscus-nanoshaper", [=] { return msms::run(system_process::words(argc, argv).subspan(1)); });
}
