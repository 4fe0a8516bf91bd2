// SPDX-License-Identifier: BSD-3-Clause
// Every pointer, count, stride, word and number that the C interface takes, in one table that is compared with the
// header: wrong ones are refused with a sentence, and nothing is changed.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <regex>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/c_api/c_objects.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

using namespace test;

template <typename Struct>
Struct sized() {
  Struct made{};
  made.size = sizeof made;
  return made;
}

/// Returns a file of two atoms.
const std::string& molecule() {
  static const TemporaryFolder folder;
  static const std::string path =
      folder.file("molecule.pdb",
                  "ATOM      1  N   ALA A   1       0.000   0.000   0.000  1.00 10.00           N  \n"
                  "ATOM      2  CA  ALA A   1       1.458   0.000   0.000  1.00 20.00           C  \n"
                  "END\n");
  return path;
}

/// Objects and memory for calls of which one argument is bad.
struct World {
  Computer computer = test::computer();
  SurfaceOf surface = computed(computer.get(), testing::two_atoms(4.0));
  Mesh mesh = made<meniscus_mesh>([&](auto** to) { return meniscus_surface_mesh(surface.get(), nullptr, to); });
  Pockets pockets =
      made<meniscus_pockets>([&](auto** to) { return meniscus_surface_pockets(surface.get(), nullptr, to); });
  Renderer renderer = made<meniscus_renderer>([](auto** to) { return meniscus_renderer_new(MENISCUS_CPU, to); });
  StructureOf structure = structure_of(molecule());
  SceneOf scene = scene_with({{"size", "2x2"}, {"samples", "1"}});
  SceneOf whole = scene_with({{"size", "2x2"}, {"file", molecule().c_str()}});
  PageOf page = made<meniscus_page>([&](auto** to) { return meniscus_scene_page(whole.get(), to); });
  std::vector<double> numbers = std::vector<double>(64, 1.0);
  double* const n = numbers.data();
  std::int32_t word = 0;
  const char* text = nullptr;
  std::size_t size = 0;
  meniscus_array array{};
  meniscus_summary summary = sized<meniscus_summary>();
  meniscus_camera camera = sized<meniscus_camera>();
  meniscus_mesh_file file = sized<meniscus_mesh_file>();
  meniscus_atoms atoms = sized<meniscus_atoms>();
  meniscus_read_options reading = sized<meniscus_read_options>();
  meniscus_read_report report = sized<meniscus_read_report>();
  const TemporaryFolder folder;
  const std::string path = folder.path() / "mesh.ply";
  const double positions[8] = {0, 0, 0, 1.7, 2, 0, 0, 1.7};

  World() {
    EXPECT_EQ(meniscus_surface_camera(surface.get(), 1.0, MENISCUS_PERSPECTIVE, &camera), MENISCUS_OK);
    EXPECT_EQ(meniscus_default_mesh_file(&file), MENISCUS_OK);
    EXPECT_EQ(meniscus_default_read_options(&reading), MENISCUS_OK);
    atoms.count = 2;
    atoms.positions = positions;
    atoms.radii = positions + 3;
    atoms.positions_stride = atoms.radii_stride = 32;
  }

  template <typename Object, typename Make>
  static std::unique_ptr<Object, Release> made(const Make& make) {
    Object* object = nullptr;
    EXPECT_EQ(make(&object), MENISCUS_OK) << meniscus_last_error();
    return std::unique_ptr<Object, Release>(object);
  }
  meniscus_status compute() const {
    meniscus_surface* fresh = nullptr;
    const meniscus_status status = meniscus_compute(computer.get(), &atoms, &fresh);
    meniscus_surface_release(fresh);
    return status;
  }
  meniscus_status read() const {
    meniscus_structure* fresh = nullptr;
    const meniscus_status status = meniscus_read(molecule().c_str(), &reading, &fresh);
    meniscus_structure_release(fresh);
    return status;
  }
  /// Reads with a list of one text at `address`.
  meniscus_status read_with(const char* const* meniscus_read_options::*list, std::size_t meniscus_read_options::*count,
                            const void* address) {
    reading.*list = static_cast<const char* const*>(address);
    reading.*count = 1;
    return read();
  }
  meniscus_status paint(const meniscus_camera* from = nullptr, const float* colors = nullptr) const {
    return meniscus_render(renderer.get(), surface.get(), scene.get(), from, colors, reinterpret_cast<std::uint8_t*>(n),
                           16);
  }
  meniscus_status show(const meniscus_structure* names, const meniscus_scene* look,
                       const meniscus_camera* from = nullptr, const float* colors = nullptr) const {
    meniscus_page* fresh = nullptr;
    const meniscus_status status = meniscus_surface_page(surface.get(), names, look, from, colors, &fresh);
    meniscus_page_release(fresh);
    return status;
  }
  meniscus_status save() const { return meniscus_mesh_save(mesh.get(), path.c_str(), &file); }
};

