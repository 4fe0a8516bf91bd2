// SPDX-License-Identifier: BSD-3-Clause
// Exact solvent-excluded surfaces of molecules for other programs, in C++20: meniscus.h with spans and exceptions.
//
//   meniscus::Computer computer;
//   const meniscus::Structure molecule = meniscus::read("1ubq.cif");
//   std::cout << computer.compute(molecule.atoms()).area() << " Å^2\n";
//   const std::vector<double> xyz = {0, 0, 0, 1.5, 0, 0}, radii = {1.7, 1.52};
//   std::cout << computer.compute({xyz, radii}).area() << " Å^2\n";
//
// All of it is inline and calls the C functions, so what a program is linked to is the C interface alone: a program
// that was compiled with one compiler, C++ library and version of this header runs with libmeniscus of another. Structs
// are those of meniscus.h, where their fields, units and ranges are: lengths in Å, areas in Å^2, volumes in Å^3,
// angles in radian (a camera's in degrees). Option structs have their defaults from the beginning.
//
// Errors. Whatever fails throws an Error with the library's sentence; what was to be changed is as before.
//
// Ownership. Computer, Structure, Surface, Mesh, Scene, Renderer and Page own one object each, and move; of what was
// moved from only assignment and the end are left. Spans and rows of a surface or a mesh are its own memory, seen
// without a copy: they end with it, and with Computer::recompute(atoms, surface), which computes it again.
//
// Threads. As in meniscus.h: const functions of one object from any number of threads at once; a Computer and a
// Renderer serve one call after the other.
#ifndef MENISCUS_MENISCUS_HPP
#define MENISCUS_MENISCUS_HPP

#if __cplusplus < 202002L && (!defined(_MSVC_LANG) || _MSVC_LANG < 202002L)
#error "meniscus.hpp needs C++20: -std=c++20 or /std:c++20; meniscus.h is for C99 and any C++"
#endif

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <meniscus/meniscus.h>

