// SPDX-License-Identifier: BSD-3-Clause
// Models of structure files as frames: those found in the file equal the models of the format's reader.
#include <optional>

#include "core/base/error.h"
#include "core/structure/formats/structure_formats.h"
#include "tests/fuzz/trajectory_checks.h"
#include "core/trajectory/trajectory.h"

namespace meniscus::fuzz {
namespace {

/// Returns all models by the reader of the format; nothing if it refuses the text.
std::optional<FileContents> all_models(const std::string& path) {
  try {
    const TextFile file = read_text_file(path);
    return choose_reader(file).read(file, {1, true});
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::vector<glm::dvec3> all_frames(Trajectory& trajectory) {
  std::vector<glm::dvec3> positions;
  Frame frame;
  for (std::uint64_t n = 0; n < trajectory.frame_count(); ++n) {
    trajectory.read(n, frame);
    positions.insert(positions.end(), frame.positions.begin(), frame.positions.end());
  }
  return positions;
}

/// Checks that both ways, where they understand the whole file, see the same atoms in as many models.
void check_against_reader(const std::string& path) {
  const std::optional<FileContents> contents = all_models(path);
  if (!contents || contents->without_positions) return;
  std::unique_ptr<Trajectory> trajectory;
  std::vector<glm::dvec3> positions;
  try {
    trajectory = kModelsFormat.open(path, {});
    if (!trajectory->cut_short().empty()) return;
    positions = all_frames(*trajectory);
  } catch (const Error&) {
    return;  // Models of different sizes are not frames.
  }
  require(positions.size() == contents->atoms.size(), "the frames hold the atoms of the models");
  std::vector<std::vector<glm::dvec3>> models(contents->models);
  for (const Atom& atom : contents->atoms) models.at(static_cast<std::size_t>(atom.model - 1)).push_back(atom.position);
  require(trajectory->frame_count() == models.size(), "each model is a frame");
  std::size_t place = 0;
  for (const auto& model : models) {
    for (const glm::dvec3& position : model) require(position == positions[place++], "frames are the models in order");
  }
}

void run_text_frames(std::string_view bytes) {
  static const ScratchFile file("input.models");
  check_trajectory(kModelsFormat, file, bytes);
  check_against_reader(file.write(bytes));
}

const Registration registered_text_frames{"text_frames", run_text_frames};

}  // namespace
}  // namespace meniscus::fuzz