/// Inner addresses that are no multiples of 8 are misaligned for numbers.
alignas(8) unsigned char crooked[64] = {};

template <typename Type>
Type* as(const void* address) {
  return static_cast<Type*>(const_cast<void*>(address));
}

template <typename Object, typename Make>
meniscus_status refused(const Make& make) {
  Object* fresh = nullptr;
  const meniscus_status status = make(&fresh);
  EXPECT_EQ(fresh, nullptr);
  return status;
}

struct Pointer {
  const char* place;  // "function argument" or "struct.field"
  bool may_be_null;
  meniscus_status (*call)(World&, const void* address);
  bool text = false;  // A text may be anywhere.
};

#define ARGUMENT(function, name, may_be_null, ...)                                                       \
  {                                                                                                      \
#function " " #name, may_be_null, [](World& w, const void* p) { (void)w; return function(__VA_ARGS__); } \
  }
#define FIELD(structure, name, member, call)                                                                                                        \
  {                                                                                                                                                 \
#structure "." #name, true, [](World& w, const void* p) { w.member.name = as<std::remove_pointer_t<decltype(w.member.name)>>(p); return w.call(); } \
  }

const Pointer kPointers[] = {
    {"meniscus_element_of_symbol symbol", false,
     [](World& w, const void* p) { return meniscus_element_of_symbol(as<const char>(p), &w.word); }, true},
    ARGUMENT(meniscus_element_of_symbol, element, false, "C", as<std::int32_t>(p)),
    ARGUMENT(meniscus_element_radius, radius, false, 6, as<double>(p), nullptr),
    ARGUMENT(meniscus_element_radius, source, true, 6, w.n, as<const char*>(p)),
    ARGUMENT(meniscus_default_options, options, false, as<meniscus_options>(p)),
    ARGUMENT(meniscus_default_read_options, options, false, as<meniscus_read_options>(p)),
    {"meniscus_read path", false,
     [](World&, const void* p) {
       meniscus_structure* fresh = nullptr;
       return meniscus_read(as<const char>(p), nullptr, &fresh);
     }, true},
    {"meniscus_read options", true,
     [](World&, const void* p) {
       meniscus_structure* fresh = nullptr;
       const auto status = meniscus_read(molecule().c_str(), as<meniscus_read_options>(p), &fresh);
       meniscus_structure_release(fresh);
       return status;
     }},
    ARGUMENT(meniscus_read, structure, false, molecule().c_str(), nullptr, as<meniscus_structure*>(p)),
    {"meniscus_read_options.select", true,
     [](World& w, const void* p) { w.reading.select = as<const char>(p); return w.read(); }, true},
    {"meniscus_read_options.assembly", true,
     [](World& w, const void* p) { w.reading.assembly = as<const char>(p); return w.read(); }, true},
    {"meniscus_read_options.altloc", true,
     [](World& w, const void* p) { w.reading.altloc = as<const char>(p); return w.read(); }, true},
    {"meniscus_read_options.radii", true,
     [](World& w, const void* p) { w.reading.radii = as<const char>(p); return w.read(); }, true},
    {"meniscus_read_options.radii_files", false,
     [](World& w, const void* p) {
       return w.read_with(&meniscus_read_options::radii_files, &meniscus_read_options::radii_file_count, p);
     }},
    {"meniscus_read_options.radius", false,
     [](World& w, const void* p) {
       return w.read_with(&meniscus_read_options::radius, &meniscus_read_options::radius_count, p);
     }},
    ARGUMENT(meniscus_structure_atoms, structure, false, as<meniscus_structure>(p), &w.atoms),
    ARGUMENT(meniscus_structure_atoms, atoms, false, w.structure.get(), as<meniscus_atoms>(p)),
    ARGUMENT(meniscus_structure_report, structure, false, as<meniscus_structure>(p), &w.report),
    ARGUMENT(meniscus_structure_report, report, false, w.structure.get(), as<meniscus_read_report>(p)),
    ARGUMENT(meniscus_structure_table, structure, false, as<meniscus_structure>(p), MENISCUS_STRUCTURE_RADII, &w.array),
    ARGUMENT(meniscus_structure_table, array, false, w.structure.get(), MENISCUS_STRUCTURE_RADII, as<meniscus_array>(p)),
    ARGUMENT(meniscus_structure_colors, structure, false, as<meniscus_structure>(p), "chain", as<float>(w.n)),
    {"meniscus_structure_colors scheme", false,
     [](World& w, const void* p) { return meniscus_structure_colors(w.structure.get(), as<char>(p), as<float>(w.n)); },
     true},
    ARGUMENT(meniscus_structure_colors, atom_colors, false, w.structure.get(), "chain", as<float>(p)),
    ARGUMENT(meniscus_default_pocket_options, options, false, as<meniscus_pocket_options>(p)),
    ARGUMENT(meniscus_default_mesh_options, options, false, as<meniscus_mesh_options>(p)),
    ARGUMENT(meniscus_default_mesh_file, file, false, as<meniscus_mesh_file>(p)),
    {"meniscus_computer_new options", true,
     [](World&, const void* p) {
       meniscus_computer* fresh = nullptr;
       const meniscus_status status = meniscus_computer_new(as<meniscus_options>(p), &fresh);
       meniscus_computer_release(fresh);
       return status;
     }},
    ARGUMENT(meniscus_computer_new, computer, false, nullptr, as<meniscus_computer*>(p)),
    {"meniscus_compute computer", false,
     [](World& w, const void* p) {
       meniscus_surface* fresh = nullptr;
       return meniscus_compute(as<meniscus_computer>(p), &w.atoms, &fresh);
     }},
    {"meniscus_compute atoms", false,
     [](World& w, const void* p) {
       meniscus_surface* fresh = nullptr;
       return meniscus_compute(w.computer.get(), as<meniscus_atoms>(p), &fresh);
     }},
    {"meniscus_recompute computer", false,
     [](World& w, const void* p) {
       meniscus_surface* held = w.surface.get();
       return meniscus_recompute(as<meniscus_computer>(p), &w.atoms, &held);
     }},
    {"meniscus_recompute atoms", false,
     [](World& w, const void* p) {
       meniscus_surface* held = w.surface.get();
       return meniscus_recompute(w.computer.get(), as<meniscus_atoms>(p), &held);
     }},
    ARGUMENT(meniscus_recompute, surface, false, w.computer.get(), &w.atoms, as<meniscus_surface*>(p)),
    ARGUMENT(meniscus_compute, surface, false, w.computer.get(), &w.atoms, as<meniscus_surface*>(p)),
    {"meniscus_atoms.positions", false, [](World& w, const void* p) { w.atoms.positions = p; return w.compute(); }},
    {"meniscus_atoms.radii", false, [](World& w, const void* p) { w.atoms.radii = p; return w.compute(); }},
    ARGUMENT(meniscus_surface_summary, surface, false, as<meniscus_surface>(p), &w.summary),
    ARGUMENT(meniscus_surface_summary, summary, false, w.surface.get(), as<meniscus_summary>(p)),
    ARGUMENT(meniscus_surface_table, surface, false, as<meniscus_surface>(p), MENISCUS_COMPONENTS, &w.array),
    ARGUMENT(meniscus_surface_table, array, false, w.surface.get(), MENISCUS_COMPONENTS, as<meniscus_array>(p)),
    ARGUMENT(meniscus_surface_distance, surface, false, as<meniscus_surface>(p), 2, w.n, w.n + 20, nullptr),
    ARGUMENT(meniscus_surface_distance, points, false, w.surface.get(), 2, as<double>(p), w.n + 20, nullptr),
    ARGUMENT(meniscus_surface_distance, distances, false, w.surface.get(), 2, w.n, as<double>(p), nullptr),
    ARGUMENT(meniscus_surface_distance, nearest, true, w.surface.get(), 2, w.n, w.n + 20, as<double>(p)),
    ARGUMENT(meniscus_surface_gradient, surface, false, as<meniscus_surface>(p), MENISCUS_GRADIENT_AREA, nullptr, w.n),
    ARGUMENT(meniscus_surface_gradient, weights, true, w.surface.get(), MENISCUS_GRADIENT_SAS_AREA, as<double>(p), w.n),
    ARGUMENT(meniscus_surface_gradient, gradient, false, w.surface.get(), MENISCUS_GRADIENT_AREA, nullptr, as<double>(p)),
    {"meniscus_surface_pockets surface", false,
     [](World&, const void* p) {
       meniscus_pockets* fresh = nullptr;
       return meniscus_surface_pockets(as<meniscus_surface>(p), nullptr, &fresh);
     }},
    {"meniscus_surface_pockets options", true,
     [](World& w, const void* p) {
       meniscus_pockets* fresh = nullptr;
       const auto status = meniscus_surface_pockets(w.surface.get(), as<meniscus_pocket_options>(p), &fresh);
       meniscus_pockets_release(fresh);
       return status;
     }},
    ARGUMENT(meniscus_surface_pockets, pockets, false, w.surface.get(), nullptr, as<meniscus_pockets*>(p)),
    ARGUMENT(meniscus_pockets_table, pockets, false, as<meniscus_pockets>(p), MENISCUS_POCKETS, &w.array),
    ARGUMENT(meniscus_pockets_table, array, false, w.pockets.get(), MENISCUS_POCKETS, as<meniscus_array>(p)),
    {"meniscus_surface_mesh surface", false,
     [](World&, const void* p) {
       meniscus_mesh* fresh = nullptr;
       return meniscus_surface_mesh(as<meniscus_surface>(p), nullptr, &fresh);
     }},
    {"meniscus_surface_mesh options", true,
     [](World& w, const void* p) {
       meniscus_mesh* fresh = nullptr;
       const auto status = meniscus_surface_mesh(w.surface.get(), as<meniscus_mesh_options>(p), &fresh);
       meniscus_mesh_release(fresh);
       return status;
     }},
    ARGUMENT(meniscus_surface_mesh, mesh, false, w.surface.get(), nullptr, as<meniscus_mesh*>(p)),
    ARGUMENT(meniscus_mesh_table, mesh, false, as<meniscus_mesh>(p), MENISCUS_MESH_POSITIONS, &w.array),
    ARGUMENT(meniscus_mesh_table, array, false, w.mesh.get(), MENISCUS_MESH_POSITIONS, as<meniscus_array>(p)),
    ARGUMENT(meniscus_mesh_save, mesh, false, as<meniscus_mesh>(p), w.path.c_str(), nullptr),
    {"meniscus_mesh_save path", false,
     [](World& w, const void* p) { return meniscus_mesh_save(w.mesh.get(), as<const char>(p), nullptr); }, true},
    ARGUMENT(meniscus_mesh_save, file, true, w.mesh.get(), w.path.c_str(), as<meniscus_mesh_file>(p)),
    {"meniscus_mesh_file.format", true,
     [](World& w, const void* p) { w.file.format = as<const char>(p); return w.save(); }, true},
    {"meniscus_mesh_file.attributes", true,
     [](World& w, const void* p) { w.file.attributes = as<const char>(p); return w.save(); }, true},
    FIELD(meniscus_mesh_file, atom_colors, file, save),
    ARGUMENT(meniscus_surface_camera, surface, false, as<meniscus_surface>(p), 1.0, MENISCUS_PERSPECTIVE, &w.camera),
    ARGUMENT(meniscus_surface_camera, camera, false, w.surface.get(), 1.0, MENISCUS_PERSPECTIVE, as<meniscus_camera>(p)),
    ARGUMENT(meniscus_renderer_new, renderer, false, MENISCUS_CPU, as<meniscus_renderer*>(p)),
    ARGUMENT(meniscus_render, renderer, false, as<meniscus_renderer>(p), w.surface.get(), w.scene.get(), nullptr, nullptr,
             as<std::uint8_t>(w.n), 16),
    ARGUMENT(meniscus_render, surface, false, w.renderer.get(), as<meniscus_surface>(p), w.scene.get(), nullptr, nullptr,
             as<std::uint8_t>(w.n), 16),
    {"meniscus_render scene", true,
     [](World& w, const void* p) {
       std::vector<std::uint8_t> rgba(1280 * 960 * 4);
       return meniscus_render(w.renderer.get(), w.surface.get(), as<meniscus_scene>(p), nullptr, nullptr, rgba.data(),
                              rgba.size());
     }},
    {"meniscus_render camera", true, [](World& w, const void* p) { return w.paint(as<meniscus_camera>(p)); }},
    {"meniscus_render atom_colors", true,
     [](World& w, const void* p) { return w.paint(nullptr, as<float>(p)); }},
    {"meniscus_render rgba", false,
     [](World& w, const void* p) {
       return meniscus_render(w.renderer.get(), w.surface.get(), w.scene.get(), nullptr, nullptr, as<std::uint8_t>(p),
                              16);
     }, true},
    ARGUMENT(meniscus_scene_new, scene, false, as<meniscus_scene*>(p)),
    {"meniscus_scene_read path", false,
     [](World&, const void* p) {
       return refused<meniscus_scene>([&](auto** to) { return meniscus_scene_read(as<const char>(p), to); });
     }, true},
    ARGUMENT(meniscus_scene_read, scene, false, molecule().c_str(), as<meniscus_scene*>(p)),
    {"meniscus_scene_parse json", false,
     [](World&, const void* p) {
       return refused<meniscus_scene>([&](auto** to) { return meniscus_scene_parse(as<const char>(p), to); });
     }, true},
    ARGUMENT(meniscus_scene_parse, scene, false, "{}", as<meniscus_scene*>(p)),
    ARGUMENT(meniscus_scene_set, scene, false, as<meniscus_scene>(p), "samples", "1"),
    {"meniscus_scene_set name", false,
     [](World& w, const void* p) { return meniscus_scene_set(w.scene.get(), as<const char>(p), "1"); }, true},
    {"meniscus_scene_set value", true,
     [](World& w, const void* p) { return meniscus_scene_set(w.scene.get(), "samples", as<const char>(p)); }, true},
    ARGUMENT(meniscus_scene_get, scene, false, as<meniscus_scene>(p), "samples", 0, &w.text),
    {"meniscus_scene_get name", false,
     [](World& w, const void* p) { return meniscus_scene_get(w.scene.get(), as<const char>(p), 0, &w.text); }, true},
    ARGUMENT(meniscus_scene_get, value, false, w.scene.get(), "samples", 0, as<const char*>(p)),
    ARGUMENT(meniscus_scene_json, scene, false, as<meniscus_scene>(p), nullptr, &w.text),
    {"meniscus_scene_json folder", true,
     [](World& w, const void* p) { return meniscus_scene_json(w.scene.get(), as<const char>(p), &w.text); }, true},
    ARGUMENT(meniscus_scene_json, json, false, w.scene.get(), nullptr, as<const char*>(p)),
    ARGUMENT(meniscus_scene_size, scene, false, as<meniscus_scene>(p), &w.word, &w.word),
    ARGUMENT(meniscus_scene_size, width, false, w.scene.get(), as<std::int32_t>(p), &w.word),
    ARGUMENT(meniscus_scene_size, height, false, w.scene.get(), &w.word, as<std::int32_t>(p)),
    ARGUMENT(meniscus_scene_properties, array, false, as<meniscus_array>(p)),
    ARGUMENT(meniscus_render_scene, renderer, false, as<meniscus_renderer>(p), w.whole.get(), as<std::uint8_t>(w.n), 16),
    ARGUMENT(meniscus_render_scene, scene, false, w.renderer.get(), as<meniscus_scene>(p), as<std::uint8_t>(w.n), 16),
    {"meniscus_render_scene rgba", false,
     [](World& w, const void* p) {
       return meniscus_render_scene(w.renderer.get(), w.whole.get(), as<std::uint8_t>(p), 16);
     }, true},
    {"meniscus_scene_page scene", false,
     [](World&, const void* p) {
       return refused<meniscus_page>([&](auto** to) { return meniscus_scene_page(as<meniscus_scene>(p), to); });
     }},
    ARGUMENT(meniscus_scene_page, page, false, w.whole.get(), as<meniscus_page*>(p)),
    {"meniscus_surface_page surface", false,
     [](World& w, const void* p) {
       return refused<meniscus_page>([&](auto** to) {
         return meniscus_surface_page(as<meniscus_surface>(p), nullptr, w.scene.get(), nullptr, nullptr, to);
       });
     }},
    {"meniscus_surface_page structure", true,
     [](World& w, const void* p) { return w.show(as<meniscus_structure>(p), w.scene.get()); }},
    {"meniscus_surface_page scene", true,
     [](World& w, const void* p) { return w.show(nullptr, as<meniscus_scene>(p)); }},
    {"meniscus_surface_page camera", true,
     [](World& w, const void* p) { return w.show(nullptr, w.scene.get(), as<meniscus_camera>(p)); }},
    {"meniscus_surface_page atom_colors", true,
     [](World& w, const void* p) { return w.show(nullptr, w.scene.get(), nullptr, as<float>(p)); }},
    ARGUMENT(meniscus_surface_page, page, false, w.surface.get(), nullptr, w.scene.get(), nullptr, nullptr,
             as<meniscus_page*>(p)),
    ARGUMENT(meniscus_page_html, page, false, as<meniscus_page>(p), &w.text, &w.size),
    ARGUMENT(meniscus_page_html, html, false, w.page.get(), as<const char*>(p), &w.size),
    ARGUMENT(meniscus_page_html, size, true, w.page.get(), &w.text, as<std::size_t>(p)),
};
#undef ARGUMENT
#undef FIELD

