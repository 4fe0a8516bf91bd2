// SPDX-License-Identifier: BSD-3-Clause
// Serves a session of the preview as a web page.
#pragma once

#include "app/preview/server/network.h"
#include "app/preview/session.h"

namespace meniscus {

/// The addresses of the page.
struct ServedAddress {
  std::string url;   ///< http://127.0.0.1:PORT/TOKEN/
  std::string once;  ///< opens the page once, so that it is useless to other users who see it in a list of processes
  std::uint16_t port = 0;
};

struct ServeOptions : NetworkOptions {
  /// Gets the addresses of the page as soon as it can be opened.
  std::function<void(const ServedAddress&)> ready;
};

/// Makes a session, and reports its progress, such as "Reading 1tii.pdb". files: the files of another molecule that
/// came from a page; empty for the first session.
using MakeSession = std::function<std::unique_ptr<PreviewSession>(const ReceivedFiles& files,
                                                                  const std::function<void(const std::string&)>& tell)>;

/// Serves a session on 127.0.0.1 until a command ends it; pages can be opened while it is made. Makes and draws it on
/// this thread, which has its GL context. Another session replaces it when a page opens another molecule. Throws what
/// Network throws and, after the pages were notified, GpuError and what `make` throws for the first session.
void serve_session(const ServeOptions& options, const MakeSession& make);

}  // namespace meniscus