namespace meniscus {
// Parts of one program may be compiled with different versions of this header.
inline namespace v0 {

// ---- Errors ----

// What the library refused or could not do.
class Error : public std::runtime_error {
 public:
  Error(meniscus_status status, const std::string& text) : std::runtime_error(text), status_(status) {}
  // Never MENISCUS_OK.
  meniscus_status status() const noexcept { return status_; }

 private:
  meniscus_status status_;
};

// One class a status, to be caught by itself.
template <meniscus_status Status>
class ErrorOf : public Error {
 public:
  explicit ErrorOf(const std::string& text) : Error(Status, text) {}
};
using InternalError = ErrorOf<MENISCUS_INTERNAL>;     // a fault of the library: please report it
using UsageError = ErrorOf<MENISCUS_USAGE>;           // a call that is not valid
using InputError = ErrorOf<MENISCUS_INPUT>;           // a position, radius, colour or camera that cannot be
using GpuError = ErrorOf<MENISCUS_NO_GPU>;            // no usable GL or GPU, or one that left work undone
using CapacityError = ErrorOf<MENISCUS_CAPACITY>;     // out of memory or threads, or more than indices can count
using OutputError = ErrorOf<MENISCUS_OUTPUT>;         // a file cannot be written, or is there already
using NotClosedError = ErrorOf<MENISCUS_NOT_CLOSED>;  // the surface or mesh is not closed, so there is none

// Throws what a C function's status says; returns if it is MENISCUS_OK.
inline void check(meniscus_status status) {
  switch (status) {
    case MENISCUS_OK:
      return;
    case MENISCUS_INTERNAL:
      throw InternalError(meniscus_last_error());
    case MENISCUS_USAGE:
      throw UsageError(meniscus_last_error());
    case MENISCUS_INPUT:
      throw InputError(meniscus_last_error());
    case MENISCUS_NO_GPU:
      throw GpuError(meniscus_last_error());
    case MENISCUS_CAPACITY:
      throw CapacityError(meniscus_last_error());
    case MENISCUS_OUTPUT:
      throw OutputError(meniscus_last_error());
    case MENISCUS_NOT_CLOSED:
      throw NotClosedError(meniscus_last_error());
  }
  throw Error(status, meniscus_last_error());  // a status of a newer library
}

namespace detail {

// Calls a C function whose last parameter is its result, and returns the result.
template <typename Result, typename Function, typename... Arguments>
Result result(Function* function, const Arguments&... arguments) {
  Result result{};
  if constexpr (requires { result.size; }) result.size = sizeof result;
  check(function(arguments..., &result));
  return result;
}

}  // namespace detail

// "0.2.0": of the library that runs, not of this header.
inline std::string version() { return meniscus_version(); }

// ---- Radii ----

// The atomic number of "C", "zn", "CL", ... in any case, D and T as hydrogen; 0: none has this symbol.
inline std::int32_t element_of(const std::string& symbol) {
  return detail::result<std::int32_t>(meniscus_element_of_symbol, symbol.c_str());
}

struct ElementRadius {
  double radius;       // Å, van der Waals
  const char* source;  // who published it, or "no published value": then it is 2.0
};

// By Bondi (1964, 1966) or Mantina et al. (2009). InputError below 0 and above 118.
inline ElementRadius radius_of(std::int32_t element) {
  ElementRadius found{};
  check(meniscus_element_radius(element, &found.radius, &found.source));
  return found;
}

// ---- Options ----

// A struct of meniscus.h with its size and its defaults.
template <typename Struct, meniscus_status (*Defaults)(Struct*)>
struct WithDefaults : Struct {
  WithDefaults() : Struct{} {
    this->size = sizeof(Struct);
    check(Defaults(this));
  }
};
using Options = WithDefaults<meniscus_options, meniscus_default_options>;
using MeshOptions = WithDefaults<meniscus_mesh_options, meniscus_default_mesh_options>;
using ReadOptions = WithDefaults<meniscus_read_options, meniscus_default_read_options>;
using PocketOptions = WithDefaults<meniscus_pocket_options, meniscus_default_pocket_options>;
using MeshFile = WithDefaults<meniscus_mesh_file, meniscus_default_mesh_file>;
using Camera = meniscus_camera;  // as Surface::camera gives it
using Ball = meniscus_ball;

// The atoms of one call: arrays of the caller's, read during the call only. Positions are x, y, z of each atom, next to
// each other, in Å, within 100,000 of 0; radii are above 0 and at most 1,000, one per atom, or one for all. In a call:
// compute({positions, radii}), compute({balls}), compute(structure.atoms()).
class Atoms {
 public:
  Atoms(std::span<const double> positions, std::span<const double> radii) : Atoms(positions, radii, MENISCUS_DOUBLE) {}
  Atoms(std::span<const float> positions, std::span<const float> radii) : Atoms(positions, radii, MENISCUS_FLOAT) {}
  Atoms(std::span<const Ball> balls) : Atoms() {
    atoms_.count = balls.size();
    if (balls.empty()) return;
    atoms_.positions = balls.front().center;
    atoms_.radii = &balls.front().radius;
    atoms_.positions_stride = atoms_.radii_stride = sizeof(Ball);
  }
  explicit Atoms(const meniscus_atoms& atoms) : atoms_(atoms) {}
  const meniscus_atoms& get() const noexcept { return atoms_; }

 private:
  Atoms() { atoms_.size = sizeof atoms_; }
  template <typename Number>
  Atoms(std::span<const Number> positions, std::span<const Number> radii, meniscus_number_type type) : Atoms() {
    atoms_.count = positions.size() / 3;
    const bool equal_radii = radii.size() == 1;
    if (positions.size() % 3 != 0 || (!equal_radii && radii.size() != atoms_.count))
      throw UsageError("coordinates are " + std::to_string(positions.size()) + ", radii " +
                       std::to_string(radii.size()) + "; give three coordinates an atom, and a radius for each or one");
    atoms_.positions = positions.data();
    atoms_.radii = radii.data();
    atoms_.positions_type = atoms_.radii_type = type;
    atoms_.equal_radii = equal_radii ? 1 : 0;
  }

  meniscus_atoms atoms_{};
};

// ---- Tables ----

// Rows of a table, which in a newer library may be longer than Row.
template <typename Row>
class Rows {
 public:
  class iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = Row;
    using difference_type = std::ptrdiff_t;
    using pointer = const Row*;
    using reference = const Row&;

    iterator() = default;
    iterator(const std::byte* row, std::size_t stride) : row_(row), stride_(stride) {}
    reference operator*() const { return *operator->(); }
    pointer operator->() const { return reinterpret_cast<pointer>(row_); }
    iterator& operator++() {
      row_ += stride_;
      return *this;
    }
    iterator operator++(int) {
      iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const iterator& other) const { return row_ == other.row_; }

   private:
    const std::byte* row_ = nullptr;
    std::size_t stride_ = 0;
  };

  explicit Rows(const meniscus_array& array) : array_(array) {}
  std::size_t size() const noexcept { return array_.count; }
  bool empty() const noexcept { return array_.count == 0; }
  // n is below size().
  const Row& operator[](std::size_t n) const { return *at(n); }
  iterator begin() const { return at(0); }
  iterator end() const { return at(array_.count); }

 private:
  iterator at(std::size_t n) const {
    return {static_cast<const std::byte*>(array_.data) + n * array_.stride, array_.stride};
  }
  meniscus_array array_;
};

// Rows of text, without the zeros that fill them up.
class Texts {
 public:
  explicit Texts(const meniscus_array& array) : array_(array) {}
  std::size_t size() const noexcept { return array_.count; }
  bool empty() const noexcept { return array_.count == 0; }
  // n is below size().
  std::string_view operator[](std::size_t n) const { return static_cast<const char*>(array_.data) + n * array_.stride; }

