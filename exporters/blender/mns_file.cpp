// SPDX-License-Identifier: BSD-3-Clause
// Writes the header and the arrays of a .mns file, describes cameras, and collects balls, colours and attributes.
#include "exporters/blender/mns_file.h"

#include <bit>
#include <cassert>
#include <cstring>

#include <libdeflate.h>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

#include "core/camera/camera_json.h"
#include "core/image/png_file.h"
#include "core/structure/element_tables.h"

namespace meniscus::blender {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

constexpr std::size_t kAlignment = 64;
constexpr std::size_t kPrologue = 64;
/// The first bytes of a file. As in PNG, they are a byte that does not occur in text, and line ends that a transfer in
/// text mode would change.
constexpr char kMagic[8] = {'\x89', 'M', 'N', 'S', '\r', '\n', '\x1a', '\n'};

std::size_t aligned(std::size_t offset) { return (offset + kAlignment - 1) / kAlignment * kAlignment; }

template <class T>
void put(std::vector<std::byte>& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

}  // namespace

void MnsWriter::write(const std::string& path, Existing existing, nlohmann::json header,
                      const std::function<void(std::uint64_t)>& on_size) {
  OutputFile file(path, existing);
  write(file, std::move(header), on_size);
  file.commit();
}

void MnsWriter::pack() {
  constexpr int kLevel = 1;  // takes a third of the time of 6, with files a twentieth larger
  tbb::parallel_for(std::size_t{0}, arrays_.size(), [&](std::size_t n) {
    Array& array = arrays_[n];
    if (array.make) {
      ArraySink sink(
          [&](std::span<const std::byte> bytes) { array.bytes.insert(array.bytes.end(), bytes.begin(), bytes.end()); });
      array.make(sink);
      sink.flush();
      array.make = {};
    }
    assert(array.bytes.size() == array.byte_count);
    const std::vector<std::uint8_t> stream = zlib_stream(array.bytes, kLevel);
    const auto packed = std::as_bytes(std::span(stream));
    array.bytes = std::vector(packed.begin(), packed.end());
    array.byte_count = array.bytes.size();
  });
}

void MnsWriter::write(OutputFile& file, nlohmann::json header, const std::function<void(std::uint64_t)>& on_size) {
  if (form_ == ArrayForm::packed) pack();
  // Offsets count from the end of the header, so that they do not depend on its length.
  std::size_t offset = 0;
  nlohmann::json table = nlohmann::json::array();
  for (const Array& array : arrays_) {
    table.push_back({{"name", array.name},
                     {"type", array.type},
                     {"rows", array.rows},
                     {"columns", array.columns},
                     {"offset", offset}});
    if (form_ == ArrayForm::packed) table.back()["bytes"] = array.byte_count;
    offset = aligned(offset + array.byte_count);
  }
  header["arrays"] = std::move(table);
  std::string text = header.dump(1, ' ', true, nlohmann::json::error_handler_t::replace);
  text.resize(aligned(text.size() + 1), ' ');
  text.back() = '\n';
  const std::uint64_t size = kPrologue + text.size() + offset;
  if (on_size) on_size(size);

  // The prologue contains the checksum of everything after it, so it is written as zeros first.
  std::vector<std::byte> prologue(kPrologue);
  file.write(std::span<const std::byte>(prologue));
  std::uint32_t crc = 0;
  const auto write = [&](std::span<const std::byte> bytes) {
    if (bytes.empty()) return;  // a null pointer would make the checksum start again
    crc = ::libdeflate_crc32(crc, bytes.data(), bytes.size());
    file.write(bytes);
  };
  write(std::as_bytes(std::span(text)));
  const std::vector<std::byte> padding(kAlignment);
  for (const Array& array : arrays_) {
    std::size_t count = array.bytes.size();
    if (array.make) {
      ArraySink sink([&](std::span<const std::byte> bytes) {
        count += bytes.size();
        write(bytes);
      });
      array.make(sink);
      sink.flush();
    } else {
      write(array.bytes);
    }
    assert(count == array.byte_count);
    write(std::span(padding).first(aligned(count) - count));
  }
  std::memcpy(prologue.data(), kMagic, sizeof kMagic);
  put(prologue, 8, std::uint32_t{form_ == ArrayForm::packed ? 4u : 2u});
  put(prologue, 12, crc);
  put(prologue, 16, static_cast<std::uint64_t>(text.size()));
  put(prologue, 24, size);
  file.rewrite_beginning(prologue);
}

nlohmann::json shot_object(const Shot& shot) {
  nlohmann::json camera = camera_object(shot.camera);
  camera["size"] = {shot.width, shot.height};
  if (shot.shadows > 0.0f) {
    camera["shadows"] = shot.shadows;
    camera["shadow_softness"] = shot.shadow_softness;
  }
  return camera;
}

namespace {

template <class T>
void add_known(MnsWriter& file, const std::string& name, const std::vector<T>& values) {
  if (!values.empty()) file.add(name, std::span(values));
}

}  // namespace

void add_atoms(MnsWriter& file, const SurfaceObject& object, const AtomAttributes& atoms) {
  std::vector<double> center, radius;
  std::vector<float> color;
  for (const Ball& ball : object.surface.atoms) {
    center.insert(center.end(), {ball.center.x, ball.center.y, ball.center.z});
    radius.push_back(ball.radius);
  }
  for (const glm::vec3& c : object.coloring.atom) color.insert(color.end(), {c.x, c.y, c.z});
  file.add("atom.center", std::span<const double>(center), 3);
  file.add("atom.radius", std::span<const double>(radius));
  file.add("atom.color", std::span<const float>(color), 3);
  file.add("atom.index", std::span(object.atom));
  add_known(file, "atom.file_index", atoms.file_index);
  if (object.coloring.is_translucent()) file.add("atom.opacity", std::span(object.coloring.opacity));
  add_known(file, "atom.b_factor", atoms.b_factor);
  add_known(file, "atom.charge", atoms.charge);
  add_known(file, "atom.hydrophobicity", atoms.hydrophobicity);
  add_known(file, "atom.atomic_number", atoms.atomic_number);
  add_known(file, "atom.res_id", atoms.residue_number);
  add_known(file, "atom.chain_id", atoms.chain);
  add_known(file, "atom.name_id", atoms.name);
  add_known(file, "atom.residue_name_id", atoms.residue_name);
  add_known(file, "atom.entity", atoms.entity);
  add_known(file, "atom.area", atoms.area);
  add_known(file, "atom.accessible_area", atoms.accessible_area);
  add_known(file, "atom.buried_area", atoms.buried_area);
}

void add_names(nlohmann::json& header, const AtomAttributes& atoms) {
  header["chain_names"] = atoms.chain_names;
  if (!atoms.name.empty()) header["atom_names"] = atoms.atom_names;
  if (!atoms.residue_name.empty()) header["residue_names"] = atoms.residue_names;
}

namespace {

/// Appends a number, or 0 if it is missing, which Blender cannot express. Sets `any` if it is not missing.
void push_known(std::vector<float>& numbers, double number, bool& any) {
  any = any || std::isfinite(number);
  numbers.push_back(std::isfinite(number) ? static_cast<float>(number) : 0.0f);
}

/// Numbers names in the order in which they come, so that each is stored once.
class Names {
 public:
  explicit Names(std::vector<std::string>& names) : names_(names) {}