struct Size {
  const char* place;
  meniscus_status (*call)(World&, std::size_t size);
};

#define SIZE_OF(structure, ...)                        \
  {                                                    \
#structure ".size", [](World& w, std::size_t size) { \
     structure s = sized<structure>();                         \
     s.size = size;                                            \
     (void)w;                                                  \
     return __VA_ARGS__;                                       \
   } \
  }

const Size kSizes[] = {
    {"meniscus_surface_distance count",
     [](World& w, std::size_t n) { return meniscus_surface_distance(w.surface.get(), n, w.n, w.n + 20, w.n + 30); }},
    {"meniscus_render rgba_size",
     [](World& w, std::size_t n) {
       return meniscus_render(w.renderer.get(), w.surface.get(), w.scene.get(), nullptr, nullptr,
                              reinterpret_cast<std::uint8_t*>(w.n), n);
     }},
    {"meniscus_render_scene rgba_size",
     [](World& w, std::size_t n) {
       return meniscus_render_scene(w.renderer.get(), w.whole.get(), reinterpret_cast<std::uint8_t*>(w.n), n);
     }},
    {"meniscus_atoms.count",
     [](World& w, std::size_t n) {
       w.atoms.count = n;
       return w.compute();
     }},
    {"meniscus_atoms.positions_stride",
     [](World& w, std::size_t n) {
       w.atoms.positions_stride = n;
       return w.compute();
     }},
    {"meniscus_atoms.radii_stride",
     [](World& w, std::size_t n) {
       w.atoms.radii_stride = n;
       return w.compute();
     }},
    {"meniscus_read_options.radii_file_count",
     [](World& w, std::size_t n) {
       const char* const texts[] = {"radii.txt"};
       w.reading.radii_files = texts;
       w.reading.radii_file_count = n;
       return w.read();
     }},
    {"meniscus_read_options.radius_count",
     [](World& w, std::size_t n) {
       const char* const texts[] = {"all=1.5"};
       w.reading.radius = texts;
       w.reading.radius_count = n;
       return w.read();
     }},
    SIZE_OF(meniscus_read_options,
            refused<meniscus_structure>([&](auto** to) { return meniscus_read(molecule().c_str(), &s, to); })),
    SIZE_OF(meniscus_read_report, meniscus_structure_report(w.structure.get(), &s)),
    SIZE_OF(meniscus_options, refused<meniscus_computer>([&](auto** to) { return meniscus_computer_new(&s, to); })),
    SIZE_OF(meniscus_atoms,
            refused<meniscus_surface>([&](auto** to) { return meniscus_compute(w.computer.get(), &s, to); })),
    SIZE_OF(meniscus_summary, meniscus_surface_summary(w.surface.get(), &s)),
    SIZE_OF(meniscus_pocket_options,
            refused<meniscus_pockets>([&](auto** to) { return meniscus_surface_pockets(w.surface.get(), &s, to); })),
    SIZE_OF(meniscus_mesh_options,
            refused<meniscus_mesh>([&](auto** to) { return meniscus_surface_mesh(w.surface.get(), &s, to); })),
    SIZE_OF(meniscus_mesh_file, meniscus_mesh_save(w.mesh.get(), w.path.c_str(), &s)),
    SIZE_OF(meniscus_camera, meniscus_surface_camera(w.surface.get(), 1.0, MENISCUS_PERSPECTIVE, &s)),
};
#undef SIZE_OF

