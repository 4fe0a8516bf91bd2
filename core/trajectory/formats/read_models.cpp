// SPDX-License-Identifier: BSD-3-Clause
// The models of a structure file (PDB, mmCIF, GRO, XYZ, ...) as the frames of a trajectory.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/formats/structure_formats.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "core/trajectory/formats/text_frames.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

/// Of a format, or packed in a way, whose models cannot be found without reading all: they stay in memory.
class ModelsInMemory final : public Trajectory {
 public:
  explicit ModelsInMemory(const std::string& path) : Trajectory(path, "models") {
    const TextFile file = read_text_file(path);
    const Reader& reader = choose_reader(file);
    format_ = fmt::format("models of {}", reader.metadata.name);
    const FileContents contents = reader.read(file, ModelChoice{1, true});
    if (contents.without_positions) throw InputError(path, 0, "lists atoms without coordinates: it is no trajectory");
    for (const Atom& atom : contents.atoms) {
      const auto model = static_cast<std::size_t>(atom.model);  // mmCIF may list models in turn
      if (frames_.size() < model) frames_.resize(model);
      frames_[model - 1].push_back(atom.position);
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

/// Keeps in memory where each model stands in the file, and parses the one that is asked for.
class ModelsInFile final : public Trajectory {
 public:
  ModelsInFile(const std::string& path, const Reader& reader)
      : Trajectory(path, fmt::format("models of {}", reader.metadata.name)), file_(path), reader_(reader) {
    TextFrames found = find_text_frames(file_, reader);
    frames_ = std::move(found.frames);
    cut_short_ = std::move(found.cut_short);
    if (frames_.empty()) throw InputError(path, 0, "holds no atoms");
    frame_count_ = frames_.size();
    Frame first;
    read_unchecked(0, first);
    atom_count_ = first.positions.size();
  }

 private:
  std::string text_of(std::uint64_t begin, std::uint64_t end) const {
    constexpr std::uint64_t kLargest = std::uint64_t{2} << 30;
    if (end - begin > kLargest)
      throw CapacityError(fmt::format("{}: one of its models has {} bytes, more than this program reads", path_,
                                      with_thousands(end - begin)));
    std::string text(end - begin, '\0');
    file_.read(begin, std::as_writable_bytes(std::span(text)));
    std::erase(text, '\r');
    return text;
  }

  void read_unchecked(std::uint64_t number, Frame& frame) override {
    const TextFrame& place = frames_[number];
    const TextFile model{fmt::format("{}, frame {}", path_, number), text_of(place.begin, place.end)};
    std::string box;
    constexpr std::uint64_t kBoxRecord = 80;
    if (place.box != kNoBox) box = text_of(place.box, std::min(file_.size(), place.box + kBoxRecord));
    file_.check_unchanged();
    if (model.text.find('\0') != std::string::npos) throw InputError(model.path, 0, "is binary, not text");
    if (!reader_.positions || !reader_.positions(model.text, frame.positions)) {
      const FileContents contents = reader_.read(model, ModelChoice{});
      frame.positions.clear();
      for (const Atom& atom : contents.atoms) frame.positions.push_back(atom.position);
    }
    frame.cell = cell_of_text(reader_, model.text, box.substr(0, box.find('\n')));
    if (&reader_ != &kGroReader) return;
    frame.time = time_of_title(model.text);
    frame.step = step_of_title(model.text);
  }

  BinaryFile file_;
  const Reader& reader_;
  std::vector<TextFrame> frames_;
};

std::unique_ptr<Trajectory> open_models(const std::string& path, const TrajectoryOptions&) {
  constexpr std::uint64_t kStart = std::uint64_t{1} << 20;  // long enough for the remarks of PDB
  std::string start;
  {
    const BinaryFile file(path);
    start.resize(std::min(file.size(), kStart));
    file.read(0, std::as_writable_bytes(std::span(start)));
  }
  const bool text =
      start.find('\0') == std::string::npos && start.find_first_not_of(" \t\r\n\v\f") != std::string::npos;
  if (text && !start.starts_with("\x1f\x8b")) {
    const Reader& reader = choose_reader(TextFile{path, start});
    if (can_find_text_frames(reader, start)) return std::make_unique<ModelsInFile>(path, reader);
  }
  return std::make_unique<ModelsInMemory>(path);
}

}  // namespace

const TrajectoryFormat kModelsFormat{
    {"models", ".pdb .cif .gro .xyz", "each model of a structure file of any format is a frame",
     "those of the formats of structures",
     "positions; boxes of CRYST1, GRO and extended XYZ, times of GRO titles; of plain "
     "PDB, GRO and XYZ files one model is "
     "in memory at a time, of others all"},
    [](std::string_view) { return true; },
    open_models};

}  // namespace meniscus
