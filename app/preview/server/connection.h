// SPDX-License-Identifier: BSD-3-Clause
// One TCP connection to the preview server, which gets a file of the page, a refusal or a socket.
#pragma once

#include <boost/asio/ip/tcp.hpp>

#include "app/preview/server/clients.h"

namespace meniscus {

/// Reads one request and answers it; lives until the answer is sent, or as long as the socket that the request opens.
void serve_connection(boost::asio::ip::tcp::socket socket, const std::shared_ptr<Clients>& clients);

}  // namespace meniscus
