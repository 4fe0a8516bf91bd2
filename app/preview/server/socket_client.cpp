// SPDX-License-Identifier: BSD-3-Clause
// Reads commands within limits and writes one message after the other.
#include "app/preview/server/socket_client.h"

#include <chrono>
#include <deque>
#include <string>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

#include "app/preview/command_json.h"
#include "app/preview/server/limits.h"
#include "core/base/text_file.h"

namespace meniscus {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using Json = nlohmann::json;

/// Messages that wait for a client that does not read; a page that is alive never has as many.
constexpr std::size_t kLongestQueue = 512;

class SocketClient : public Client, public std::enable_shared_from_this<SocketClient> {
 public:
  SocketClient(beast::tcp_stream stream, std::shared_ptr<Clients> clients)
      : socket_(std::move(stream)), clients_(std::move(clients)) {
    ++clients_->connections;
  }
  ~SocketClient() override { --clients_->connections; }

  void accept(const beast::http::request<beast::http::empty_body>& request) {
    beast::get_lowest_layer(socket_).expires_never();  // the socket has timeouts of its own
    websocket::stream_base::timeout patience;
    patience.handshake_timeout = std::chrono::seconds(kPatience);
    patience.idle_timeout = std::chrono::seconds(60);
    patience.keep_alive_pings = true;
    socket_.set_option(patience);
    socket_.read_message_max(kLargestMessage);
    number_ = clients_->join(shared_from_this());
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error) return self->leave();
      self->open_ = true;
      self->send(
          text_message(json_line({{"event", "welcome"}, {"controls", self->clients_->controls(self->number_)}})));
      self->read();
    });
  }

  void send(OutgoingMessage message) override {
    if (gone_) return;
    if (queue_.size() >= kLongestQueue) return abandon();
    queue_.push_back(std::move(message));
    write_next();
  }

  void close() override {
    closing_ = true;
    write_next();
  }

 private:
  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->leave();
      if (self->socket_.got_text()) self->understand(beast::buffers_to_string(self->buffer_.data()));
      self->buffer_.consume(self->buffer_.size());
      self->read();
    });
  }

  void understand(const std::string& text) {
    Json message = is_nested_too_deep(text) ? Json() : Json::parse(text, nullptr, false);
    if (!message.is_object()) return reply(nullptr, "a message is a JSON object such as {\"command\":\"state\"}");
    Json id;
    if (const auto found = message.find("id"); found != message.end()) {
      id = *found;
      message.erase(found);
    }
    if (message == Json{{"request", "picture"}}) return clients_->mailbox.want_picture(number_);
    if (message == Json{{"request", "control"}}) return clients_->give_control(number_);
    if (!clients_->controls(number_) && !is_question(message)) return reply(id, "another page controls this preview");
    if (!clients_->mailbox.put(number_, id, std::move(message))) reply(id, "too many commands wait; send fewer");
  }

  void reply(const Json& id, const char* error) {
    send(text_message(json_line({{"id", id}, {"ok", false}, {"error", error}})));
  }

  void write_next() {
    if (writing_ || gone_ || !open_) return;
    if (queue_.empty()) {
      if (closing_) socket_.async_close(websocket::close_code::going_away, [self = shared_from_this()](auto) {});
      return;
    }
    writing_ = true;
    socket_.text(queue_.front().is_text);
    socket_.async_write(boost::asio::buffer(*queue_.front().bytes),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          self->writing_ = false;
                          self->queue_.pop_front();
                          if (error) return self->leave();
                          self->write_next();
                        });
  }

  void abandon() {
    beast::get_lowest_layer(socket_).close();
    leave();
  }

  void leave() {
    if (std::exchange(gone_, true)) return;
    clients_->leave(number_);
  }

  websocket::stream<beast::tcp_stream> socket_;
  beast::flat_buffer buffer_;
  std::shared_ptr<Clients> clients_;
  std::deque<OutgoingMessage> queue_;
  ClientNumber number_ = 0;
  bool open_ = false, writing_ = false, closing_ = false, gone_ = false;
};

}  // namespace

void serve_socket(beast::tcp_stream stream, const beast::http::request<beast::http::empty_body>& request,
                  const std::shared_ptr<Clients>& clients) {
  std::make_shared<SocketClient>(std::move(stream), clients)->accept(request);
}

}  // namespace meniscus