 private:
  meniscus_array array_;
};

// x, y, z in Å (of a normal: of length 1).
using Vector = std::array<double, 3>;

// How the classes below hold a C object.
namespace detail {

template <auto Function>
struct Calls {
  template <typename Object>
  void operator()(Object* object) const noexcept {
    Function(object);
  }
};

template <typename Object, auto Release>
using Handle = std::unique_ptr<Object, Calls<Release>>;

// A table whose rows are numbers, or arrays of them: these never grow.
template <typename Row>
std::span<const Row> numbers(const meniscus_array& array) {
  return {static_cast<const Row*>(array.data), array.count};
}

}  // namespace detail

// ---- Molecules from files ----

// The atoms of a file that a surface is made of, a row each in every table. It never changes.
class Structure {
 public:
  explicit Structure(meniscus_structure* owned) : structure_(owned) {}

  // What was read and left out. Its texts live as long as this.
  meniscus_read_report report() const {
    return detail::result<meniscus_read_report>(meniscus_structure_report, structure_.get());
  }
  // What is odd in the file, a sentence each.
  Texts warnings() const { return Texts(table(MENISCUS_STRUCTURE_WARNINGS)); }

  // For Computer::compute(), while this lives.
  Atoms atoms() const { return Atoms(detail::result<meniscus_atoms>(meniscus_structure_atoms, structure_.get())); }
  std::size_t size() const { return table(MENISCUS_STRUCTURE_RADII).count; }

