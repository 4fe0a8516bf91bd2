// SPDX-License-Identifier: BSD-3-Clause
// Trajectories: one file, or several joined, from which frames are read in any order; and the periodic boxes of frames.
#pragma once

#include <functional>

#include "core/structure/structure.h"

namespace meniscus {

/// Returns the box with edges a, b, c (Å) and cosines of alpha, beta, gamma. Vector a lies along x and b in the xy
/// plane, as usual in crystallography. Returns nothing if an edge is not positive or the angles do not fit together.
std::optional<glm::dmat3> cell_of_cosines(const glm::dvec3& edges, const glm::dvec3& cosines);

/// Returns the box with edges a, b, c (Å) and angles in degrees. Right angles give exactly rectangular boxes.
std::optional<glm::dmat3> cell_of_angles(const glm::dvec3& edges, const glm::dvec3& degrees);

/// Returns the box with these vectors in the columns, unchanged. Returns nothing if they span no volume or are not
/// finite. Left-handed boxes are allowed.
std::optional<glm::dmat3> cell_of_vectors(const glm::dmat3& vectors);

/// One frame of a trajectory.
struct Frame {
  std::vector<glm::dvec3> positions;  ///< Å, one per atom of the file, in its order
  std::optional<glm::dmat3> cell;     ///< vectors a, b, c of the periodic box in the columns, Å; none without a box
  std::optional<double> time;         ///< ps
  std::optional<std::int64_t> step;   ///< step number of the simulation
};

/// The interface of all trajectory formats. Frames count from 0 in the order of the file. Memory does not grow with
/// their number, except for the frame index. A trajectory may be used by one thread at a time.
class Trajectory {
 public:
  virtual ~Trajectory() = default;
  Trajectory(const Trajectory&) = delete;
  Trajectory& operator=(const Trajectory&) = delete;

  const std::string& path() const { return path_; }      ///< path as the user wrote it
  const std::string& format() const { return format_; }  ///< "DCD", "XTC", ...
  std::size_t atom_count() const { return atom_count_; }
  /// Returns the number of complete frames, at least one.
  std::uint64_t frame_count() const { return frame_count_; }
  /// Returns warnings that prevent nothing, such as a frame count in the header that differs from that of the file.
  const std::vector<Warning>& warnings() const { return warnings_; }
  /// Returns an empty text, or a sentence about an incomplete last frame: "the file ends within frame 42; its 42 whole
  /// frames are used".
  const std::string& cut_short() const { return cut_short_; }

  /// Reads one frame. The result has the same bits whatever was read before. Throws InputError with file and frame if a
  /// coordinate is not finite or beyond kLargestCoordinate, if the number of atoms differs, if the data is damaged, if
  /// there is no such frame, or if the file has changed.
  void read(std::uint64_t number, Frame& frame);

 protected:
  Trajectory(std::string path, std::string format) : path_(std::move(path)), format_(std::move(format)) {}
  /// Reads one frame for read(). `number` is less than frame_count(), and the caller checks the result.
  virtual void read_unchecked(std::uint64_t number, Frame& frame) = 0;
  /// Returns the number with the fewest decimal digits within a relative precision of this one: 30 for 29.9999974 in
  /// single precision.
  static double with_fewest_digits(double number, double precision);

  std::string path_, format_;
  std::size_t atom_count_ = 0;
  std::uint64_t frame_count_ = 0;
  std::vector<Warning> warnings_;
  std::string cut_short_;
  /// Relative precision of the times in the file, to which read() rounds Frame::time.
  double time_precision_ = kDoublePrecision;

  /// Relative precisions: the error of products of a few doubles, and one unit in the last place of a float.
  static constexpr double kDoublePrecision = 1e-14, kSinglePrecision = 1.2e-7;
};

/// Returns the sentence "the file ends within frame 42; its 42 whole frames are used".
std::string cut_short_sentence(std::uint64_t whole_frames);

/// Options for opening a trajectory.
struct TrajectoryOptions {
  /// The folder for frame indices of formats whose frames are found only by walking through the file (XTC, TRR). It is
  /// made if missing. Empty: no index is stored. An index is valid only for the same size and time of change.
  std::string index_folder{};
  /// Returns the number of atoms of the structure, for a format without this number (mdcrd). It may throw. Null: there
  /// is no structure.
  std::function<std::size_t()> atoms{};
  bool trust_atom_order = false;  ///< true if atoms without numbers (LAMMPS dumps) are in the order of the structure
};

/// Opens a file of any format in core/trajectory/formats/trajectory_formats.h, which is recognized by content. Throws
/// InputError if the file is missing, is no trajectory, has no complete frame or has a broken header.
std::unique_ptr<Trajectory> open_trajectory(const std::string& path, const TrajectoryOptions& options = {});

/// Several trajectories that are read as one.
class JoinedFrames : public Trajectory {
 public:
  /// Joins the frames of all parts in order. No frame is left out: where a part begins before the end of the previous
  /// one, there is a warning. There must be at least one part. Throws InputError if the parts have different numbers of
  /// atoms.
  explicit JoinedFrames(std::vector<std::unique_ptr<Trajectory>> parts);

 private:
  void read_unchecked(std::uint64_t number, Frame& frame) override;
  void warn_of_overlap(std::size_t part);

  std::vector<std::unique_ptr<Trajectory>> parts_;
  std::vector<std::uint64_t> begin_;  ///< number of the first frame of each part
};

}  // namespace meniscus