struct Word {
  const char* place;
  meniscus_status (*call)(World&, std::int32_t word);
};

const Word kWords[] = {
    {"meniscus_element_radius element",
     [](World& w, std::int32_t v) { return meniscus_element_radius(v, w.n, nullptr); }},
    {"meniscus_surface_table table",
     [](World& w, std::int32_t v) {
       return meniscus_surface_table(w.surface.get(), meniscus_surface_table_id{v}, &w.array);
     }},
    {"meniscus_structure_table table",
     [](World& w, std::int32_t v) {
       return meniscus_structure_table(w.structure.get(), meniscus_structure_table_id{v}, &w.array);
     }},
    {"meniscus_surface_gradient quantity",
     [](World& w, std::int32_t v) {
       return meniscus_surface_gradient(w.surface.get(), meniscus_quantity{v}, nullptr, w.n);
     }},
    {"meniscus_pockets_table table",
     [](World& w, std::int32_t v) {
       return meniscus_pockets_table(w.pockets.get(), meniscus_pockets_table_id{v}, &w.array);
     }},
    {"meniscus_mesh_table table",
     [](World& w, std::int32_t v) { return meniscus_mesh_table(w.mesh.get(), meniscus_mesh_table_id{v}, &w.array); }},
    {"meniscus_surface_camera projection",
     [](World& w, std::int32_t v) {
       return meniscus_surface_camera(w.surface.get(), 1.0, meniscus_projection{v}, &w.camera);
     }},
    {"meniscus_renderer_new device",
     [](World&, std::int32_t v) {
       return refused<meniscus_renderer>([&](auto** to) { return meniscus_renderer_new(meniscus_device{v}, to); });
     }},
    {"meniscus_atoms.reserved",
     [](World& w, std::int32_t v) {
       w.atoms.reserved = v;
       return w.compute();
     }},
    {"meniscus_read_options.reserved",
     [](World& w, std::int32_t v) {
       w.reading.reserved = v;
       return w.read();
     }},
    {"meniscus_camera.reserved",
     [](World& w, std::int32_t v) {
       w.camera.reserved = v;
       return w.paint(&w.camera);
     }},
};