  // As meniscus.h describes the columns.
  Rows<Vector> positions() const { return Rows<Vector>(table(MENISCUS_STRUCTURE_POSITIONS)); }
  Rows<double> radii() const { return Rows<double>(table(MENISCUS_STRUCTURE_RADII)); }
  Rows<std::uint8_t> elements() const { return Rows<std::uint8_t>(table(MENISCUS_STRUCTURE_ELEMENTS)); }
  Rows<std::uint32_t> indices() const { return Rows<std::uint32_t>(table(MENISCUS_STRUCTURE_INDICES)); }
  Texts names() const { return Texts(table(MENISCUS_STRUCTURE_NAMES)); }
  Texts residue_names() const { return Texts(table(MENISCUS_STRUCTURE_RESIDUE_NAMES)); }
  Texts chains() const { return Texts(table(MENISCUS_STRUCTURE_CHAINS)); }
  Texts segments() const { return Texts(table(MENISCUS_STRUCTURE_SEGMENTS)); }
  Rows<std::int32_t> residue_numbers() const { return Rows<std::int32_t>(table(MENISCUS_STRUCTURE_RESIDUE_NUMBERS)); }
  Rows<char> insertion_codes() const { return Rows<char>(table(MENISCUS_STRUCTURE_INSERTION_CODES)); }
  Rows<char> altlocs() const { return Rows<char>(table(MENISCUS_STRUCTURE_ALTLOCS)); }
  Rows<std::uint32_t> residues() const { return Rows<std::uint32_t>(table(MENISCUS_STRUCTURE_RESIDUES)); }
  Rows<std::int32_t> models() const { return Rows<std::int32_t>(table(MENISCUS_STRUCTURE_MODELS)); }
  Rows<std::uint32_t> copies() const { return Rows<std::uint32_t>(table(MENISCUS_STRUCTURE_COPIES)); }
  Rows<float> charges() const { return Rows<float>(table(MENISCUS_STRUCTURE_CHARGES)); }
  Rows<float> b_factors() const { return Rows<float>(table(MENISCUS_STRUCTURE_B_FACTORS)); }
  Rows<float> occupancies() const { return Rows<float>(table(MENISCUS_STRUCTURE_OCCUPANCIES)); }
  Rows<std::uint8_t> classes() const { return Rows<std::uint8_t>(table(MENISCUS_STRUCTURE_CLASSES)); }
  Rows<double> hydropathies() const { return Rows<double>(table(MENISCUS_STRUCTURE_HYDROPATHIES)); }
  // By "chain", "bfactor", "#ffd700", ...: three numbers an atom, sRGB in [0, 1].
  std::vector<float> colors(const std::string& scheme) const {
    std::vector<float> colors(3 * size());
    check(meniscus_structure_colors(structure_.get(), scheme.c_str(), colors.data()));
    return colors;
  }

  // For the functions of meniscus.h; owned by this.
  meniscus_structure* get() const noexcept { return structure_.get(); }

 private:
  meniscus_array table(meniscus_structure_table_id which) const {
    return detail::result<meniscus_array>(meniscus_structure_table, structure_.get(), which);
  }
  detail::Handle<meniscus_structure, meniscus_structure_release> structure_;
};

// Reads a molecule as the program does. InputError names file, line and what is wrong there; UsageError a selection or
// an option that cannot be.
inline Structure read(const std::string& path, const ReadOptions& options = {}) {
  return Structure(detail::result<meniscus_structure*>(meniscus_read, path.c_str(), &options));
}

// ---- Meshes ----

// A closed triangle mesh; all vertices lie on the exact surface, no point of it is farther than the tolerance, if one
// was asked for. It may outlive its surface, of which it keeps what files need.
class Mesh {
 public:
  explicit Mesh(meniscus_mesh* owned) : mesh_(owned) {}

  std::span<const Vector> positions() const { return table<Vector>(MENISCUS_MESH_POSITIONS); }
  std::span<const Vector> normals() const { return table<Vector>(MENISCUS_MESH_NORMALS); }
  // Vertices, counter-clockwise seen from the solvent.
  std::span<const std::array<std::uint32_t, 3>> triangles() const {
    return table<std::array<std::uint32_t, 3>>(MENISCUS_MESH_TRIANGLES);
  }
  // Of each triangle the atom whose contact is nearest.
  std::span<const std::uint32_t> triangle_atoms() const { return table<std::uint32_t>(MENISCUS_MESH_TRIANGLE_ATOMS); }
  // MENISCUS_KIND_... of each triangle.
  std::span<const std::uint8_t> triangle_kinds() const { return table<std::uint8_t>(MENISCUS_MESH_TRIANGLE_KINDS); }
  // Rows of Surface::faces().
  std::span<const std::uint32_t> triangle_faces() const { return table<std::uint32_t>(MENISCUS_MESH_TRIANGLE_FACES); }
  // Rows of the table of its kind.
  std::span<const std::uint32_t> triangle_patches() const {
    return table<std::uint32_t>(MENISCUS_MESH_TRIANGLE_PATCHES);
  }
  // Rows of Surface::components().
  std::span<const std::uint32_t> triangle_components() const {
    return table<std::uint32_t>(MENISCUS_MESH_TRIANGLE_COMPONENTS);
  }
  // Of each vertex the atom whose contact is nearest.
  std::span<const std::uint32_t> vertex_atoms() const { return table<std::uint32_t>(MENISCUS_MESH_VERTEX_ATOMS); }
  // Corners (3 * triangle + 0, 1, 2) at cusps, ascending, and the exact normals there.
  std::span<const std::uint32_t> sharp_corners() const { return table<std::uint32_t>(MENISCUS_MESH_SHARP_CORNERS); }
  std::span<const Vector> sharp_normals() const { return table<Vector>(MENISCUS_MESH_SHARP_NORMALS); }

