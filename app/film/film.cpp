// SPDX-License-Identifier: BSD-3-Clause
// Runs ffmpeg by an argument vector, never through a shell.
#include "app/film/film.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "app/film/film_check.h"
#include "app/process/program_error.h"
#include "core/base/error.h"

extern char** environ;

namespace meniscus {
namespace {

std::string pixel_format(const FilmPixels& pixels) {
  return fmt::format("rgb{}{}", pixels.channels == 4 ? "a" : "",
                     pixels.bytes == 2 ? (pixels.channels == 4 ? "64le" : "48le") : (pixels.channels == 4 ? "" : "24"));
}

std::vector<std::string> arguments(const FilmEncoder& encoder, const std::string& output, glm::ivec2 size,
                                   double frames_per_second) {
  std::vector<std::string> words{"ffmpeg", "-hide_banner", "-loglevel", "error", "-xerror", "-y",
                                 // pictures as they come
                                 "-f", "rawvideo", "-pixel_format", pixel_format(encoder.pixels), "-video_size",
                                 fmt::format("{}x{}", size.x, size.y), "-framerate",
                                 fmt::format("{}", frames_per_second), "-i", "pipe:0"};
  words.insert(words.end(), encoder.arguments.begin(), encoder.arguments.end());
  // without names, dates or versions
  words.insert(words.end(), {"-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1", output});
  return words;
}

std::string in_one_line(std::string_view text) {
  std::string line(text.substr(0, text.find_last_not_of(" \r\n") + 1));
  std::ranges::replace(line, '\n', ';');
  return line;
}

}  // namespace

void check_film_size(const FilmEncoder& encoder, glm::ivec2 size) {
  if (size.x < encoder.least.x || size.y < encoder.least.y)
    throw UsageError(fmt::format("--size {}x{}: a film of this codec has at least {}x{}", size.x, size.y,
                                 encoder.least.x, encoder.least.y));
  if (size.x % encoder.unit.x == 0 && size.y % encoder.unit.y == 0) return;
  throw UsageError(fmt::format("--size {}x{}: a film like this needs {}; so does not one of --chroma 444", size.x,
                               size.y, encoder.unit.y == 1 ? "an even width" : "even numbers"));
}

FilmWriter::FilmWriter(const std::string& path, Existing existing, glm::ivec2 size, double frames_per_second,
                       const FilmFormat& format)
    : file_(path, existing) {
  const FilmEncoder encoder = film_encoder(path, format);
  pixels_ = encoder.pixels;
  check_film_size(encoder, size);
  std::array<int, 2> ends{-1, -1};
  // A socket rather than a pipe: writing to an encoder that died is then an error, and no signal.
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw OutputError(path, std::string("no way to ffmpeg: ") + std::strerror(errno));
  pictures_ = ends[0];
  complaints_ = ::memfd_create("ffmpeg", MFD_CLOEXEC);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, complaints_, STDERR_FILENO);
  std::vector<std::string> words = arguments(encoder, file_.temporary_path().string(), size, frames_per_second);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int error = ::posix_spawnp(&encoder_, "ffmpeg", &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (error == 0) return;
  encoder_ = -1;
  ::close(pictures_);
  ::close(complaints_);
  throw OutputError(path, fmt::format("films need the program ffmpeg, which cannot be started: {}; install it, or "
                                      "write pictures: frame_#####.png",
                                      std::strerror(error)));
}

FilmWriter::~FilmWriter() {
  if (encoder_ >= 0) ::kill(encoder_, SIGKILL);  // given up: nobody wants what it has
  end_pictures();
  ::close(complaints_);
}

void FilmWriter::wait() {
  if (encoder_ < 0) return;
  while (::waitpid(encoder_, &status_, 0) < 0 && errno == EINTR) {
  }
  encoder_ = -1;
}

void FilmWriter::end_pictures() {
  if (pictures_ >= 0) ::close(std::exchange(pictures_, -1));  // an encoder that still reads comes to its end
  wait();
}

// On a full disk ffmpeg may end with 0, and says so on standard error only.
std::string FilmWriter::fault() const {
  std::array<char, 2000> text{};
  const ssize_t length = ::pread(complaints_, text.data(), text.size(), 0);
  const std::string said = in_one_line(std::string_view(text.data(), length > 0 ? length : 0));
  if (!said.empty()) return "ffmpeg failed: " + said;
  if (WIFSIGNALED(status_)) return fmt::format("ffmpeg was ended by signal {}", WTERMSIG(status_));
  if (WEXITSTATUS(status_) != 0) return fmt::format("ffmpeg failed with exit code {}", WEXITSTATUS(status_));
  const std::string broken = film_fault(file_.temporary_path(), added_);
  return broken.empty() ? "" : fmt::format("ffmpeg says nothing, but what it wrote {}", broken);
}

void FilmWriter::add(std::span<const std::uint8_t> picture) {
  while (!picture.empty()) {
    const ssize_t sent = ::send(pictures_, picture.data(), picture.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) {
      end_pictures();
      const std::string why = fault();
      throw OutputError(file_.target().string(), why.empty() ? "ffmpeg takes no more pictures" : why);
    }
    picture = picture.subspan(static_cast<std::size_t>(sent));
  }
  ++added_;
}

void FilmWriter::finish() {
  end_pictures();
  if (const std::string why = fault(); !why.empty()) throw OutputError(file_.target().string(), why);
  file_.commit();
}

}  // namespace meniscus