/// Checks that a call is refused with a message.
void expect_refused(meniscus_status status, const char* place) {
  EXPECT_TRUE(status == MENISCUS_USAGE || status == MENISCUS_INPUT || status == MENISCUS_CAPACITY)
      << place << ": " << status;
  EXPECT_STRNE(meniscus_last_error(), "") << place;
}

TEST(CArguments, PointersAreLookedAtBeforeTheyAreFollowed) {
  for (const Pointer& pointer : kPointers) {
    SCOPED_TRACE(pointer.place);
    const std::string name = std::string(pointer.place).substr(std::string(pointer.place).find_last_of(" .") + 1);
    const auto with = [&](const void* address) {
      World world;
      return pointer.call(world, address);
    };
    const meniscus_status of_null = with(nullptr);
    EXPECT_EQ(of_null, pointer.may_be_null ? MENISCUS_OK : MENISCUS_USAGE) << meniscus_last_error();
    if (!pointer.may_be_null) {
      EXPECT_NE(std::string(meniscus_last_error()).find("is NULL"), std::string::npos) << meniscus_last_error();
    }
    if (pointer.text) continue;
    EXPECT_EQ(with(crooked + 1), MENISCUS_USAGE);
    EXPECT_NE(std::string(meniscus_last_error()).find("not aligned"), std::string::npos) << meniscus_last_error();
  }
}