  // Writes a file, whole or not at all, in the format of the path's ending unless `file` names one. OutputError where
  // there is one already, unless it may be replaced.
  void save(const std::string& path, const MeshFile& file = {}) const {
    check(meniscus_mesh_save(mesh_.get(), path.c_str(), &file));
  }

  // For the functions of meniscus.h; owned by this.
  meniscus_mesh* get() const noexcept { return mesh_.get(); }

 private:
  template <typename Row>
  std::span<const Row> table(meniscus_mesh_table_id which) const {
    return detail::numbers<Row>(detail::result<meniscus_array>(meniscus_mesh_table, mesh_.get(), which));
  }
  detail::Handle<meniscus_mesh, meniscus_mesh_release> mesh_;
};

// ---- Pockets ----

// Pockets, tunnels and cavities, the largest volume first. They may outlive their surface.
class Pockets {
 public:
  explicit Pockets(meniscus_pockets* owned) : pockets_(owned) {}

  // Each with its places in the tables below.
  Rows<meniscus_pocket> rows() const { return Rows<meniscus_pocket>(table(MENISCUS_POCKETS)); }
  // Å^2 of the mouths of all, of atoms that line them, and centres of probes at rest in them.
  std::span<const double> mouth_areas() const { return detail::numbers<double>(table(MENISCUS_POCKET_MOUTHS)); }
  std::span<const std::uint32_t> atoms() const { return detail::numbers<std::uint32_t>(table(MENISCUS_POCKET_ATOMS)); }
  std::span<const Vector> probes() const { return detail::numbers<Vector>(table(MENISCUS_POCKET_PROBES)); }

  // For the functions of meniscus.h; owned by this.
  meniscus_pockets* get() const noexcept { return pockets_.get(); }

 private:
  meniscus_array table(meniscus_pockets_table_id which) const {
    return detail::result<meniscus_array>(meniscus_pockets_table, pockets_.get(), which);
  }
  detail::Handle<meniscus_pockets, meniscus_pockets_release> pockets_;
};

// ---- Surfaces ----

// A closed surface with its certificate: every border has two faces, areas and volumes are proved.
class Surface {
 public:
  explicit Surface(meniscus_surface* owned) : surface_(owned) {}

  // Everything that is one number.
  meniscus_summary summary() const {
    return detail::result<meniscus_summary>(meniscus_surface_summary, surface_.get());
  }
  // Å^2, of all components.
  double area() const { return summary().area; }
  // Å^3 of the solid: outer components less cavities.
  double volume() const { return summary().volume; }

  // Outer ones first, then cavities, each by falling area.
  Rows<meniscus_component> components() const { return rows<meniscus_component>(MENISCUS_COMPONENTS); }
  // Å^2 of each atom, 0 where buried; the sum is the area. Found when they are first asked for.
  std::span<const double> atom_areas() const { return numbers<double>(MENISCUS_ATOM_AREAS); }
  // Å^2 of each atom: where the probe's centre can be. UsageError but for MENISCUS_SES.
  std::span<const double> atom_sas_areas() const { return numbers<double>(MENISCUS_ATOM_SAS_AREAS); }
  // What was computed: radii with the probe for MENISCUS_SAS.
  std::span<const Ball> atoms() const { return numbers<Ball>(MENISCUS_ATOMS); }

