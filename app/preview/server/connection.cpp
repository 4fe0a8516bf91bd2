// SPDX-License-Identifier: BSD-3-Clause
// Reads requests with limits, and answers with files of the page or a refusal.
#include "app/preview/server/connection.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <fmt/format.h>

#include "app/preview/server/access.h"
#include "app/preview/server/page_files.h"
#include "app/preview/server/limits.h"
#include "app/preview/server/socket_client.h"

namespace meniscus {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(boost::asio::ip::tcp::socket socket, std::shared_ptr<Clients> clients)
      : stream_(std::move(socket)), clients_(std::move(clients)) {
    ++clients_->connections;
  }
  ~Connection() {
    clients_->strangers.erase(stranger_);
    --clients_->connections;
  }

  void read() {
    stranger_ = clients_->next_stranger++;
    clients_->strangers[stranger_] = [weak = weak_from_this()] {
      if (const auto self = weak.lock()) self->stream_.close();
    };
    parser_.header_limit(kLargestHeader);
    parser_.body_limit(0);
    stream_.expires_after(std::chrono::seconds(kPatience));
    http::async_read(stream_, buffer_, parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (!error) return self->answer();
      if (error == http::error::header_limit || error == http::error::body_limit)
        self->refuse(http::status::request_header_fields_too_large, "the request is too large");
    });
  }

 private:
  void answer() {
    const auto& request = parser_.get();
    const std::string_view host = view(request[http::field::host]), target = view(request.target());
    if (!is_own_host(host, clients_->port)) return refuse(http::status::forbidden, "this is not the host asked for");
    const Admission admission = admit(target, clients_->token);
    if (!admission.admitted)
      return refuse(http::status::forbidden, "the address lacks the token that meniscus printed");
    clients_->strangers.erase(stranger_);
    if (request.method() != http::verb::get) return refuse(http::status::method_not_allowed, "only GET is known");
    if (admission.path == "socket") return open_socket();
    const std::string_view name = admission.path.empty() ? "index.html" : admission.path;
    const auto files = page_files();
    const auto file = std::ranges::find(files, name, &PageFile::path);
    if (file == files.end()) return refuse(http::status::not_found, "there is no such page");
    send(http::status::ok, content_type(name), file->content);
  }

  void open_socket() {
    const auto& request = parser_.get();
    if (!beast::websocket::is_upgrade(request)) return refuse(http::status::upgrade_required, "this is a WebSocket");
    if (!is_own_origin(view(request[http::field::origin]), clients_->port))
      return refuse(http::status::forbidden, "this page comes from elsewhere");
    if (clients_->full()) return refuse(http::status::service_unavailable, "too many pages are open already");
    serve_socket(std::move(stream_), request, clients_);
  }

  void refuse(http::status status, std::string_view why) {
    send(status, content_type(".txt"), fmt::format("{}\n", why));
  }

  void send(http::status status, std::string_view type, std::string_view body) {
    response_.result(status);
    response_.version(11);
    response_.keep_alive(false);
    response_.set(http::field::content_type, beast::string_view(type.data(), type.size()));
    set_policies();
    response_.body().assign(body);
    response_.prepare_payload();
    stream_.expires_after(std::chrono::seconds(kPatience));
    http::async_write(stream_, response_, [self = shared_from_this()](beast::error_code, std::size_t) {
      beast::error_code ignored;
      self->stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
    });
  }

  /// The page runs its own script and style only, talks to this server only, and stands in no frame.
  void set_policies() {
    const std::string sockets = fmt::format("ws://127.0.0.1:{0} ws://localhost:{0}", clients_->port);
    response_.set("Content-Security-Policy",
                  "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src " +
                      sockets + "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("Cross-Origin-Opener-Policy", "same-origin");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    response_.set(http::field::cache_control, "no-store");
  }

  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{2 * kLargestHeader};
  http::request_parser<http::empty_body> parser_;
  http::response<http::string_body> response_;
  std::shared_ptr<Clients> clients_;
  std::uint64_t stranger_ = 0;  // number in Clients::strangers
};

}  // namespace

void serve_connection(boost::asio::ip::tcp::socket socket, const std::shared_ptr<Clients>& clients) {
  std::make_shared<Connection>(std::move(socket), clients)->read();
}

std::string_view content_type(std::string_view path) {
  if (path.ends_with(".html")) return "text/html; charset=utf-8";
  if (path.ends_with(".js")) return "text/javascript; charset=utf-8";
  if (path.ends_with(".css")) return "text/css; charset=utf-8";
  if (path.ends_with(".svg")) return "image/svg+xml";
  return "text/plain; charset=utf-8";
}

}  // namespace meniscus
