// SPDX-License-Identifier: BSD-3-Clause
// Has ffmpeg make a film of the pictures, so that nothing but the pictures decides its bytes.
#include <unistd.h>

#include <fmt/format.h>

#include "app/farm/child_process.h"
#include "app/farm/verify.h"
#include "app/program_error.h"
#include "core/base/output_file.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

/// Links to the pictures under numbers without gaps, as ffmpeg wants them.
class NumberedPictures {
 public:
  NumberedPictures(const Bundle& bundle, const fs::path& folder)
      : name_(fmt::format(".film_{}", ::getpid())), path_(folder / name_) {
    fs::remove_all(path_);
    fs::create_directories(path_);
    for (std::size_t n = 0; n < bundle.frames.size(); ++n)
      fs::create_symlink(fmt::format("../images/frame_{}.png", frame_digits(bundle.frames[n])),
                         path_ / fmt::format("{:08}.png", n));
  }
  ~NumberedPictures() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  NumberedPictures(const NumberedPictures&) = delete;
  NumberedPictures& operator=(const NumberedPictures&) = delete;

  std::string pattern() const { return name_ + "/%08d.png"; }

 private:
  std::string name_;
  fs::path path_;
};

// Two pixels share one colour in 4:2:0, so sides are made even. Threads are counted, since they show in the bytes.
std::vector<std::string> ffmpeg_command(const Bundle& bundle, const std::string& pattern, const std::string& output) {
  const std::string rate = fmt::format("{}", bundle.film->frames_per_second);
  const std::string filter = fmt::format(
      "color=c=black:s={}x{}:r={}[ground];[ground][0:v]overlay=shortest=1:format=gbrp,"
      "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int,"
      "format=yuv420p",
      bundle.width, bundle.height, rate);
  return {"ffmpeg",       "-nostdin",   "-hide_banner", "-loglevel",        "error",     "-y",
          "-framerate",   rate,         "-i",           pattern,            "-filter_complex", filter,
          "-frames:v",    std::to_string(bundle.frames.size()),
          "-c:v",         "libx264",    "-preset",      "medium",           "-crf",      "18",
          "-threads",     "4",          "-colorspace",  "bt709",            "-color_primaries", "bt709",
          "-color_trc",   "bt709",      "-map_metadata", "-1",              "-fflags",   "+bitexact",
          "-flags:v",     "+bitexact",  "-movflags",    "+faststart",       "-f",        "mp4",
          output};
}

}  // namespace

void encode_film(const Bundle& bundle, const fs::path& folder) {
  const NumberedPictures pictures(bundle, folder);
  OutputFile film(folder / bundle.film->file, Existing::replace);
  std::string last_words;
  ChildProcess ffmpeg(ffmpeg_command(bundle, pictures.pattern(), film.temporary_path().filename().string()), folder);
  while (const std::optional<std::string> line = ffmpeg.next_line())
    if (!line->empty()) last_words = *line;
  const int code = ffmpeg.wait();
  if (code != 0) throw RunError(kExitOutput, fmt::format("{}: ffmpeg ended with code {}: {}", bundle.film->file, code, last_words));
  film.commit();
}

}  // namespace meniscus::farm
