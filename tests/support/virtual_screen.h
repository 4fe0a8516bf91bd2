// SPDX-License-Identifier: BSD-3-Clause
// A virtual desktop: an X server without hardware, its pixels, and its mouse.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <sys/types.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "tests/support/run_program.h"

namespace meniscus::test {

/// What a screen shows, rows from the top.
struct ScreenPicture {
  glm::ivec2 size{0};
  std::vector<glm::u8vec3> pixels;

  const glm::u8vec3& at(glm::ivec2 pixel) const { return pixels[static_cast<std::size_t>(pixel.y) * size.x + pixel.x]; }
};

/// Xvfb on a display number of its own, which is DISPLAY for this process as long as the object lives.
class VirtualScreen {
 public:
  /// Throws std::runtime_error if Xvfb does not start.
  explicit VirtualScreen(glm::ivec2 size);
  ~VirtualScreen();
  VirtualScreen(const VirtualScreen&) = delete;
  VirtualScreen& operator=(const VirtualScreen&) = delete;

  ScreenPicture picture() const;
  /// xdotool with these words, such as {"mousemove", "10", "20", "click", "1"}.
  void act(const std::vector<std::string>& words) const;
  /// The server ends now, as when a desktop crashes.
  void crash();

 private:
  TemporaryFolder folder_;  // of the framebuffer, as a file in XWD format
  pid_t server_ = -1;
  std::string display_before_;
};

}  // namespace meniscus::test
