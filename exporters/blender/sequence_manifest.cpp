// SPDX-License-Identifier: BSD-3-Clause
// Writes the manifest, the same bytes from every share of a run.
#include "exporters/blender/sequence_manifest.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "core/color/color_key_json.h"
#include "core/base/shared_files.h"
#include "exporters/blender/shot.h"

namespace meniscus::blender {
namespace {

using nlohmann::ordered_json;

/// What makes frames of two runs different things.
ordered_json shared_by_files(const SequenceManifest& manifest) {
  ordered_json source{{"file", manifest.provenance.source}, {"radii_set", manifest.provenance.radii_set}};
  if (!manifest.trajectory.empty()) source["trajectory"] = manifest.trajectory;
  ordered_json result{{"format", "meniscus surface sequence"},
                      {"version", 1},
                      {"generator", "meniscus " MENISCUS_VERSION},
                      {"source", source},
                      {"unit", "angstrom"},
                      {"atoms", manifest.atom_count},
                      {"probe_radius", manifest.probe_radius},
                      {"tolerance", manifest.tolerance},
                      {"origin", {manifest.origin.x, manifest.origin.y, manifest.origin.z}}};
  if (manifest.provenance.colors) result["colors"] = color_key_json(*manifest.provenance.colors);
  result["frames"] = ordered_json::array();
  for (const std::uint64_t frame : manifest.frames)
    result["frames"].push_back({{"frame", frame}, {"file", frame_file(frame)}});
  return result;
}

std::string text_of(const ordered_json& manifest) {
  return manifest.dump(1, ' ', true, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string frame_file(std::uint64_t frame) { return fmt::format("surface_{:05}.mns", frame); }

std::string run_name(const SequenceManifest& manifest) {
  const std::string text = text_of(shared_by_files(manifest));
  return fmt::format("{:08x}", crc32_z(0, reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

std::filesystem::path write_manifest(const std::filesystem::path& folder, Existing existing,
                                     const SequenceManifest& manifest) {
  ordered_json content = shared_by_files(manifest);
  content["run"] = run_name(manifest);
  content["scale"] = manifest.scale;
  content["fps"] = manifest.fps;
  if (manifest.shots.size() == 1) {
    content["camera"] = shot_object(manifest.shots[0]);
  } else {
    for (std::size_t n = 0; n < manifest.frames.size(); ++n)
      content["frames"][n]["camera"] = shot_object(manifest.shots[n]);
  }
  ordered_json frames = std::move(content["frames"]);  // the long list goes last
  content.erase("frames");
  content["frames"] = std::move(frames);
  const SharedFile file{"surface_sequence.json", text_of(content)};
  write_shared_files(folder, existing, {&file, 1});
  return folder / file.name;
}

}  // namespace meniscus::blender
