// SPDX-License-Identifier: BSD-3-Clause
// The C++20 interface of libmeniscus, which computes exact solvent-excluded surfaces of molecules: meniscus.h with
// spans and exceptions.
//
//   meniscus::Computer computer;
//   const meniscus::Structure molecule = meniscus::read("1ubq.cif");
//   std::cout << computer.compute(molecule.atoms()).area() << " Å^2\n";
//   const std::vector<double> xyz = {0, 0, 0, 1.5, 0, 0}, radii = {1.7, 1.52};
//   std::cout << computer.compute({xyz, radii}).area() << " Å^2\n";
//
// All functions are inline and call the C functions, so a program is linked to the C interface only. A program that was
// compiled with one compiler, C++ library and version of this header also runs with a libmeniscus that was compiled
// with others. Structs are those of meniscus.h, which describes their fields, units and ranges: lengths are in Å, areas
// in Å^2, volumes in Å^3, and angles in radian (that of a camera in degrees). New structs of options have the defaults.
//
// Errors. A function that fails throws an Error with the message of the library, and leaves objects unchanged. Comments
// name the classes of errors; every function can throw CapacityError and InternalError.
//
// Ownership. Each Computer, Structure, Surface, Pockets, Mesh, Scene, Renderer and Page owns one C object. These
// classes can be moved, but not copied; an object that was moved from can only be assigned to and destroyed. Spans and
// rows view the memory of their object without a copy. They are valid until the object is destroyed, or, for a surface,
// until Computer::recompute() changes it.
//
// Threads. Any number of threads may call const functions of one object at once. A Computer and a Renderer execute one
// call after the other.
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
// The parts of one program may be compiled with different versions of this header.
inline namespace v0 {

// ---- Errors ----

// The base class of all errors of the library.
class Error : public std::runtime_error {
 public:
  Error(meniscus_status status, const std::string& text) : std::runtime_error(text), status_(status) {}
  // Returns the status of the C function, which is never MENISCUS_OK.
  meniscus_status status() const noexcept { return status_; }

 private:
  meniscus_status status_;
};

// The errors with one status. The aliases below are the classes to catch.
template <meniscus_status Status>
class ErrorOf : public Error {
 public:
  explicit ErrorOf(const std::string& text) : Error(Status, text) {}
};
using InternalError = ErrorOf<MENISCUS_INTERNAL>;     // a bug in the library; please report it
using UsageError = ErrorOf<MENISCUS_USAGE>;           // an invalid call
using InputError = ErrorOf<MENISCUS_INPUT>;           // an impossible number or file
using GpuError = ErrorOf<MENISCUS_NO_GPU>;            // no usable GL or GPU, or one that dropped work
using CapacityError = ErrorOf<MENISCUS_CAPACITY>;     // out of memory or threads, or more items than an index can count
using OutputError = ErrorOf<MENISCUS_OUTPUT>;         // a file cannot be written, or it exists already
using NotClosedError = ErrorOf<MENISCUS_NOT_CLOSED>;  // the surface would not be closed

// Throws the error of a status, with the last message of this thread. Returns if the status is MENISCUS_OK.
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

// Returns the version of the loaded library, such as "0.3.0", which may differ from that of this header.
inline std::string version() { return meniscus_version(); }

// ---- Radii ----

// Returns the atomic number of "C", "zn", "CL", ... in upper or lower case; "D" and "T" are hydrogen. 0: no element has
// this symbol.
inline std::int32_t element_of(const std::string& symbol) {
  return detail::result<std::int32_t>(meniscus_element_of_symbol, symbol.c_str());
}

// The van der Waals radius of an element.
struct ElementRadius {
  double radius;       // Å; 2.0 without a published value
  const char* source;  // the names of the authors, or "no published value"
};

// Returns the radius by Bondi (1964, 1966) or Mantina et al. (2009). Throws InputError unless element is 0 to 118.
inline ElementRadius radius_of(std::int32_t element) {
  ElementRadius found{};
  check(meniscus_element_radius(element, &found.radius, &found.source));
  return found;
}

// ---- Options ----

// A struct of meniscus.h that is initialized with its size and its defaults.
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
using Camera = meniscus_camera;  // Surface::camera() returns one with its size
using Ball = meniscus_ball;

// The atoms of a surface, as arrays of the caller, which must exist until the call of Computer::compute() returns.
// Positions are x, y, z of each atom in Å, -100,000 to 100,000. Radii are in Å, above 0 and at most 1,000, one per atom
// or one for all atoms. Examples: compute({positions, radii}), compute({balls}), compute(structure.atoms()). The
// constructors throw UsageError if the lengths of the arrays do not fit.
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

// The rows of a table. In a newer library they may be longer than Row.
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
  // Returns row n; n must be below size().
  const Row& operator[](std::size_t n) const { return *at(n); }
  iterator begin() const { return at(0); }
  iterator end() const { return at(array_.count); }

 private:
  iterator at(std::size_t n) const {
    return {static_cast<const std::byte*>(array_.data) + n * array_.stride, array_.stride};
  }
  meniscus_array array_;
};

