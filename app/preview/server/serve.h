// SPDX-License-Identifier: BSD-3-Clause
// The preview as a web page, for machines without a display.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "app/preview/session.h"

namespace meniscus {

/// Serves the session on 127.0.0.1 until a command ends it. port 0: any free one. `ready` gets the address of the page
/// and the port. Draws on this thread, which has the session's GL context. Throws what Network throws, and GpuError
/// after the pages were notified.
void serve_session(PreviewSession& session, std::uint16_t port,
                   const std::function<void(const std::string& url, std::uint16_t port)>& ready);

}  // namespace meniscus