  // The analytic patches and how they hang together, as meniscus.h describes their rows.
  Rows<meniscus_convex> convex() const { return rows<meniscus_convex>(MENISCUS_CONVEX); }
  Rows<meniscus_toroidal> toroidal() const { return rows<meniscus_toroidal>(MENISCUS_TOROIDAL); }
  Rows<meniscus_concave> concave() const { return rows<meniscus_concave>(MENISCUS_CONCAVE); }
  Rows<meniscus_plane> planes() const { return rows<meniscus_plane>(MENISCUS_PLANES); }
  Rows<meniscus_border> borders() const { return rows<meniscus_border>(MENISCUS_BORDERS); }
  Rows<meniscus_loop> loops() const { return rows<meniscus_loop>(MENISCUS_LOOPS); }
  Rows<meniscus_face> faces() const { return rows<meniscus_face>(MENISCUS_FACES); }
  std::span<const std::uint32_t> contacts() const { return numbers<std::uint32_t>(MENISCUS_CONTACTS); }
  std::span<const std::uint32_t> cuts() const { return numbers<std::uint32_t>(MENISCUS_CUTS); }
  std::span<const std::uint32_t> half_borders() const { return numbers<std::uint32_t>(MENISCUS_HALF_BORDERS); }
  std::span<const Vector> vertices() const { return numbers<Vector>(MENISCUS_VERTICES); }

  // Of each point (finite, in Å) the Euclidean distance to the nearest point of the surface: above 0 in the solvent,
  // below 0 in the solid.
  std::vector<double> distance(std::span<const Vector> points) const {
    std::vector<double> distances(points.size());
    check(meniscus_surface_distance(surface_.get(), points.size(), coordinates(points), distances.data(), nullptr));
    return distances;
  }

  struct Nearest {
    std::vector<double> distances;
    std::vector<Vector> feet;  // of the surface
  };
  // The nearest points, too; where several are as near, one of them.
  Nearest nearest(std::span<const Vector> points) const {
    Nearest found{std::vector<double>(points.size()), std::vector<Vector>(points.size())};
    check(meniscus_surface_distance(surface_.get(), points.size(), coordinates(points), found.distances.data(),
                                    found.feet.empty() ? nullptr : found.feet.front().data()));
    return found;
  }

  // The exact derivative of MENISCUS_GRADIENT_... by the position of each atom. weights: none, or one an atom, where
  // the number is a sum over atoms. InputError where a probe touches more than three atoms and there is none.
  std::vector<Vector> gradient(meniscus_quantity quantity, std::span<const double> weights = {}) const {
    if (!weights.empty() && weights.size() != atoms().size())
      throw UsageError("there are " + std::to_string(weights.size()) + " weights for " +
                       std::to_string(atoms().size()) + " atoms");
    std::vector<Vector> gradient(atoms().size());
    check(meniscus_surface_gradient(surface_.get(), quantity, weights.empty() ? nullptr : weights.data(),
                                    gradient.front().data()));
    return gradient;
  }

  // What its probe fills of the solid that a large one rolls over; of MENISCUS_SES only, else UsageError.
  Pockets pockets(const PocketOptions& options = {}) const {
    return Pockets(detail::result<meniscus_pockets*>(meniscus_surface_pockets, surface_.get(), &options));
  }

  Mesh mesh(const MeshOptions& options = {}) const {
    return Mesh(detail::result<meniscus_mesh*>(meniscus_surface_mesh, surface_.get(), &options));
  }

  // The camera that shows all atoms in a picture of this width / height.
  Camera camera(double aspect, meniscus_projection projection = MENISCUS_PERSPECTIVE) const {
    return detail::result<Camera>(meniscus_surface_camera, surface_.get(), aspect, projection);
  }

  // For the functions of meniscus.h; owned by this.
  meniscus_surface* get() const noexcept { return surface_.get(); }