// The rows of a table of texts. Texts have no trailing zeros.
class Texts {
 public:
  explicit Texts(const meniscus_array& array) : array_(array) {}
  std::size_t size() const noexcept { return array_.count; }
  bool empty() const noexcept { return array_.count == 0; }
  // Returns row n; n must be below size().
  std::string_view operator[](std::size_t n) const { return static_cast<const char*>(array_.data) + n * array_.stride; }

 private:
  meniscus_array array_;
};

// x, y, z: a position in Å, or a unit vector.
using Vector = std::array<double, 3>;

namespace detail {

// A deleter that calls a C function.
template <auto Function>
struct Calls {
  template <typename Object>
  void operator()(Object* object) const noexcept {
    Function(object);
  }
};

// Owns a C object, and releases it.
template <typename Object, auto Release>
using Handle = std::unique_ptr<Object, Calls<Release>>;

// Returns the rows of a table of numbers or of arrays of numbers, which never grow.
template <typename Row>
std::span<const Row> numbers(const meniscus_array& array) {
  return {static_cast<const Row*>(array.data), array.count};
}

}  // namespace detail

// ---- Molecules from files ----

// The atoms of a file from which a surface is computed. A structure never changes.
class Structure {
 public:
  // Takes over the reference.
  explicit Structure(meniscus_structure* owned) : structure_(owned) {}

  // Returns what was read from the file. The texts belong to this object.
  meniscus_read_report report() const {
    return detail::result<meniscus_read_report>(meniscus_structure_report, structure_.get());
  }
  // Returns sentences about unusual things in the file.
  Texts warnings() const { return Texts(table(MENISCUS_STRUCTURE_WARNINGS)); }

  // Returns the argument for Computer::compute(), with arrays of this object.
  Atoms atoms() const { return Atoms(detail::result<meniscus_atoms>(meniscus_structure_atoms, structure_.get())); }
  // Returns the number of atoms.
  std::size_t size() const { return table(MENISCUS_STRUCTURE_RADII).count; }

  // The columns of meniscus_structure_table_id, with one row per atom.
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
  // Returns the colours of the atoms by a scheme such as "chain", "bfactor" or "#ffd700": three numbers per atom, sRGB
  // in [0, 1]. Throws UsageError for an unknown scheme, and InputError if no atom has the number that it needs.
  std::vector<float> colors(const std::string& scheme) const {
    std::vector<float> colors(3 * size());
    check(meniscus_structure_colors(structure_.get(), scheme.c_str(), colors.data()));
    return colors;
  }

  // Returns the C object for functions of meniscus.h. This object keeps its reference.
  meniscus_structure* get() const noexcept { return structure_.get(); }

 private:
  meniscus_array table(meniscus_structure_table_id which) const {
    return detail::result<meniscus_array>(meniscus_structure_table, structure_.get(), which);
  }
  detail::Handle<meniscus_structure, meniscus_structure_release> structure_;
};

// Reads a molecule from a file. Throws InputError if the file cannot be read, with the path and the line in the
// message, and UsageError for an invalid option or selection.
inline Structure read(const std::string& path, const ReadOptions& options = {}) {
  return Structure(detail::result<meniscus_structure*>(meniscus_read, path.c_str(), &options));
}

// ---- Meshes ----

// A closed triangle mesh, whose vertices lie on the exact surface. A mesh never changes, and does not need its Surface
// any longer. The tables are those of meniscus_mesh_table_id.
class Mesh {
 public:
  // Takes over the reference.
  explicit Mesh(meniscus_mesh* owned) : mesh_(owned) {}

