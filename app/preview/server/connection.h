// SPDX-License-Identifier: BSD-3-Clause
// One TCP connection to the preview server: a file of the page, a refusal, or a socket for commands and pictures.
#pragma once

#include <boost/asio/ip/tcp.hpp>

#include "app/preview/server/clients.h"

namespace meniscus {

/// Reads one request and answers it; lives as long as that takes, or the socket that it asks for.
void serve_connection(boost::asio::ip::tcp::socket socket, const std::shared_ptr<Clients>& clients);

}  // namespace meniscus
