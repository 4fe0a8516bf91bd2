// SPDX-License-Identifier: BSD-3-Clause
// Writes GLB files: a JSON chunk describes the arrays of the binary chunk. Each object has a mesh, a set of arrays, and
// a node for each of its places.
#include "core/base/error.h"
#include "exporters/mesh_files/writers.h"

#ifdef MENISCUS_WITH_JSON

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/base/version.h"
#include "core/image/color_space.h"

namespace meniscus {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126, kUnsignedInt = 5125, kUnsignedShort = 5123;  // componentType
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;          // target
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

/// Converts a channel from sRGB to linear light, as GLB stores it. 16 bits keep all 8-bit values distinct.
std::uint16_t linear(std::uint8_t channel) {
  return static_cast<std::uint16_t>(std::lround(65535.0f * linear_from_srgb(static_cast<float>(channel) / 255.0f)));
}

std::array<float, 3> as_array(const glm::vec3& x) { return {x.x, x.y, x.z}; }

/// Replaces all bytes outside of printable ASCII, because names may be in any encoding but JSON is UTF-8.
std::string plain_text(const std::string& text) {
  std::string plain = text;
  std::ranges::replace_if(
      plain, [](unsigned char c) { return c < ' ' || c > '~'; }, '_');
  return plain;
}

/// Returns the name of a vertex attribute: an underscore and capital letters.
std::string semantic(const std::string& name) { return "_" + upper_case(name); }

/// Builds both chunks of a GLB file.
class Builder {
 public:
  explicit Builder(const MeshFile& mesh) {
    json_["asset"] = {{"version", "2.0"},
                      {"generator", "Meniscus " MENISCUS_VERSION},
                      {"extras", {{"about", mesh.about}, {"meters_per_angstrom", mesh.scale}}}};
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"nodes", Json::array()}}});
    json_["nodes"] = json_["meshes"] = json_["accessors"] = json_["bufferViews"] = Json::array();
    const Json look = {{"metallicFactor", 0.0}, {"roughnessFactor", mesh.material.roughness}};
    const Json more = {{"KHR_materials_ior", {{"ior", mesh.material.ior}}}};
    json_["extensionsUsed"] = {"KHR_materials_ior"};
    const auto is_opaque = [](const FileObject& object) { return object.opacities.empty(); };
    json_["materials"] = Json::array();
    if (std::ranges::any_of(mesh.objects, is_opaque))
      json_["materials"].push_back({{"name", "surface"}, {"pbrMetallicRoughness", look}, {"extensions", more}});
    if (!std::ranges::all_of(mesh.objects, is_opaque))
      json_["materials"].push_back(
          {{"name", "translucent"}, {"pbrMetallicRoughness", look}, {"alphaMode", "BLEND"}, {"extensions", more}});
    for (const FileObject& object : mesh.objects) add(object);
    json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
  }

  void write(OutputFile& file) {
    BinaryRows text;
    text.put_text(json_.dump());
    text.pad(4, ' ');
    binary_.pad(4, '\0');
    const std::size_t length = 12 + 8 + text.size() + 8 + binary_.size();
    if (length > std::numeric_limits<std::uint32_t>::max())
      throw CapacityError("GLB has room for 4 GiB; ask for a coarser mesh, or for fewer --attributes");
    BinaryRows head;
    for (const std::uint32_t word :
         {kMagic, kVersion, static_cast<std::uint32_t>(length), static_cast<std::uint32_t>(text.size()), kJsonChunk})
      head.put(word);
    BinaryRows between;
    for (const std::uint32_t word : {static_cast<std::uint32_t>(binary_.size()), kBinaryChunk}) between.put(word);
    for (const BinaryRows* part : {&head, &text, &between, &binary_}) file.write(part->bytes());
  }

 private:
  void add(const FileObject& object) {
    Json attributes;
    attributes["POSITION"] = positions(object);
    attributes["NORMAL"] = accessor(std::span(object.normals), kFloat, "VEC3", kArrayBuffer);
    attributes["COLOR_0"] = colors(object);
    for (const VertexNumbers& column : object.numbers) {
      const std::vector<float> values = zero_for_missing(column.values);
      attributes[semantic(column.name)] = accessor(std::span(values), kFloat, "SCALAR", kArrayBuffer);
    }
    const std::size_t indices = accessor(std::span(object.triangles), kUnsignedInt, "SCALAR", kElementArrayBuffer, 3);
    const std::size_t number = json_["meshes"].size();
    const std::string name = plain_text(object.name);
    json_["meshes"].push_back(
        {{"name", name},
         {"primitives", Json::array({{{"attributes", attributes},
                                      {"indices", indices},
                                      {"material", object.opacities.empty() ? 0 : json_["materials"].size() - 1},
                                      {"mode", 4}}})}});
    for (const RigidMotion& place : object.places) {
      json_["scenes"][0]["nodes"].push_back(json_["nodes"].size());
      Json node = {{"name", name}, {"mesh", number}};
      if (!object.is_placed_once()) {
        const glm::dquat turn = glm::normalize(glm::quat_cast(place.rotation));
        node["rotation"] = {turn.x, turn.y, turn.z, turn.w};
        node["translation"] = {place.translation.x, place.translation.y, place.translation.z};
      }
      json_["nodes"].push_back(std::move(node));
    }
  }

  /// Appends an array to the binary chunk and returns the number of its accessor.
  template <class Row>
  std::size_t accessor(std::span<const Row> rows, int component, const char* type, int target,
                       std::size_t elements_a_row = 1) {
    binary_.pad(4, '\0');
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", rows.size_bytes()}, {"target", target}});
    binary_.put_all(rows);
    json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                  {"componentType", component},
                                  {"count", rows.size() * elements_a_row},
                                  {"type", type}});
    return json_["accessors"].size() - 1;
  }
  template <class Row>
  std::size_t accessor(std::span<Row> rows, int component, const char* type, int target) {
    return accessor(std::span<const Row>(rows), component, type, target);
  }

  /// Adds the positions of the vertices with their extent, which glTF requires, and returns the number of the accessor.
  std::size_t positions(const FileObject& object) {
    const std::size_t made = accessor(std::span(object.positions), kFloat, "VEC3", kArrayBuffer);
    glm::vec3 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
    for (const glm::vec3& x : object.positions) {
      low = glm::min(low, x);
      high = glm::max(high, x);
    }
    json_["accessors"][made]["min"] = as_array(low);
    json_["accessors"][made]["max"] = as_array(high);
    return made;
  }

  /// Adds the colours of the vertices and returns the number of their accessor. Opaque colours have an alpha, too, so
  /// that each begins at a multiple of four bytes.
  std::size_t colors(const FileObject& object) {
    std::array<std::uint16_t, 256> of_channel{};
    for (std::size_t c = 0; c < of_channel.size(); ++c) of_channel[c] = linear(static_cast<std::uint8_t>(c));
    std::vector<std::array<std::uint16_t, 4>> rows;
    rows.reserve(object.colors.size());
    for (std::size_t v = 0; v < object.colors.size(); ++v) {
      const auto& [red, green, blue] = object.colors[v];
      const float opacity = object.opacities.empty() ? 1.0f : object.opacities[v];
      rows.push_back({of_channel[red], of_channel[green], of_channel[blue],
                      static_cast<std::uint16_t>(std::lround(65535.0f * opacity))});
    }
    const std::size_t made = accessor(std::span(rows), kUnsignedShort, "VEC4", kArrayBuffer);
    json_["accessors"][made]["normalized"] = true;
    return made;
  }

  Json json_;
  BinaryRows binary_;
};

}  // namespace

void write_glb(OutputFile& file, const MeshFile& mesh) { Builder(mesh).write(file); }

}  // namespace meniscus

#else

namespace meniscus {

void write_glb(OutputFile&, const MeshFile&) {
  throw RequestError("this build writes no GLB files: it was made without nlohmann_json; choose another format");
}

}  // namespace meniscus

#endif