  // The position of each vertex in Å, and the exact unit normal there.
  std::span<const Vector> positions() const { return table<Vector>(MENISCUS_MESH_POSITIONS); }
  std::span<const Vector> normals() const { return table<Vector>(MENISCUS_MESH_NORMALS); }
  // The vertices of each triangle, counter-clockwise as seen from the solvent.
  std::span<const std::array<std::uint32_t, 3>> triangles() const {
    return table<std::array<std::uint32_t, 3>>(MENISCUS_MESH_TRIANGLES);
  }
  // For each triangle, the atom whose contact point is nearest.
  std::span<const std::uint32_t> triangle_atoms() const { return table<std::uint32_t>(MENISCUS_MESH_TRIANGLE_ATOMS); }
  // For each triangle, MENISCUS_KIND_....
  std::span<const std::uint8_t> triangle_kinds() const { return table<std::uint8_t>(MENISCUS_MESH_TRIANGLE_KINDS); }
  // For each triangle, a row of Surface::faces().
  std::span<const std::uint32_t> triangle_faces() const { return table<std::uint32_t>(MENISCUS_MESH_TRIANGLE_FACES); }
  // For each triangle, a row of the table of its kind: Surface::convex(), toroidal() or concave().
  std::span<const std::uint32_t> triangle_patches() const {
    return table<std::uint32_t>(MENISCUS_MESH_TRIANGLE_PATCHES);
  }
  // For each triangle, a row of Surface::components().
  std::span<const std::uint32_t> triangle_components() const {
    return table<std::uint32_t>(MENISCUS_MESH_TRIANGLE_COMPONENTS);
  }
  // For each vertex, the atom whose contact point is nearest.
  std::span<const std::uint32_t> vertex_atoms() const { return table<std::uint32_t>(MENISCUS_MESH_VERTEX_ATOMS); }
  // The corners at cusps (3 * triangle + 0, 1 or 2) in ascending order, and their exact unit normals.
  std::span<const std::uint32_t> sharp_corners() const { return table<std::uint32_t>(MENISCUS_MESH_SHARP_CORNERS); }
  std::span<const Vector> sharp_normals() const { return table<Vector>(MENISCUS_MESH_SHARP_NORMALS); }

  // Writes the mesh to a file, completely or not at all. Throws OutputError if the file cannot be written, or exists
  // and is not replaced; UsageError for an unknown format; NotClosedError if "smesh" finds no point inside a component.
  void save(const std::string& path, const MeshFile& file = {}) const {
    check(meniscus_mesh_save(mesh_.get(), path.c_str(), &file));
  }

  // Returns the C object for functions of meniscus.h. This object keeps its reference.
  meniscus_mesh* get() const noexcept { return mesh_.get(); }

 private:
  template <typename Row>
  std::span<const Row> table(meniscus_mesh_table_id which) const {
    return detail::numbers<Row>(detail::result<meniscus_array>(meniscus_mesh_table, mesh_.get(), which));
  }
  detail::Handle<meniscus_mesh, meniscus_mesh_release> mesh_;
};

// ---- Pockets ----

// The pockets, tunnels and cavities of a surface. They never change, and do not need their Surface any longer.
class Pockets {
 public:
  // Takes over the reference.
  explicit Pockets(meniscus_pockets* owned) : pockets_(owned) {}

  // The pockets in order of descending volume. Each row has its ranges in the tables below.
  Rows<meniscus_pocket> rows() const { return Rows<meniscus_pocket>(table(MENISCUS_POCKETS)); }
  // For all pockets: the areas of mouths in Å^2, the atoms that the probe can touch, and the centres of fixed probes.
  std::span<const double> mouth_areas() const { return detail::numbers<double>(table(MENISCUS_POCKET_MOUTHS)); }
  std::span<const std::uint32_t> atoms() const { return detail::numbers<std::uint32_t>(table(MENISCUS_POCKET_ATOMS)); }
  std::span<const Vector> probes() const { return detail::numbers<Vector>(table(MENISCUS_POCKET_PROBES)); }

  // Returns the C object for functions of meniscus.h. This object keeps its reference.
  meniscus_pockets* get() const noexcept { return pockets_.get(); }

