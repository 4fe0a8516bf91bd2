// SPDX-License-Identifier: BSD-3-Clause
// Goes by the keys, in whatever order and however often they come; the last one counts.
#include "app/msms/shaper_settings.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/parse_number.h"
#include "core/base/text_file.h"
#include "core/base/text_lines.h"

namespace meniscus::msms {
namespace {

constexpr double kLargestProbe = 100.0, kLargestCavity = 1e9;   // Å, Å³
constexpr double kSmallestScale = 0.1, kLargestScale = 20.0;    // points per Å
constexpr std::size_t kLargestSettings = std::size_t{1} << 20;  // bytes

/// One line's value, and where it stands.
struct Value {
  const TextFile& file;
  std::size_t line;
  std::string_view key, text;

  [[noreturn]] void refuse(const std::string& instead) const {
    throw InputError(file.path, static_cast<int>(line),
                     fmt::format("{} is {}; give {}", key, in_quotes(text), instead));
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

/// It changes how NanoShaper works, how good its mesh is, or surfaces that are refused here.
void pass_over(const Value&, ShaperSettings&) {}

/// A file that there is not here, or atoms left out.
void must_be_false(const Value& value, ShaperSettings&) {
  if (value.truth()) value.refuse("false; what it asks for there is not here");
}

template <const char* Word, const char* Instead>
void must_be(const Value& value, ShaperSettings&) {
  if (value.text != Word) value.refuse(Instead);
}
constexpr char kSes[] = "ses", kOnlySes[] = "ses, the one surface that there is here";
constexpr char kNormal[] = "normal", kOnlyNormal[] = "normal; pockets are what `meniscus pockets` finds";
constexpr char kTrue[] = "true", kAlwaysTriangles[] = "true: triangles are all that there is here";
constexpr char kFalse[] = "false", kNoPly[] = "false: the mesh is written in the form of MSMS and as OFF";

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
    Key{"Keep_Water_Shaped_Cavities", pass_over},  // all have room for the probe
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
  if (value.key.starts_with("Max_")) return;  // sizes of its grids
  const auto key = std::ranges::find(kKeys, value.key, &Key::name);
  if (key != kKeys.end())
    key->take(value, settings);
  else
    settings.unknown_keys.emplace_back(value.key);
}

}  // namespace

ShaperSettings read_shaper_settings(const std::string& path) {
  const TextFile file = read_text_file(path, kLargestSettings);
  ShaperSettings settings;
  LineReader lines(file.text);
  for (std::string_view line; lines.next(line);) {
    line = trimmed(line);
    if (line.empty() || line.front() == '#' || line.front() == '%') continue;
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos)
      throw InputError(file.path, lines.number(), fmt::format("{} is not of the form key = value", in_quotes(line)));
    take({file, lines.number(), trimmed(line.substr(0, equals)), trimmed(line.substr(equals + 1))}, settings);
  }
  if (settings.spheres.empty()) throw InputError(file.path, 0, "has no XYZR_FileName, the file of spheres; add it");
  return settings;
}

}  // namespace meniscus::msms
