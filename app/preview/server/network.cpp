// SPDX-License-Identifier: BSD-3-Clause
// The listener, its thread, and the messages to clients.
#include "app/preview/server/network.h"

#include <thread>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fmt/format.h>

#include "app/preview/command_json.h"
#include "app/preview/server/connection.h"
#include "app/process/system_process.h"
#include "core/base/error.h"

namespace meniscus {

namespace asio = boost::asio;

#ifdef _WIN32
// Where a port may be reused, Windows lets other programs have it at the same time.
using PortOption = asio::detail::socket_option::boolean<SOL_SOCKET, SO_EXCLUSIVEADDRUSE>;
#else
using PortOption = asio::socket_base::reuse_address;
#endif

struct Network::State {
  State(const NetworkOptions& options, Mailbox& mailbox)
      : acceptor(context),
        clients(std::make_shared<Clients>(mailbox, options.token.empty() ? random_token() : options.token)) {
    clients->trusted = options.trusted_hosts;
    try {
      const asio::ip::tcp::endpoint here(asio::ip::make_address(options.address), options.port);
      acceptor.open(here.protocol());
      // A browser that this program starts must not keep the port.
      system_process::keep_from_children(static_cast<std::intptr_t>(acceptor.native_handle()));
      acceptor.set_option(PortOption(true));
      acceptor.bind(here);
      acceptor.listen();
      clients->port = acceptor.local_endpoint().port();
    } catch (const boost::system::system_error& error) {
      throw RequestError("--serve: port {} of {} is not available: {}; try another, or 0 for any", options.port,
                         options.address, error.code().message());
    }
  }

  void accept() {
    acceptor.async_accept([this](boost::system::error_code error, asio::ip::tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) return accept_later();
      // A connection without the token makes room for one that may have it.
      if (clients->connections >= kMostConnections && !clients->strangers.empty()) {
        const auto oldest = clients->strangers.begin();
        const std::function<void()> end = oldest->second;
        clients->strangers.erase(oldest);
        end();
        serve_connection(std::move(socket), clients);
      } else if (clients->connections < kMostConnections) {
        serve_connection(std::move(socket), clients);
      }
      accept();
    });
  }

  /// Waits before the next connection, for instance because file descriptors are used up until connections end.
  void accept_later() {
    pause.expires_after(std::chrono::milliseconds(200));
    pause.async_wait([this](boost::system::error_code error) {
      if (!error) accept();
    });
  }

  void run() {
    try {
      context.run();
    } catch (const std::exception& error) {
      clients->mailbox.fail(fmt::format("the network thread ended: {}", error.what()));
    }
  }

  asio::io_context context{1};
  asio::ip::tcp::acceptor acceptor;
  asio::steady_timer pause{context};
  std::shared_ptr<Clients> clients;
  const std::string entry = clients->entry;
  std::thread thread;
};

Network::Network(const NetworkOptions& options, Mailbox& mailbox) : state_(std::make_unique<State>(options, mailbox)) {
  state_->accept();
  state_->thread = std::thread([this] { state_->run(); });
}

Network::~Network() {
  asio::post(state_->context, [state = state_.get()] {
    boost::system::error_code ignored;
    state->acceptor.close(ignored);
    state->pause.expires_after(std::chrono::seconds(1));
    state->pause.async_wait([state](boost::system::error_code) { state->context.stop(); });
    const auto sockets = state->clients->sockets;
    for (const auto& [number, client] : sockets) client->close();
    if (sockets.empty()) state->context.stop();
  });
  state_->thread.join();
  state_->clients->sockets.clear();  // the sockets hold the list that holds them
}

std::uint16_t Network::port() const { return state_->clients->port; }

std::string Network::url() const { return fmt::format("http://127.0.0.1:{}/{}/", port(), state_->clients->token); }

std::string Network::url_once() const { return fmt::format("http://127.0.0.1:{}/{}", port(), state_->entry); }

void Network::send(ClientNumber client, const nlohmann::json& message,
                   std::shared_ptr<const std::vector<std::uint8_t>> bytes) {
  asio::post(state_->context, [clients = state_->clients, client, text = text_message(json_line(message)),
                               more = OutgoingMessage{std::move(bytes), false}] {
    const auto found = clients->sockets.find(client);
    if (found == clients->sockets.end()) return;
    const std::shared_ptr<Client> socket = found->second;
    socket->send(text);
    if (more.bytes) socket->send(more);
  });
}

void Network::send_to_all(const nlohmann::json& message) {
  asio::post(state_->context, [clients = state_->clients, text = text_message(json_line(message))] {
    const auto sockets = clients->sockets;  // a copy, because a client that is abandoned leaves the list
    for (const auto& [number, socket] : sockets) socket->send(text);
  });
}

void Network::announce(const nlohmann::json& message) {
  asio::post(state_->context, [clients = state_->clients, text = message.is_null() ? "" : json_line(message)] {
    clients->announcement = text;
  });
  if (!message.is_null()) send_to_all(message);
}

void Network::offer_files(const std::vector<std::filesystem::path>& files) {
  std::map<std::string, std::filesystem::path, std::less<>> by_name;
  for (const std::filesystem::path& file : files) by_name[file.filename().string()] = file;
  asio::post(state_->context,
             [clients = state_->clients, names = std::move(by_name)]() mutable { clients->files = std::move(names); });
}

}  // namespace meniscus
