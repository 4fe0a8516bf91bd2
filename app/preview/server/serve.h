// SPDX-License-Identifier: BSD-3-Clause
// The preview as a web page.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "app/preview/server/network.h"
#include "app/preview/session.h"

namespace meniscus {

/// Where the page is.
struct ServedAddress {
  std::string url;   ///< http://127.0.0.1:PORT/TOKEN/
  std::string once;  ///< leads there once, so that it is worth nothing to those who see it in a list of processes
  std::uint16_t port = 0;
};

struct ServeOptions : NetworkOptions {
  /// Gets the address of the page, as soon as it can be opened.
  std::function<void(const ServedAddress&)> ready;
};

/// Makes the session, and tells meanwhile what it is doing, such as "Reading 1tii.pdb".
using MakeSession = std::function<std::unique_ptr<PreviewSession>(const std::function<void(const std::string&)>& tell)>;

/// Serves a session on 127.0.0.1 until a command ends it; pages can be opened while it is made. Makes and draws it on
/// this thread, which has its GL context. Throws what Network throws, and after the pages were notified GpuError and
/// what `make` throws.
void serve_session(const ServeOptions& options, const MakeSession& make);

/// Returns a picture as JPEG; nothing in a build without TurboJPEG. rgba: 4 bytes a pixel, rows from the top; alpha is
/// left out. quickly: colours have half the resolution, as is enough while something moves. Throws Error if it fails.
std::vector<std::uint8_t> encode_jpeg(std::span<const std::uint8_t> rgba, glm::ivec2 size, bool quickly);

}  // namespace meniscus