TEST(CArguments, CountsAndStridesThatNoMemoryHasAreRefused) {
  constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();
  for (const Size& size : kSizes)
    for (const std::size_t value : {kMost, kMost - 7, kMost - 23, kMost / 2 + 1, kMost / 2 - 7, kMost / 4 + 9}) {
      SCOPED_TRACE(std::to_string(value));
      World world;
      const std::vector<double> before = world.numbers;
      if (std::string_view(size.place).ends_with(" rgba_size") && value < kMost / 2) continue;  // There is room enough.
      expect_refused(size.call(world, value), size.place);
      EXPECT_EQ(world.numbers, before);
    }
}

TEST(CArguments, UnknownWordsAreRefused) {
  for (const Word& word : kWords)
    for (const std::int32_t value :
         {-1, 1000, std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()}) {
      World world;
      expect_refused(word.call(world, value), word.place);
    }
}

TEST(CArguments, ArraysOfADistanceDoNotOverlap) {
  World w;
  const auto distance = [&](double* distances, double* nearest) {
    return meniscus_surface_distance(w.surface.get(), 2, w.n, distances, nearest);
  };
  EXPECT_EQ(distance(w.n, nullptr), MENISCUS_USAGE);
  EXPECT_EQ(distance(w.n + 5, nullptr), MENISCUS_USAGE);
  EXPECT_EQ(distance(w.n + 6, w.n + 3), MENISCUS_USAGE);
  EXPECT_EQ(distance(w.n + 6, w.n + 7), MENISCUS_USAGE);
  EXPECT_NE(std::strstr(meniscus_last_error(), "overlap"), nullptr) << meniscus_last_error();
  EXPECT_EQ(distance(w.n + 6, w.n + 8), MENISCUS_OK);
  EXPECT_EQ(distance(w.n + 6, w.n), MENISCUS_OK);  // The results replace the points.
}

