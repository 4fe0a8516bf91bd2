// SPDX-License-Identifier: BSD-3-Clause
// Starts Xvfb on a free display, reads its pixels from a file, and moves and types with xdotool.
#include "tests/support/virtual_screen.h"

#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace meniscus::test {
namespace {

constexpr int kStartMilliseconds = 20000;

/// A number as XWD files have it: big-endian, four bytes.
std::uint32_t word(const std::string& bytes, std::size_t index) {
  std::uint32_t value = 0;
  for (std::size_t b = 0; b < 4; ++b) value = value << 8 | static_cast<unsigned char>(bytes.at(4 * index + b));
  return value;
}

[[noreturn]] void become_server(int number_pipe, const std::string& screen, const std::string& folder) {
  const int silence = ::open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(silence, stream);
  const std::string pipe = std::to_string(number_pipe);
  ::execlp("Xvfb", "Xvfb", "-displayfd", pipe.c_str(), "-screen", "0", screen.c_str(), "-fbdir", folder.c_str(),
           "-nolisten", "tcp", "-noreset", nullptr);
  ::_exit(127);
}

/// The line that comes through the pipe; empty if none comes in time.
std::string line_from(int pipe) {
  std::string line;
  pollfd waiting{pipe, POLLIN, 0};
  char letter = 0;
  while (::poll(&waiting, 1, kStartMilliseconds) > 0 && ::read(pipe, &letter, 1) == 1 && letter != '\n') line += letter;
  return line;
}

}  // namespace

VirtualScreen::VirtualScreen(glm::ivec2 size) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("cannot make a pipe");
  const std::string screen = std::to_string(size.x) + "x" + std::to_string(size.y) + "x24";
  server_ = ::fork();
  if (server_ == 0) {
    ::close(ends[0]);
    become_server(ends[1], screen, folder_.path().string());
  }
  ::close(ends[1]);
  const std::string number = line_from(ends[0]);
  ::close(ends[0]);
  if (number.empty()) {
    crash();
    throw std::runtime_error("Xvfb did not start; is the package xvfb installed?");
  }
  if (const char* before = std::getenv("DISPLAY")) display_before_ = before;
  ::setenv("DISPLAY", (":" + number).c_str(), 1);
}

VirtualScreen::~VirtualScreen() {
  crash();
  if (display_before_.empty())
    ::unsetenv("DISPLAY");
  else
    ::setenv("DISPLAY", display_before_.c_str(), 1);
}

void VirtualScreen::crash() {
  if (server_ <= 0) return;
  ::kill(server_, SIGTERM);
  ::waitpid(server_, nullptr, 0);
  server_ = -1;
}

ScreenPicture VirtualScreen::picture() const {
  const std::string bytes = read_bytes(folder_.path() / "Xvfb_screen0");
  // XWDFile.h: header size, ..., width at 4, height at 5, ..., bytes per line at 12, ..., colours at 19.
  const std::size_t begin = word(bytes, 0) + 12 * static_cast<std::size_t>(word(bytes, 19));
  ScreenPicture picture{{word(bytes, 4), word(bytes, 5)}, {}};
  const std::size_t row = word(bytes, 12);
  for (int y = 0; y < picture.size.y; ++y)
    for (int x = 0; x < picture.size.x; ++x) {
      const std::size_t at = begin + y * row + 4 * static_cast<std::size_t>(x);  // blue, green, red, nothing
      picture.pixels.emplace_back(bytes.at(at + 2), bytes.at(at + 1), bytes.at(at));
    }
  return picture;
}

void VirtualScreen::act(const std::vector<std::string>& words) const {
  const ProgramResult result = run_program("/usr/bin/xdotool", words);
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

}  // namespace meniscus::test
