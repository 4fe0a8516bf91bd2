// SPDX-License-Identifier: BSD-3-Clause
// The container of .mns files: a header and named arrays; and the arrays that describe atoms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/base/output_file.h"
#include "core/camera/camera.h"
#include "core/queries/surface_object.h"
#include "core/structure/structure.h"

namespace meniscus::blender {

/// Of a file without caps, and with them: a reader of the first would take these for the surface.
inline constexpr std::uint32_t kMnsVersion = 2, kMnsVersionOfCaps = 3;

/// Takes the values of one array in order and passes them on in large pieces.
class ArraySink {
 public:
  explicit ArraySink(std::function<void(std::span<const std::byte>)> write) : write_(std::move(write)) {}

  template <class T>
  void push(T value) {
    const auto bytes = std::as_bytes(std::span(&value, 1));
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    if (buffer_.size() >= kPiece) flush();
  }
  void flush() {
    write_(buffer_);
    buffer_.clear();
  }

 private:
  static constexpr std::size_t kPiece = 1 << 18;

  std::function<void(std::span<const std::byte>)> write_;
  std::vector<std::byte> buffer_;
};

/// Collects named arrays, then writes them after their header.
class MnsWriter {
 public:
  /// That of the file; kMnsVersion by itself.
  void set_version(std::uint32_t version) { version_ = version; }
  /// Names of arrays that are added from now on begin with this.
  void set_prefix(const std::string& prefix) { prefix_ = prefix; }
  /// `columns` numbers a row. Names must differ; the values are copied.
  void add(const std::string& name, std::span<const float> values, int columns = 1);
  void add(const std::string& name, std::span<const double> values, int columns = 1);
  void add(const std::string& name, std::span<const std::uint32_t> values, int columns = 1);
  void add(const std::string& name, std::span<const std::int32_t> values, int columns = 1);
  void add(const std::string& name, std::span<const std::uint8_t> values, int columns = 1);

  /// An array of so many rows that is made while the file is written: `make` pushes `columns` values of type T a row.
  /// What it refers to must live until then.
  template <class T>
  void add_streamed(const std::string& name, std::size_t rows, int columns, std::function<void(ArraySink&)> make) {
    arrays_.push_back({prefix_ + name, type_of(T{}), rows, columns, sizeof(T) * rows * columns, {}, std::move(make)});
  }

  /// Writes the whole file under `path`, or throws OutputError and leaves none. `header` must be an object; the key
  /// "arrays" is added to it. tell: called with the size in bytes before anything is written.
  void write(const std::string& path, Existing existing, nlohmann::json header,
             const std::function<void(std::uint64_t)>& tell = {}) const;
  /// The same into a file that others commit.
  void write(OutputFile& file, nlohmann::json header, const std::function<void(std::uint64_t)>& tell = {}) const;

 private:
  struct Array {
    std::string name;
    std::string type;  ///< as numpy writes it: "<f4", "<f8", "<u4", "<i4", "|u1"
    std::size_t rows = 0;
    int columns = 1;
    std::size_t byte_count = 0;
    std::vector<std::byte> bytes;  ///< or, where they are streamed:
    std::function<void(ArraySink&)> make;
  };
  static const char* type_of(float) { return "<f4"; }
  static const char* type_of(double) { return "<f8"; }
  static const char* type_of(std::uint32_t) { return "<u4"; }
  static const char* type_of(std::uint8_t) { return "|u1"; }
  void add_bytes(const std::string& name, const char* type, std::span<const std::byte> bytes, std::size_t rows,
                 int columns);
  std::uint32_t version_ = kMnsVersion;
  std::string prefix_;
  std::vector<Array> arrays_;
};

/// A camera and the picture it is meant for.
struct Shot {
  Camera camera;
  int width = 0, height = 0;                     ///< pixels
  float shadows = 0.0f, shadow_softness = 0.0f;  ///< of a Look
};

/// The object of a camera file, the size of the picture, and what shadows it has, if any.
nlohmann::json shot_object(const Shot& shot);

/// Numbers per atom, in the order of Surface::atoms; an empty vector leaves the attribute out.
/// The names in the file are those of Molecular Nodes where it has them: b_factor, atomic_number, res_id, chain_id.
struct AtomAttributes {
  std::vector<std::uint32_t> file_index;  ///< place in the file, from 0 (Atom::index)
  std::vector<float> b_factor;
  std::vector<float> charge;          ///< e; 0: unknown
  std::vector<float> hydrophobicity;  ///< of the residue (Kyte & Doolittle 1982); 0: it has none
  std::vector<std::int32_t> atomic_number;
  std::vector<std::int32_t> residue_number;
  std::vector<std::int32_t> entity;                                 ///< AtomClass
  std::vector<std::int32_t> chain;                                  ///< into chain_names
  std::vector<std::int32_t> name;                                   ///< into atom_names
  std::vector<std::int32_t> residue_name;                           ///< into residue_names
  std::vector<std::string> chain_names, atom_names, residue_names;  ///< text of a molecule file, each once
  /// Å²: of the surface, of what a probe's centre can reach, of the latter what other chains bury.
  std::vector<float> area, accessible_area, buried_area;
};

/// atom.center, atom.radius, atom.color, atom.index, and what else is known of them (FORMAT.md). What is added refers
/// to the object and to the attributes until the file is written.
void add_atoms(MnsWriter& file, const SurfaceObject& object, const AtomAttributes& atoms);

/// The lists of names that arrays of atoms point into, as the header of the object has them.
void add_names(nlohmann::json& header, const AtomAttributes& atoms);

/// Of these atoms of the structure, in this order.
AtomAttributes atom_attributes(const Structure& structure, const std::vector<std::uint32_t>& atoms);

}  // namespace meniscus::blender
