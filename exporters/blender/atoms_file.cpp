// SPDX-License-Identifier: BSD-3-Clause
// Writes atoms, and their positions as they come.
#include "exporters/blender/atoms_file.h"

#include <cassert>
#include <limits>

#include <nlohmann/json.hpp>

#include "core/color/color_key_json.h"
#include "exporters/blender/atom_arrays.h"
#include "exporters/blender/mns_file.h"

namespace meniscus::blender {
namespace {

using nlohmann::json;

// A frame is in memory at a time: positions are written while they are read, times behind them.
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
  MnsWriter file;
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

}  // namespace meniscus::blender
