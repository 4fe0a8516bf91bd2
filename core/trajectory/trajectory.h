// SPDX-License-Identifier: BSD-3-Clause
// A trajectory file, or several in a row, open for reading its frames in any order; and the boxes of frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/structure/structure.h"

namespace meniscus {

/// The box of edges a, b, c (Å) and cosines of alpha, beta, gamma, with a along x and b in the plane of x and y (the
/// usual convention of crystallography). None if it is not a box: edges not positive, angles that do not fit together.
std::optional<glm::dmat3> cell_of_cosines(const glm::dvec3& edges, const glm::dvec3& cosines);

/// The same from angles in degrees; right angles give exactly rectangular boxes.
std::optional<glm::dmat3> cell_of_angles(const glm::dvec3& edges, const glm::dvec3& degrees);

/// The vectors themselves, in the columns. None if they span no volume or are not finite; a left-handed box stays one.
std::optional<glm::dmat3> cell_of_vectors(const glm::dmat3& vectors);

struct Frame {
  std::vector<glm::dvec3> positions;  ///< Å, one per atom of the file, in its order
  std::optional<glm::dmat3> cell;     ///< columns: the vectors a, b, c of the periodic box in Å; none: no box
  std::optional<double> time;         ///< ps
  std::optional<std::int64_t> step;   ///< of the simulation
};

/// What every format provides. Frames count from 0 in the order of the file. Memory does not grow with their number,
/// but for the frame index. One thread at a time.
class Trajectory {
 public:
  virtual ~Trajectory() = default;
  Trajectory(const Trajectory&) = delete;
  Trajectory& operator=(const Trajectory&) = delete;

  const std::string& path() const { return path_; }      ///< as given
  const std::string& format() const { return format_; }  ///< "DCD", "XTC", ...
  std::size_t atom_count() const { return atom_count_; }
  /// Whole frames, at least one.
  std::uint64_t frame_count() const { return frame_count_; }
  /// Non-fatal warnings, such as a frame count in the header that is not that of the file.
  const std::vector<Warning>& warnings() const { return warnings_; }
  /// Empty, or what is wrong after the last whole frame: "the file ends within frame 42; its 42 whole frames are
  /// used".
  const std::string& cut_short() const { return cut_short_; }

  /// Reads one frame, bit by bit the same whatever was read before. Throws InputError naming file and frame: a
  /// coordinate that is not finite or beyond kLargestCoordinate, another number of atoms, damaged data, no such frame,
  /// a file that changed meanwhile.
  void read(std::uint64_t number, Frame& frame);

 protected:
  Trajectory(std::string path, std::string format) : path_(std::move(path)), format_(std::move(format)) {}
  /// As read(); `number` is one of frame_count(), and what is read is checked by the caller.
  virtual void read_unchecked(std::uint64_t number, Frame& frame) = 0;
  /// The number with the fewest decimal digits that is as near to this one as the precision, relative, allows: 30 for
  /// 29.9999974 in single precision.
  static double with_fewest_digits(double number, double precision);

  std::string path_, format_;
  std::size_t atom_count_ = 0;
  std::uint64_t frame_count_ = 0;
  std::vector<Warning> warnings_;
  std::string cut_short_;
  double time_precision_ = kDoublePrecision;  ///< of Frame::time as the file has it; read() rounds accordingly

  /// Relative: what products of a few such numbers are wrong by at most, and one unit in the last place of a float.
  static constexpr double kDoublePrecision = 1e-14, kSinglePrecision = 1.2e-7;
};

/// "the file ends within frame 42; its 42 whole frames are used".
std::string cut_short_sentence(std::uint64_t whole_frames);

/// How a trajectory is opened.
struct TrajectoryOptions {
  /// Folder for the frame indices of formats whose frames are found only by walking through the file (XTC, TRR); made
  /// when missing. Empty: none is kept. An index is used only while size and time of its file are as they were.
  std::string index_folder{};
  /// How many atoms the structure has, for a format that does not say it of its frames (mdcrd); may throw. Null: there
  /// is no structure.
  std::function<std::size_t()> atoms{};
  bool trust_atom_order = false;  ///< atoms that bear no numbers (LAMMPS dumps) are in the order of the structure
};

/// Opens a file of any format in core/trajectory/formats/trajectory_formats.h, recognized by content. Throws
/// InputError: missing, no trajectory, not one whole frame, broken header.
std::unique_ptr<Trajectory> open_trajectory(const std::string& path, const TrajectoryOptions& options = {});

class JoinedFrames : public Trajectory {
 public:
  /// The frames of the first, then those of the second, and so on; all of them, also where one begins before the end of
  /// the last (then there is a warning). `parts`: at least one. Throws InputError where their atoms differ in number.
  explicit JoinedFrames(std::vector<std::unique_ptr<Trajectory>> parts);

 private:
  void read_unchecked(std::uint64_t number, Frame& frame) override;
  void warn_of_overlap(std::size_t part);

  std::vector<std::unique_ptr<Trajectory>> parts_;
  std::vector<std::uint64_t> begin_;  ///< of each part its first frame in all
};

}  // namespace meniscus
