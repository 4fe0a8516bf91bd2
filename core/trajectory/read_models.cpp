// SPDX-License-Identifier: BSD-3-Clause
// The models of a structure file (PDB, mmCIF, GRO, XYZ, ...) as the frames of a trajectory.
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/molecule/formats.h"
#include "core/trajectory/formats.h"

namespace meniscus {
namespace {

class Models : public Trajectory {
 public:
  explicit Models(const std::string& path) : Trajectory(path, "models") {
    const TextFile file = read_text_file(path);
    const FileContents contents = choose_reader(file).read(file, ModelChoice{1, true});
    for (const Atom& atom : contents.atoms) {
      frames_.resize(static_cast<std::size_t>(atom.model));
      frames_.back().push_back(atom.position);
    }
    if (frames_.empty()) throw InputError(path, 0, "holds no atoms");
    atom_count_ = frames_.front().size();
    frame_count_ = frames_.size();
  }

 private:
  void read_unchecked(std::uint64_t number, Frame& frame) override {
    frame.positions = frames_[static_cast<std::size_t>(number)];
  }

  std::vector<std::vector<glm::dvec3>> frames_;
};

}  // namespace

const TrajectoryFormat kModelsFormat{{"models", "", "each model of a structure file is a frame", "", "positions"},
                                     [](std::string_view) { return true; },
                                     [](const std::string& path, const TrajectoryOptions&) {
                                       return std::unique_ptr<Trajectory>(std::make_unique<Models>(path));
                                     }};

}  // namespace meniscus