 private:
  meniscus_array table(meniscus_pockets_table_id which) const {
    return detail::result<meniscus_array>(meniscus_pockets_table, pockets_.get(), which);
  }
  detail::Handle<meniscus_pockets, meniscus_pockets_release> pockets_;
};

// ---- Surfaces ----

// A closed surface: every border has two faces. It has passed its certificate, which checks the topology, the areas and
// the volumes.
class Surface {
 public:
  // Takes over the reference.
  explicit Surface(meniscus_surface* owned) : surface_(owned) {}

  // Returns the numbers of the surface.
  meniscus_summary summary() const {
    return detail::result<meniscus_summary>(meniscus_surface_summary, surface_.get());
  }
  // Returns the area of all components in Å^2.
  double area() const { return summary().area; }
  // Returns the volume of the solid in Å^3: of outer components without cavities.
  double volume() const { return summary().volume; }

  // The outer components, then the cavities, each in order of descending area.
  Rows<meniscus_component> components() const { return rows<meniscus_component>(MENISCUS_COMPONENTS); }
  // The area of each atom in Å^2; 0 if it is buried; the sum is area(). The first call computes the areas.
  std::span<const double> atom_areas() const { return numbers<double>(MENISCUS_ATOM_AREAS); }
  // The solvent-accessible area of each atom in Å^2. Throws UsageError unless the kind is MENISCUS_SES.
  std::span<const double> atom_sas_areas() const { return numbers<double>(MENISCUS_ATOM_SAS_AREAS); }
  // The atoms; for MENISCUS_SAS, the radii include the probe's.
  std::span<const Ball> atoms() const { return numbers<Ball>(MENISCUS_ATOMS); }

  // The analytic patches and the boundary representation, whose rows meniscus.h describes.
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

  // Returns the Euclidean distances of points from the surface in Å: above 0 in the solvent, below 0 in the solid.
  // Throws InputError for points that are not finite.
  std::vector<double> distance(std::span<const Vector> points) const {
    std::vector<double> distances(points.size());
    check(meniscus_surface_distance(surface_.get(), points.size(), coordinates(points), distances.data(), nullptr));
    return distances;
  }

  // Distances of points from the surface, and the nearest points of the surface.
  struct Nearest {
    std::vector<double> distances;
    std::vector<Vector> feet;
  };
  // Returns the distances like distance(), and a nearest point of the surface for each point.
  Nearest nearest(std::span<const Vector> points) const {
    Nearest found{std::vector<double>(points.size()), std::vector<Vector>(points.size())};
    check(meniscus_surface_distance(surface_.get(), points.size(), coordinates(points), found.distances.data(),
                                    found.feet.empty() ? nullptr : found.feet.front().data()));
    return found;
  }

  // Returns the exact derivative of a quantity with respect to the position of each atom, in Å^2/Å or Å^3/Å. weights:
  // none, or a factor of the accessible area of each atom. Throws UsageError for a quantity or weights that the kind of
  // surface does not allow, and InputError if a probe touches more than three atoms, so that there is no derivative.
  std::vector<Vector> gradient(meniscus_quantity quantity, std::span<const double> weights = {}) const {
    if (!weights.empty() && weights.size() != atoms().size())
      throw UsageError("there are " + std::to_string(weights.size()) + " weights for " +
                       std::to_string(atoms().size()) + " atoms");
    std::vector<Vector> gradient(atoms().size());
    check(meniscus_surface_gradient(surface_.get(), quantity, weights.empty() ? nullptr : weights.data(),
                                    gradient.front().data()));
    return gradient;
  }

  // Finds the pockets. Throws UsageError unless the kind is MENISCUS_SES, and InputError for impossible options.
  Pockets pockets(const PocketOptions& options = {}) const {
    return Pockets(detail::result<meniscus_pockets*>(meniscus_surface_pockets, surface_.get(), &options));
  }

  // Makes a mesh. Throws InputError for impossible options.
  Mesh mesh(const MeshOptions& options = {}) const {
    return Mesh(detail::result<meniscus_mesh*>(meniscus_surface_mesh, surface_.get(), &options));
  }

  // Returns the camera that shows all atoms. aspect: width / height of the picture.
  Camera camera(double aspect, meniscus_projection projection = MENISCUS_PERSPECTIVE) const {
    return detail::result<Camera>(meniscus_surface_camera, surface_.get(), aspect, projection);
  }

