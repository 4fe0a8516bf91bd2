// SPDX-License-Identifier: BSD-3-Clause
// The container of .mns files, which has a header and named arrays, and the arrays that describe atoms.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/base/output_file.h"
#include "core/camera/camera.h"
#include "core/queries/surface_object.h"
#include "core/structure/structure.h"

namespace meniscus::blender {

/// The form of the arrays in a file.
enum class ArrayForm {
  plain,  ///< version 2 of the format: as they lie in memory
  packed  ///< version 4: compressed, each by itself
};

/// Receives the values of one array in order and passes them on in large pieces.
class ArraySink {
 public:
  explicit ArraySink(std::function<void(std::span<const std::byte>)> write) : write_(std::move(write)) {}

  template <class T>
  void push(T value) {
    const auto bytes = std::as_bytes(std::span(&value, 1));
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    if (buffer_.size() >= kPiece) flush();
  }
  void push_all(std::span<const std::byte> bytes) {
    flush();
    write_(bytes);
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
  explicit MnsWriter(ArrayForm form) : form_(form) {}

  /// Sets the prefix of the names of arrays that are added later.
  void set_prefix(const std::string& prefix) { prefix_ = prefix; }
  /// Adds an array with `columns` numbers per row. Names must differ. The values are copied.
  template <class T>
  void add(const std::string& name, std::span<const T> values, int columns = 1) {
    const auto bytes = std::as_bytes(values);
    arrays_.push_back({prefix_ + name,
                       type_of(T{}),
                       values.size() / columns,
                       columns,
                       bytes.size(),
                       {bytes.begin(), bytes.end()},
                       {}});
  }

  /// Adds an array of `rows` rows that is computed while the file is written: `make` pushes `columns` values of type T
  /// per row. Everything that it refers to must live until then.
  template <class T>
  void add_streamed(const std::string& name, std::size_t rows, int columns, std::function<void(ArraySink&)> make) {
    arrays_.push_back({prefix_ + name, type_of(T{}), rows, columns, sizeof(T) * rows * columns, {}, std::move(make)});
  }

  /// Writes the whole file under `path`, or throws OutputError and leaves none. `header` must be an object; the key
  /// "arrays" is added to it. on_size: a function that is called with the size in bytes before anything is written.
  void write(const std::string& path, Existing existing, nlohmann::json header,
             const std::function<void(std::uint64_t)>& on_size = {});
  /// Writes the whole content into a file, which the caller commits.
  void write(OutputFile& file, nlohmann::json header, const std::function<void(std::uint64_t)>& on_size = {});

 private:
  struct Array {
    std::string name;
    std::string type;  ///< type in the notation of numpy: "<f4", "<f8", "<u4", "<i4", "|u1"
    std::size_t rows = 0;
    int columns = 1;
    std::size_t byte_count = 0;
    std::vector<std::byte> bytes;          ///< the content; empty for a streamed array
    std::function<void(ArraySink&)> make;  ///< the function that computes a streamed array; otherwise empty
  };
  static const char* type_of(float) { return "<f4"; }
  static const char* type_of(double) { return "<f8"; }
  static const char* type_of(std::uint32_t) { return "<u4"; }
  static const char* type_of(std::int32_t) { return "<i4"; }
  static const char* type_of(std::uint8_t) { return "|u1"; }
  void pack();

  ArrayForm form_;
  std::string prefix_;
  std::vector<Array> arrays_;
};

/// A camera and the size and shadows of the picture for which it is meant.
struct Shot {
  Camera camera;
  int width = 0, height = 0;                     ///< pixels
  float shadows = 0.0f, shadow_softness = 0.0f;  ///< Look::shadows, Look::shadow_softness
};

/// Returns the JSON object of a camera file, with the size of the picture and its shadows, if it has any.
nlohmann::json shot_object(const Shot& shot);

/// Numbers per atom, in the order of Surface::atoms. An attribute with an empty vector is not written.
/// Names in the file are those of Molecular Nodes if it has the attribute: b_factor, atomic_number, res_id, chain_id.
struct AtomAttributes {
  std::vector<std::uint32_t> file_index;  ///< place in the file, from 0 (Atom::index)
  std::vector<float> b_factor;
  std::vector<float> charge;          ///< e; 0 if unknown
  std::vector<float> hydrophobicity;  ///< hydropathy of the residue (Kyte & Doolittle 1982); 0 if it has none
  std::vector<std::int32_t> atomic_number;
  std::vector<std::int32_t> residue_number;
  std::vector<std::int32_t> entity;                                 ///< AtomClass
  std::vector<std::int32_t> chain;                                  ///< index into chain_names
  std::vector<std::int32_t> name;                                   ///< index into atom_names
  std::vector<std::int32_t> residue_name;                           ///< index into residue_names
  std::vector<std::string> chain_names, atom_names, residue_names;  ///< text from a molecule file, each name once
  /// Areas in Å²: of the surface, accessible to the centre of a probe, and the part that other chains bury.
  std::vector<float> area, accessible_area, buried_area;
};

/// Adds atom.center, atom.radius, atom.color, atom.index, and all attributes that are not empty (FORMAT.md). The writer
/// refers to the object and to the attributes until the file is written.
void add_atoms(MnsWriter& file, const SurfaceObject& object, const AtomAttributes& atoms);

/// Adds the lists of names, which arrays of atoms refer to by index, to the header of an object.
void add_names(nlohmann::json& header, const AtomAttributes& atoms);

/// Returns the attributes of these atoms in this order. Areas are empty, and attributes that no atom has.
AtomAttributes atom_attributes(const Structure& structure, const std::vector<std::uint32_t>& atoms);

}  // namespace meniscus::blender