  std::int32_t number(const std::string& name) {
    const auto [at, fresh] = numbers_.try_emplace(name, static_cast<std::int32_t>(names_.size()));
    if (fresh) names_.push_back(name);
    return at->second;
  }
  /// Returns true unless the only name is empty, as in formats without names.
  bool are_known() const { return names_.size() > 1 || (names_.size() == 1 && !names_.front().empty()); }

 private:
  std::vector<std::string>& names_;
  std::map<std::string, std::int32_t> numbers_;
};

}  // namespace

AtomAttributes atom_attributes(const Structure& structure, const std::vector<std::uint32_t>& atoms) {
  AtomAttributes attributes;
  Names chains(attributes.chain_names), names(attributes.atom_names), residues(attributes.residue_names);
  bool charges = false, hydropathies = false, entities = false;
  for (const std::uint32_t index : atoms) {
    const Atom& atom = structure.atoms[index];
    attributes.file_index.push_back(atom.index);
    attributes.b_factor.push_back(std::isfinite(atom.b_factor) ? atom.b_factor : 0.0f);
    push_known(attributes.charge, atom.charge, charges);
    push_known(attributes.hydrophobicity, hydropathy(atom.residue_name), hydropathies);
    attributes.atomic_number.push_back(atom.element);
    attributes.residue_number.push_back(atom.residue_number);
    entities = entities || atom.kind != AtomClass::unclassified;
    attributes.entity.push_back(static_cast<std::int32_t>(atom.kind));
    attributes.chain.push_back(chains.number(atom.chain));
    attributes.name.push_back(names.number(atom.name));
    attributes.residue_name.push_back(residues.number(atom.residue_name));
  }
  if (!charges) attributes.charge.clear();
  if (!hydropathies) attributes.hydrophobicity.clear();
  if (!entities) attributes.entity.clear();
  if (!names.are_known()) attributes.name.clear();
  if (!residues.are_known()) attributes.residue_name.clear();
  return attributes;
}

}  // namespace meniscus::blender