  // Returns the C object for functions of meniscus.h. This object keeps its reference.
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

// Computes surfaces. It keeps what several surfaces share: its options, and a GL context with kernels and buffers.
class Computer {
 public:
  // Throws InputError for an impossible probe, UsageError for other invalid options, and GpuError if the device needs
  // GL 4.5 and there is none.
  explicit Computer(const Options& options = {})
      : computer_(detail::result<meniscus_computer*>(meniscus_computer_new, &options)) {}

  // Computes a surface. Throws InputError for an impossible atom, with its index and value in the message, and
  // NotClosedError if the surface would not be closed, with atoms in the message.
  Surface compute(const Atoms& atoms) const {
    return Surface(detail::result<meniscus_surface*>(meniscus_compute, computer_.get(), &atoms.get()));
  }
  // Computes the surface of the next frame in place of another one. Throws the errors of compute(); the surface is then
  // unchanged.
  void recompute(const Atoms& atoms, Surface& surface) const {
    meniscus_surface* in_place = surface.surface_.release();
    const meniscus_status status = meniscus_recompute(computer_.get(), &atoms.get(), &in_place);
    surface.surface_.reset(in_place);
    check(status);
  }

  // Returns the C object for functions of meniscus.h. This object keeps its reference.
  meniscus_computer* get() const noexcept { return computer_.get(); }

 private:
  detail::Handle<meniscus_computer, meniscus_computer_release> computer_;
};

// ---- Pictures ----

// A picture: rows from the top of red, green, blue and alpha, which is not premultiplied.
struct Picture {
  std::int32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  // width * height * 4
};

// All settings of a picture. The names, keys and values of properties are those of meniscus_scene_set(). Example:
// Scene().set("file", "1ubq.cif").set("color", "chain").render().
class Scene {
 public:
  // Creates a scene with the defaults of the program.
  Scene() : scene_(detail::result<meniscus_scene*>(meniscus_scene_new)) {}
  // Takes over the reference.
  explicit Scene(meniscus_scene* owned) : scene_(owned) {}

  // Reads a scene file of the program. Paths in the file must not lead out of its folder. Throws InputError for an
  // invalid file, with the path and the line or the key in the message.
  static Scene read(const std::string& path) {
    return Scene(detail::result<meniscus_scene*>(meniscus_scene_read, path.c_str()));
  }
  // Reads the text of a scene file. Paths are relative to the working directory. Throws InputError for an invalid text.
  static Scene parse(const std::string& json) {
    return Scene(detail::result<meniscus_scene*>(meniscus_scene_parse, json.c_str()));
  }

  // Sets the value of a property, or adds a value to a repeatable property. Throws UsageError for an unknown name or an
  // invalid value.
  Scene& set(const std::string& name, const std::string& value) {
    check(meniscus_scene_set(scene_.get(), name.c_str(), value.c_str()));
    return *this;
  }
  // Restores the default of a property, and removes all added values. Throws UsageError for an unknown name.
  Scene& reset(const std::string& name) {
    check(meniscus_scene_set(scene_.get(), name.c_str(), nullptr));
    return *this;
  }
  // Returns value n of a property; nothing if the property has its default, or at most n values.
  std::optional<std::string> get(const std::string& name, std::size_t n = 0) const {
    const char* const value = detail::result<const char*>(meniscus_scene_get, scene_.get(), name.c_str(), n);
    return value ? std::optional<std::string>(value) : std::nullopt;
  }
  // Returns the text of a scene file, without the properties that have their defaults. folder: paths in the text are
  // relative to this folder; empty: to the working directory.
  std::string json(const std::string& folder = {}) const {
    return detail::result<const char*>(meniscus_scene_json, scene_.get(), folder.empty() ? nullptr : folder.c_str());
  }
  // Returns all properties.
  static Rows<meniscus_property> properties() {
    return Rows<meniscus_property>(detail::result<meniscus_array>(meniscus_scene_properties));
  }

  // Returns a transparent picture of the size of the scene. Throws UsageError for values that contradict each other.
  Picture blank() const {
    Picture picture;
    check(meniscus_scene_size(scene_.get(), &picture.width, &picture.height));
    picture.rgba.resize(std::size_t{4} * static_cast<std::size_t>(picture.width) *
                        static_cast<std::size_t>(picture.height));
    return picture;
  }
  // Draws the picture of `meniscus render` with a new renderer. For several pictures, use one Renderer, which is
  // faster.
  Picture render(meniscus_device device = MENISCUS_AUTO) const;