 private:
  friend class Computer;

  meniscus_array table(meniscus_surface_table_id which) const {
    return detail::result<meniscus_array>(meniscus_surface_table, surface_.get(), which);
  }
  template <typename Row>
  Rows<Row> rows(meniscus_surface_table_id which) const {
    return Rows<Row>(table(which));
  }
  template <typename Row>
  std::span<const Row> numbers(meniscus_surface_table_id which) const {
    return detail::numbers<Row>(table(which));
  }
  static const double* coordinates(std::span<const Vector> points) {
    return points.empty() ? nullptr : points.front().data();
  }
  detail::Handle<meniscus_surface, meniscus_surface_release> surface_;
};

// ---- Computing ----

// Keeps what is worth keeping from frame to frame: a GL context, its kernels and buffers.
class Computer {
 public:
  explicit Computer(const Options& options = {})
      : computer_(detail::result<meniscus_computer*>(meniscus_computer_new, &options)) {}

  // InputError for an atom that cannot be, with its index and value; NotClosedError names atoms.
  Surface compute(const Atoms& atoms) const {
    return Surface(detail::result<meniscus_surface*>(meniscus_compute, computer_.get(), &atoms.get()));
  }
  // The next frame, in the memory of the one before. If it throws the surface stays as it was.
  void recompute(const Atoms& atoms, Surface& surface) const {
    meniscus_surface* in_place = surface.surface_.release();
    const meniscus_status status = meniscus_recompute(computer_.get(), &atoms.get(), &in_place);
    surface.surface_.reset(in_place);
    check(status);
  }

  // For the functions of meniscus.h; owned by this.
  meniscus_computer* get() const noexcept { return computer_.get(); }

 private:
  detail::Handle<meniscus_computer, meniscus_computer_release> computer_;
};

// ---- Pictures ----

// Pixels: red, green, blue, alpha (not multiplied in), rows from the top.
struct Picture {
  std::int32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  // width * height * 4
};

// Everything that can be chosen of a picture, as one value. Names, keys and texts are those of meniscus_scene_set():
// Scene().set("file", "1ubq.cif").set("color", "chain").render().
class Scene {
 public:
  // With the defaults of the program.
  Scene() : scene_(detail::result<meniscus_scene*>(meniscus_scene_new)) {}
  explicit Scene(meniscus_scene* owned) : scene_(owned) {}

  // A scene file of the program. InputError names the place in it.
  static Scene read(const std::string& path) {
    return Scene(detail::result<meniscus_scene*>(meniscus_scene_read, path.c_str()));
  }
  // The text of one. Paths are seen from the working directory.
  static Scene parse(const std::string& json) {
    return Scene(detail::result<meniscus_scene*>(meniscus_scene_parse, json.c_str()));
  }

  // Sets a value, or adds it where there may be several. UsageError begins with the name.
  Scene& set(const std::string& name, const std::string& value) {
    check(meniscus_scene_set(scene_.get(), name.c_str(), value.c_str()));
    return *this;
  }
  // Back to the default.
  Scene& reset(const std::string& name) {
    check(meniscus_scene_set(scene_.get(), name.c_str(), nullptr));
    return *this;
  }
  // The n-th value of a name; nothing where it is the default.
  std::optional<std::string> get(const std::string& name, std::size_t n = 0) const {
    const char* const value = detail::result<const char*>(meniscus_scene_get, scene_.get(), name.c_str(), n);
    return value ? std::optional<std::string>(value) : std::nullopt;
  }
  // As its file has it. folder: from which paths are seen; empty: the working directory.
  std::string json(const std::string& folder = {}) const {
    return detail::result<const char*>(meniscus_scene_json, scene_.get(), folder.empty() ? nullptr : folder.c_str());
  }
  // What can be set.
  static Rows<meniscus_property> properties() {
    return Rows<meniscus_property>(detail::result<meniscus_array>(meniscus_scene_properties));
  }

