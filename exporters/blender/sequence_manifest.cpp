// SPDX-License-Identifier: BSD-3-Clause
// Writes the manifest of a run, the file of its atoms in every frame, and a storyboard as JSON.
#include "exporters/blender/sequence_manifest.h"

#include <cassert>

#include <libdeflate.h>
#include <nlohmann/json.hpp>

#include "core/base/output_file.h"
#include "core/base/version.h"
#include "core/color/color_key.h"
#include "core/color/color_key_json.h"
#include "exporters/blender/mns_file.h"

namespace meniscus::blender {
namespace {

using nlohmann::ordered_json;

/// Returns the part of the manifest that all frames share. Frames of runs in which it differs must not be mixed.
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
  return fmt::format("{:08x}", ::libdeflate_crc32(0, text.data(), text.size()));
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
  ordered_json frames = std::move(content["frames"]);  // moves the long list to the end
  content.erase("frames");
  content["frames"] = std::move(frames);
  const SharedFile file{"surface_sequence.json", text_of(content)};
  write_shared_files(folder, existing, {&file, 1});
  return folder / file.name;
}

namespace {

using nlohmann::json;

// Adds the positions and times of all frames. Only one frame is in memory at a time: positions are written while they
// are read, and times after them.
void add_frames(MnsWriter& file, std::size_t atom_count, const AtomFrames& frames, std::vector<double>& times) {
  file.add_streamed<float>("frame.position", frames.numbers.size() * atom_count, 3,
                           [&frames, &times, atom_count](ArraySink& out) {
                             for (std::size_t place = 0; place < frames.numbers.size(); ++place) {
                               const AtomFrame frame = frames.next();
                               assert(frame.positions.size() == atom_count);
                               for (const glm::dvec3& p : std::span(frame.positions).first(atom_count))
                                 for (int axis = 0; axis < 3; ++axis) out.push(static_cast<float>(p[axis]));
                               times.push_back(frame.time.value_or(std::numeric_limits<double>::quiet_NaN()));
                             }
                           });
  file.add_streamed<double>("frame.time", frames.numbers.size(), 1, [&times](ArraySink& out) {
    for (const double time : times) out.push(time);
  });
}

}  // namespace

void write_atoms(const std::string& path, Existing existing, const SurfaceObject& object, const AtomAttributes& atoms,
                 const Provenance& provenance, const AtomFrames& frames) {
  assert(object.copies.size() == 1);
  MnsWriter file(ArrayForm::plain);
  add_atoms(file, object, atoms);
  std::vector<double> times;
  if (!frames.numbers.empty()) add_frames(file, object.surface.atoms.size(), frames, times);
  json header{{"format", "meniscus atoms"},
              {"generator", "meniscus " MENISCUS_VERSION},
              {"source", {{"file", provenance.source}, {"radii_set", provenance.radii_set}}},
              {"unit", "angstrom"},
              {"probe_radius", object.surface.probe_radius},
              {"frames", frames.numbers}};
  add_names(header, atoms);
  if (provenance.colors) header["colors"] = color_key_json(*provenance.colors);
  if (const auto& kinds = object.coloring.kind) {
    json colors = json::array();
    for (const glm::vec3& c : *kinds) colors.push_back({c.x, c.y, c.z});
    header["kind_colors"] = colors;
  }
  file.write(path, existing, std::move(header));
}

std::string scene_file(std::size_t place) { return fmt::format("scene_{}.mns", place + 1); }

std::string story_json(const Story& story) {
  using nlohmann::ordered_json;
  ordered_json content{{"format", "meniscus storyboard"},
                       {"version", 1},
                       {"generator", "meniscus " MENISCUS_VERSION},
                       {"unit", "angstrom"},
                       {"origin", {story.origin.x, story.origin.y, story.origin.z}},
                       {"scale", story.scale},
                       {"fps", story.fps},
                       {"ease", story.is_smooth ? "smooth" : "even"},
                       {"scenes", ordered_json::array()}};
  for (const StoryScene& scene : story.scenes) {
    ordered_json entry{{"name", scene.name},
                       {"file", scene.file},
                       {"first", scene.first},
                       {"last", scene.last},
                       {"camera", shot_object(scene.shot)}};
    if (!scene.title.empty()) entry["title"] = scene.title;
    if (const auto& color = scene.background) entry["background"] = {color->x, color->y, color->z};
    content["scenes"].push_back(std::move(entry));
  }
  return content.dump(1, ' ', true, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace meniscus::blender
