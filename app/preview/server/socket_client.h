// SPDX-License-Identifier: BSD-3-Clause
// A browser's socket: commands come in, replies and pictures go out.
#pragma once

#include <memory>

#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>

#include "app/preview/server/clients.h"

namespace meniscus {

/// Takes the connection over and completes the handshake for `request`, which has been admitted.
void serve_socket(boost::beast::tcp_stream stream,
                  const boost::beast::http::request<boost::beast::http::empty_body>& request,
                  const std::shared_ptr<Clients>& clients);

}  // namespace meniscus
