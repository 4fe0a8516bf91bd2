// SPDX-License-Identifier: BSD-3-Clause
// The folder of a bundle on the disk: checksums, missing frames, unfinished files, faults of pictures, and the film.
#pragma once

#include <system_error>

#include "app/farm/bundle.h"
#include "app/process/child_process.h"
#include "app/process/program_main.h"

namespace meniscus::farm {

/// A hidden folder of the main thread for unfinished files. It is deleted with this object or when the program stops.
class HiddenFolder {
 public:
  /// Makes PARENT/.NAME.RANDOM.part, which no other process on any machine has. Throws OutputError.
  HiddenFolder(const std::filesystem::path& parent, std::string_view name);
  ~HiddenFolder() {
    const auto held = hold_stops();  // if two threads remove the same folder, both may give up
    remove();
  }
  HiddenFolder(const HiddenFolder&) = delete;
  HiddenFolder& operator=(const HiddenFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  /// Removes the folder; StopBarrier and stop_children() prevent that anything is written into it meanwhile.
  void remove() const {
    std::error_code failed;
    std::filesystem::remove_all(path_, failed);
  }

  std::filesystem::path path_;
  StopHandler stop_{[this] {
                      stop_children();
                      remove();
                    },
                    std::nullopt};
};

/// Writes a complete file or none, and creates its folders; an older file is replaced. The main thread calls it, and a
/// program that is being stopped writes nothing more. Throws OutputError.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Return the SHA-256 of a text or of a file's content, as 64 hexadecimal digits (FIPS 180-4). The second one throws
/// InputError if the file cannot be read.
std::string sha256(std::string_view bytes);
std::string sha256_of_file(const std::filesystem::path& path);

/// Returns the indices, in order, of paths whose files are missing. A PNG file without its end counts as missing:
/// frames are written completely or not at all, but a power failure may cut them. Folders are listed, because a
/// network's file system may answer questions about single names from memory.
std::vector<std::size_t> missing_files(const std::vector<std::string>& paths);

/// Returns those frames, in order, that have no result of the step. A scene is complete if its files have the sizes in
/// its result, which lists these files.
std::vector<std::uint64_t> missing_frames(const Bundle& bundle, const std::filesystem::path& folder, Step step,
                                          const std::vector<std::uint64_t>& frames);

/// Checks sizes of the bundle's inputs, and checksums up to 256 MiB, or of all if `thorough`. Throws InputError.
void check_inputs(const Bundle& bundle, const std::filesystem::path& folder, bool thorough);

/// Removes the unfinished files that killed workers left in a bundle.
void remove_leftovers(const std::filesystem::path& folder);

/// A fault of a frame.
struct FrameFault {
  std::string sentence;   ///< the fault in words
  bool is_there = false;  ///< true if a picture exists, so that no worker would make it again
};

/// Faults by the number of the frame.
using FrameFaults = std::map<std::uint64_t, FrameFault>;

/// Finds missing frames, and pictures that cannot be read, have the wrong size, or are blank: all pixels equal.
FrameFaults faults_of(const Bundle& bundle, const std::filesystem::path& folder);

/// The picture that a film shows instead of a frame that is not good.
enum class InPlace {
  hold,  ///< the frame before it again; before the first good frame, that one
  drop   ///< nothing: the film is shorter
};

/// Makes the film of the bundle's pictures (app/film/film.h): the same bytes for the same pictures. White shows through
/// transparent parts where the film keeps no alpha. Some frames are not among the `faults`. Throws OutputError if
/// ffmpeg is not there or fails.
void encode_film(const Bundle& bundle, const std::filesystem::path& folder, const FrameFaults& faults,
                 InPlace in_place);

}  // namespace meniscus::farm