  // Returns the C object for functions of meniscus.h. This object keeps its reference.
  meniscus_scene* get() const noexcept { return scene_.get(); }

 private:
  detail::Handle<meniscus_scene, meniscus_scene_release> scene_;
};

namespace detail {

// Returns the colours of atoms for C functions; NULL if there are none. Throws UsageError unless there are three
// channels per atom.
inline const float* channels(const Surface& surface, std::span<const float> atom_colors) {
  if (!atom_colors.empty() && atom_colors.size() != 3 * surface.atoms().size())
    throw UsageError("there are " + std::to_string(atom_colors.size()) + " channels for " +
                     std::to_string(surface.atoms().size()) + " atoms; give three an atom");
  return atom_colors.empty() ? nullptr : atom_colors.data();
}

}  // namespace detail

// Draws pictures. A renderer on GL has its own context and thread, and does not change contexts of the caller.
class Renderer {
 public:
  // Throws GpuError if the device needs GL 4.5 and there is none.
  explicit Renderer(meniscus_device device = MENISCUS_AUTO)
      : renderer_(detail::result<meniscus_renderer*>(meniscus_renderer_new, device)) {}

  // Draws the picture of `meniscus render`. It reads the molecule and computes the surface. Throws the errors of
  // read(), Computer::compute() and Scene::set().
  Picture render(const Scene& scene) const {
    Picture picture = scene.blank();
    check(meniscus_render_scene(renderer_.get(), scene.get(), picture.rgba.data(), picture.rgba.size()));
    return picture;
  }
  // Draws a computed surface with the look and the size of a scene. camera: nullptr for Surface::camera(). atom_colors:
  // none, or three numbers per atom, sRGB in [0, 1]. Throws UsageError if the scene sets other properties, and
  // InputError for an impossible camera or colour.
  Picture render(const Surface& surface, const Scene& scene = {}, const Camera* camera = nullptr,
                 std::span<const float> atom_colors = {}) const {
    Picture picture = scene.blank();
    check(meniscus_render(renderer_.get(), surface.get(), scene.get(), camera, detail::channels(surface, atom_colors),
                          picture.rgba.data(), picture.rgba.size()));
    return picture;
  }

  // Returns the C object for functions of meniscus.h. This object keeps its reference.
  meniscus_renderer* get() const noexcept { return renderer_.get(); }

 private:
  detail::Handle<meniscus_renderer, meniscus_renderer_release> renderer_;
};

inline Picture Scene::render(meniscus_device device) const { return Renderer(device).render(*this); }

// ---- Pages ----

// A web page of one file, in which readers can rotate the exact surface. It loads nothing else, and never changes.
class Page {
 public:
  // Makes the page of a scene, like `meniscus export page`. Throws the errors of Renderer::render(), and UsageError for
  // properties that pages do not show.
  explicit Page(const Scene& scene) : page_(detail::result<meniscus_page*>(meniscus_scene_page, scene.get())) {}
  // Makes the page of a computed surface with the look of a scene. structure: nullptr, or the structure of the atoms,
  // in the same order, whose names and colour schemes the page then has. The other parameters are those of
  // Renderer::render().
  explicit Page(const Surface& surface, const Structure* structure = nullptr, const Scene& scene = {},
                const Camera* camera = nullptr, std::span<const float> atom_colors = {})
      : page_(detail::result<meniscus_page*>(meniscus_surface_page, surface.get(),
                                             structure ? structure->get() : nullptr, scene.get(), camera,
                                             detail::channels(surface, atom_colors))) {}

  // Returns the text of the page, which belongs to this object.
  std::string_view html() const {
    const char* html = nullptr;
    std::size_t size = 0;
    check(meniscus_page_html(page_.get(), &html, &size));
    return {html, size};
  }

  // Returns the C object for functions of meniscus.h. This object keeps its reference.
  meniscus_page* get() const noexcept { return page_.get(); }

 private:
  detail::Handle<meniscus_page, meniscus_page_release> page_;
};

}  // namespace v0
}  // namespace meniscus

#endif