TEST(CArguments, NullHasNoHolders) {
  EXPECT_EQ(meniscus_computer_retain(nullptr), nullptr);
  EXPECT_EQ(meniscus_structure_retain(nullptr), nullptr);
  EXPECT_EQ(meniscus_surface_retain(nullptr), nullptr);
  EXPECT_EQ(meniscus_pockets_retain(nullptr), nullptr);
  EXPECT_EQ(meniscus_mesh_retain(nullptr), nullptr);
  EXPECT_EQ(meniscus_renderer_retain(nullptr), nullptr);
  EXPECT_EQ(meniscus_scene_retain(nullptr), nullptr);
  meniscus_computer_release(nullptr);
  meniscus_structure_release(nullptr);
  meniscus_surface_release(nullptr);
  meniscus_pockets_release(nullptr);
  meniscus_mesh_release(nullptr);
  meniscus_renderer_release(nullptr);
  meniscus_scene_release(nullptr);
}

/// Returns the header's places: "function argument" of all functions, "struct.field" of pointers, sizes and reserved
/// fields of structs that begin with their size.
std::set<std::string> places_of_header() {
  std::ifstream file(MENISCUS_HEADER);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  text = std::regex_replace(text, std::regex(R"(/\*[\s\S]*?\*/)"), "");
  std::set<std::string> places;
  const auto each = [](const std::string& in, const char* pattern, const auto& use) {
    const std::regex regex(pattern);
    for (std::sregex_iterator at(in.begin(), in.end(), regex), end; at != end; ++at) use(*at);
  };
  each(text, R"(MENISCUS_API [^;(]*?\b(meniscus_\w+)\(([^)]*)\);)", [&](const std::smatch& function) {
    const std::string name = function[1], arguments = function[2];
    if (name.ends_with("_retain") || name.ends_with("_release")) return;
    each(arguments, R"((\w+)\s*(?:,|$))", [&](const std::smatch& argument) {
      if (argument[1] != "void") places.insert(name + " " + argument[1].str());
    });
  });
  each(text, R"(typedef struct (meniscus_\w+) \{\s*size_t size;([^}]*)\})", [&](const std::smatch& found) {
    places.insert(found[1].str() + ".size");
    each(found[2], R"((?:\*\s*|size_t |int32_t (?=reserved))(\w+);)",
         [&](const std::smatch& field) { places.insert(found[1].str() + "." + field[1].str()); });
  });
  return places;
}

TEST(CArguments, AreAllOfTheHeader) {
  // The tables lack a range, which CApiPictures tests, a place that may lie after the last, and texts for callers.
  std::set<std::string> known{"meniscus_surface_camera aspect", "meniscus_scene_get n",
                              "meniscus_summary.device",        "meniscus_read_report.file",
                              "meniscus_read_report.format",    "meniscus_read_report.radii_set",
                              "meniscus_read_report.sentence"};
  for (const Pointer& pointer : kPointers) known.insert(pointer.place);
  for (const Size& size : kSizes) known.insert(size.place);
  for (const Word& word : kWords) known.insert(word.place);
  const std::set<std::string> there = places_of_header();
  EXPECT_GT(there.size(), 70u);
  for (const std::string& place : there) EXPECT_TRUE(known.contains(place)) << place << " is in no table of this test";
  for (const std::string& place : known) EXPECT_TRUE(there.contains(place)) << place << " is not in the header";
}

}  // namespace
}  // namespace meniscus