  // A transparent picture of its size.
  Picture blank() const {
    Picture picture;
    check(meniscus_scene_size(scene_.get(), &picture.width, &picture.height));
    picture.rgba.resize(std::size_t{4} * static_cast<std::size_t>(picture.width) *
                        static_cast<std::size_t>(picture.height));
    return picture;
  }
  // As `meniscus render` draws it. Renderer::render() keeps what is worth keeping between pictures.
  Picture render(meniscus_device device = MENISCUS_AUTO) const;

  // For the functions of meniscus.h; owned by this.
  meniscus_scene* get() const noexcept { return scene_.get(); }

 private:
  detail::Handle<meniscus_scene, meniscus_scene_release> scene_;
};

namespace detail {

// NULL for none. UsageError where there are not three an atom.
inline const float* channels(const Surface& surface, std::span<const float> atom_colors) {
  if (!atom_colors.empty() && atom_colors.size() != 3 * surface.atoms().size())
    throw UsageError("there are " + std::to_string(atom_colors.size()) + " channels for " +
                     std::to_string(surface.atoms().size()) + " atoms; give three an atom");
  return atom_colors.empty() ? nullptr : atom_colors.data();
}

}  // namespace detail

// On the CPU, or on GL in a context of its own with its kernels, on a thread of its own.
class Renderer {
 public:
  // MENISCUS_AUTO (a hardware GPU if one works, else the CPU), MENISCUS_CPU, MENISCUS_GPU or MENISCUS_SOFTWARE.
  // GpuError where GL is asked for and there is no GL 4.5.
  explicit Renderer(meniscus_device device = MENISCUS_AUTO)
      : renderer_(detail::result<meniscus_renderer*>(meniscus_renderer_new, device)) {}

  // As `meniscus render` draws it: its molecule is read and computed here.
  Picture render(const Scene& scene) const {
    Picture picture = scene.blank();
    check(meniscus_render_scene(renderer_.get(), scene.get(), picture.rgba.data(), picture.rgba.size()));
    return picture;
  }
  // An exact surface, with the look and the size of a scene. camera: nullptr for Surface::camera(). atom_colors: none,
  // or sRGB in [0, 1], three per atom.
  Picture render(const Surface& surface, const Scene& scene = {}, const Camera* camera = nullptr,
                 std::span<const float> atom_colors = {}) const {
    Picture picture = scene.blank();
    check(meniscus_render(renderer_.get(), surface.get(), scene.get(), camera, detail::channels(surface, atom_colors),
                          picture.rgba.data(), picture.rgba.size()));
    return picture;
  }

  // For the functions of meniscus.h; owned by this.
  meniscus_renderer* get() const noexcept { return renderer_.get(); }

 private:
  detail::Handle<meniscus_renderer, meniscus_renderer_release> renderer_;
};

inline Picture Scene::render(meniscus_device device) const { return Renderer(device).render(*this); }

// ---- Pages ----

// A web page of one file in which readers turn the exact surface; it fetches nothing.
class Page {
 public:
  // As `meniscus export page` makes it. UsageError for what pages do not show.
  explicit Page(const Scene& scene) : page_(detail::result<meniscus_page*>(meniscus_scene_page, scene.get())) {}
  // Of an exact surface, with the look of a scene. structure: nullptr, or what names its atoms, in the same order. The
  // rest as for Renderer::render().
  explicit Page(const Surface& surface, const Structure* structure = nullptr, const Scene& scene = {},
                const Camera* camera = nullptr, std::span<const float> atom_colors = {})
      : page_(detail::result<meniscus_page*>(meniscus_surface_page, surface.get(),
                                             structure ? structure->get() : nullptr, scene.get(), camera,
                                             detail::channels(surface, atom_colors))) {}

  // Its text, which ends with it.
  std::string_view html() const {
    const char* html = nullptr;
    std::size_t size = 0;
    check(meniscus_page_html(page_.get(), &html, &size));
    return {html, size};
  }

  // For the functions of meniscus.h; owned by this.
  meniscus_page* get() const noexcept { return page_.get(); }

 private:
  detail::Handle<meniscus_page, meniscus_page_release> page_;
};

}  // namespace v0
}  // namespace meniscus

#endif
